"""Positions as users write them: how exactly doubles hold them, and how messages show them.

A position counts from `zero` (3,) [m], which is added to it here: inside the solver that is the
origin of the mesh, in a case file (0, 0, 0).
"""

from math import log10

import numpy as np

ULPS = 4
"""Units in the last place by which sums and differences of a few positions may be off."""

DECIMALS = 3
"""Digits after the point that large coordinates are shown with, at least."""

NOWHERE = (0.0, 0.0, 0.0)


def mean_edge(cell) -> float:
    """Return the mean edge length [m] of a cell (3,): of a cube exactly its own."""
    x, y, z = map(float, cell)
    return x if x == y == z else (x + y + z) / 3


def resolution(zero, *positions) -> np.ndarray:
    """Return how exactly (3,) [m] doubles hold some positions, (3,) or (n, 3) [m] each."""
    highest = [np.abs(np.add(p, zero)).reshape(-1, 3).max(axis=0, initial=0.0) for p in positions]
    return ULPS * np.spacing(np.max(highest, axis=0))


def shown(position, zero=NOWHERE, digits=6) -> str:
    """Return a position (3,) [m] as messages show it."""
    return (
        f"({', '.join(coordinate(x + o, digits) for x, o in zip(position, zero, strict=True))}) m"
    )


def coordinate(x, digits=6) -> str:
    """Return a coordinate [m] as messages show it: large ones to the millimetre."""
    if 10 ** (digits - DECIMALS) <= abs(x) < 1e12:
        digits = int(log10(abs(x))) + 1 + DECIMALS
    return f"{x:.{digits}g}"
