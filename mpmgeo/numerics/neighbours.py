"""Which points are near which places: a cell list over the points, of the cells that hold any."""

from collections.abc import Iterator

import numpy as np

PIECE = 2**16
"""Places that are looked at together."""

PAIRS = 2**22
"""Pairs whose distance is computed together, unless one place has more."""

WIDER = 1 + 1e-6
"""Size of a cell over the radius, so that round-off never puts a pair two cells apart."""

AROUND = np.stack(np.meshgrid(*[[-1, 0, 1]] * 3, indexing="ij"), axis=-1).reshape(-1, 3)


class Neighbours:
    """Points (m, 3) in cells about as large as the `radius` within which they are looked for.

    Only cells with points are numbered, so that points far from all others cost nothing.
    """

    def __init__(self, points: np.ndarray, radius: float):
        self.points, self.radius = points, radius
        cells = self._cells(points).T
        self._axes = [np.unique(column) for column in cells]
        x, y, z = (_at(*both)[0] for both in zip(self._axes, cells, strict=True))
        self._columns = np.unique(x * len(self._axes[1]) + y)
        self._keys, cell = np.unique(self._key(x, y, z)[0], return_inverse=True)
        self._order = np.argsort(cell, kind="stable")
        self._count = np.bincount(cell, minlength=len(self._keys))
        self._start = np.cumsum(self._count) - self._count

    def _cells(self, x):
        # whole numbers as doubles, which far places do not overflow
        with np.errstate(over="ignore"):
            return np.floor(x / (self.radius * WIDER))

    def _key(self, x, y, z):
        """Return the keys of cells from their places along the axes, and whether there are such
        columns along z."""
        column, is_known = _at(self._columns, x * len(self._axes[1]) + y)
        return column * len(self._axes[2]) + z, is_known

    def pairs(self, x: np.ndarray) -> Iterator[tuple[np.ndarray, np.ndarray, np.ndarray]]:
        """Yield place, point (k,) and distance (k,) of the pairs nearer than the radius.

        x (n, 3): the places, looked at in pieces; places ascend, and points for each place.
        """
        for first in range(0, len(x), PIECE):
            place, cell = self._around(self._cells(x[first : first + PIECE]))
            for part in _parts(place, np.cumsum(self._count[cell])):
                yield self._near(x, first + place[part], cell[part])

    def _around(self, cells):
        """Return places and numbers of the cells with points around them, places ascending."""
        places, numbers = [], []
        for step in AROUND:
            there = cells + step
            known = ((there != cells) | (step == 0)).all(axis=1)  # beyond 2⁵³ a step leads nowhere
            axes = []
            for axis, column in zip(self._axes, there.T, strict=True):
                at, is_known = _at(axis, column)
                axes.append(at)
                known &= is_known
            key, is_column = self._key(*axes)
            number, is_cell = _at(self._keys, key)
            inside = np.flatnonzero(known & is_column & is_cell)
            places.append(inside)
            numbers.append(number[inside])
        place, number = np.concatenate(places), np.concatenate(numbers)
        order = np.argsort(place, kind="stable")
        return place[order], number[order]

    def _near(self, x, place, cell):
        """Return the pairs of places and all points in cells that are near enough."""
        count = self._count[cell]
        total = np.cumsum(count)
        offset = np.arange(total[-1]) - np.repeat(total - count, count)
        point = self._order[np.repeat(self._start[cell], count) + offset]
        place = np.repeat(place, count)
        distance = np.linalg.norm(x[place] - self.points[point], axis=1)
        near = distance < self.radius
        place, point, distance = place[near], point[near], distance[near]
        order = np.lexsort((point, place))
        return place[order], point[order], distance[order]


def _at(known, values):
    """Return where values stand among known ones in order, and whether they do."""
    at = np.minimum(np.searchsorted(known, values), len(known) - 1)
    return at, known[at] == values


def _parts(place, total):
    """Yield slices of whole places that make at most `PAIRS` pairs; `total`: sums of pairs."""
    ends = np.flatnonzero(np.diff(place, append=-1)) + 1
    sums, first = total[ends - 1], 0
    while first < len(sums):
        done = sums[first - 1] if first else 0
        after = max(int(np.searchsorted(sums, done + PAIRS, side="right")), first + 1)
        yield slice(ends[first - 1] if first else 0, ends[after - 1])
        first = after
