"""Whether the outline of a polygon crosses itself."""

import numpy as np

ROUND_OFF = 1e-9
"""Share of the square of the outline's size by which a corner may lie beyond an edge it touches."""


def crossing(corners: np.ndarray) -> tuple[int, int] | None:
    """Return the numbers, from 0, of two edges that cross or run twice the same way, None without.

    `corners` (m, 2); an edge has the number of its first corner. Edges that touch, or that run to
    and fro as to a hole, do not cross.
    """
    start = np.asarray(corners, float)
    end = np.roll(start, -1, axis=0)
    size = float(np.ptp(start, axis=0).max())
    for first in range(len(start) - 1):
        others = slice(first + 1, None)
        a, b, c, d = start[first], end[first], start[others], end[others]
        slack = ROUND_OFF * size * size
        crosses = _parts(a, b, c, d, slack) & _parts(c, d, a, b, slack)
        again = (c == a).all(axis=1) & (d == b).all(axis=1) & (a != b).any()
        found = np.flatnonzero(crosses | again)
        if len(found):
            return first, first + 1 + int(found[0])
    return None


def _parts(a, b, c, d, slack):
    """Tell whether the line through a and b has c and d clearly on different sides."""
    one, other = _side(a, b, c), _side(a, b, d)
    return ((one > slack) & (other < -slack)) | ((one < -slack) & (other > slack))


def _side(a, b, c):
    along, off = b - a, c - a
    return along[..., 0] * off[..., 1] - along[..., 1] * off[..., 0]
