"""Mass that is counted twice: bodies that overlap, particles at one place."""

from collections.abc import Iterator
from itertools import combinations

import numpy as np

from mpmgeo.bodies.body import Filled
from mpmgeo.positions import shown

SAME = 1e-6
"""Share of a cell within which particles lie at one place."""


def overlaps(case, position, body, mass) -> Iterator[str]:
    """Yield warnings, one sentence each; all in coordinates of the mesh.

    position (n, 3) [m], number of the body (n,) of all particles; `mass()`: their masses (n,) [kg].
    """
    cell = np.array(case.mesh.cells_dimension)
    labelled = [(made, label) for made in case.body if made.active for label in made.labels]
    rows = [np.flatnonzero(body == number) for number in range(1, len(labelled) + 1)]
    boxes = [_box(position[at], cell) for at in rows]
    for one, other in combinations(range(len(labelled)), 2):
        if not _meet(boxes[one], boxes[other]):
            continue
        held, inside = _held(labelled, rows, position, cell, one, other)
        if len(inside):
            names = [f"body {n + 1} ({labelled[n][1]})" for n in (one, other)]
            yield (
                f"{names[0]} and {names[1]} overlap: {len(inside)} particles of body {held + 1} "
                f"lie in the other one, {mass()[inside].sum():.4g} kg are counted twice"
            )
    listed = [at for (made, _), at in zip(labelled, rows, strict=True) if not _is_filled(made)]
    yield from _at_one_place(case, np.concatenate([*listed, np.empty(0, int)]), position, mass)


def _is_filled(made):
    return isinstance(made, Filled)


def _box(x, cell):
    """Return the corners of the box of some particles, a cell larger on all sides."""
    return (x.min(axis=0) - cell, x.max(axis=0) + cell) if len(x) else None


def _meet(one, other):
    return one and other and bool(((one[0] <= other[1]) & (other[0] <= one[1])).all())


def _held(labelled, rows, position, cell, one, other):
    """Return which of two bodies has particles in the other, and their rows."""
    for outer, inner in ((one, other), (other, one)):
        made = labelled[outer][0]
        if _is_filled(made):
            at = rows[inner]
            at = at[made.holds(position[at], cell)]
            if len(at):
                return inner, at
    return other, rows[other][:0]


def _at_one_place(case, rows, position, mass):
    """Yield that particles that are listed, or come from a mesh, lie at the place of others."""
    places = np.round(position[rows] / (SAME * np.array(case.mesh.cells_dimension)))
    order = np.lexsort(places.T)
    again = order[1:][(np.diff(places[order], axis=0) == 0).all(axis=1)]
    if len(again):
        surplus = np.sort(rows[again])
        yield (
            f"{len(surplus)} particles lie where others do, the first of them row {surplus[0]} at "
            f"{shown(position[surplus[0]], case.mesh.zero)}: {mass()[surplus].sum():.4g} kg are "
            "counted twice"
        )
