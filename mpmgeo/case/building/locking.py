"""Materials that lock: they hardly change their volume, and their particles may not share that."""

from collections.abc import Callable, Iterator

import numpy as np

NEARLY_INCOMPRESSIBLE = 0.45
"""Poisson's ratio above which a cell of several particles is plainly too stiff."""

SEVERAL = 1.5
"""Particles in the cells of a material, on average, from which on they constrain each other."""


def locking(case, position, material: Callable) -> Iterator[str]:
    """Yield a warning, one sentence, for each material that would need the cure it does not get.

    position (n, 3) [m] in the mesh of all particles at the start; `material` returns theirs (n,).
    """
    if case.volumetric_locking != "off" or case.compatibility is not None:
        return
    for law in {law.id: law for law in reversed(case.materials)}.values():
        reason = _keeps_volume(law)
        count = reason and _constraints(position[material() == law.id] / case.mesh.cells_dimension)
        if count and count >= SEVERAL:
            yield (
                f"materials: {law.id} hardly changes its volume ({reason}), which makes cells of "
                f'{count:.2g} particles too stiff; "volumetric_locking": "cells" mends it'
            )


def _constraints(position) -> float:
    """Return the particles in a cell, on average; 0 for a row of cells, which cannot lock.

    `position` (n, 3) in cells.
    """
    cells = np.unique(np.floor(position), axis=0)
    is_row = len(cells) == 0 or np.count_nonzero(np.ptp(cells, axis=0)) < 2
    return 0.0 if is_row else len(position) / len(cells)


def _keeps_volume(law) -> str | None:
    """Return why a law keeps its volume, None if it does not."""
    if getattr(law, "poisson", 0.0) > NEARLY_INCOMPRESSIBLE:
        return f"poisson {law.poisson:g}"
    if getattr(law, "su_vertical_stress", 0.0) > 0:
        return "su_vertical_stress, flow without dilation"
    if getattr(law, "friction", None) == 0 and law.dilation == 0:
        return "friction 0, flow without dilation"
    return None
