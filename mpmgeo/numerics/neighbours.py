"""Which points are near which places: a cell list over the points."""

from collections.abc import Iterator

import numpy as np

CELLS = 2**20
"""Largest number of cells along an axis, so that the keys of all cells fit into 63 bits."""

PIECE = 2**16
"""Places that are looked at together."""

AROUND = np.stack(np.meshgrid(*[[-1, 0, 1]] * 3, indexing="ij"), axis=-1).reshape(-1, 3)


class Neighbours:
    """Points (m, 3) in cells as large as the `radius` within which they are looked for."""

    def __init__(self, points: np.ndarray, radius: float):
        self.points, self.radius = points, radius
        self.low = points.min(axis=0)
        extent = float(np.ptp(points, axis=0).max())
        self.size = max(radius, extent / CELLS)
        cells = self._cells(points)
        self.counts = cells.max(axis=0) + 1
        keys = self._keys(cells)
        self.order = np.argsort(keys, kind="stable")
        self.keys, self.start = np.unique(keys[self.order], return_index=True)
        self.stop = np.append(self.start[1:], len(points))

    def _cells(self, x):
        return np.floor((x - self.low) / self.size).astype(np.int64)

    def _keys(self, cells):
        return (cells[:, 0] * self.counts[1] + cells[:, 1]) * self.counts[2] + cells[:, 2]

    def pairs(self, x: np.ndarray) -> Iterator[tuple[np.ndarray, np.ndarray, np.ndarray]]:
        """Yield place, point (k,) and distance (k,) of the pairs nearer than the radius.

        x (n, 3): the places, looked at in pieces; places ascend, and points for each place.
        """
        for first in range(0, len(x), PIECE):
            place, point = self._candidates(x[first : first + PIECE])
            distance = np.linalg.norm(x[first + place] - self.points[point], axis=1)
            near = distance < self.radius
            place, point, distance = first + place[near], point[near], distance[near]
            order = np.lexsort((point, place))
            yield place[order], point[order], distance[order]

    def _candidates(self, x):
        """Return the places and points of neighbouring cells."""
        # far away places would overflow the integers
        cells = self._cells(np.clip(x, self.low - 2 * self.size, self._high() + 2 * self.size))
        places, points = [], []
        for step in AROUND:
            there = cells + step
            inside = np.flatnonzero(((there >= 0) & (there < self.counts)).all(axis=1))
            keys = self._keys(there[inside])
            at = np.minimum(np.searchsorted(self.keys, keys), len(self.keys) - 1)
            found = self.keys[at] == keys
            at, inside = at[found], inside[found]
            count = self.stop[at] - self.start[at]
            total = np.cumsum(count)
            offset = np.arange(total[-1] if len(total) else 0) - np.repeat(total - count, count)
            places.append(np.repeat(inside, count))
            points.append(self.order[np.repeat(self.start[at], count) + offset])
        return np.concatenate(places), np.concatenate(points)

    def _high(self):
        return self.low + self.counts * self.size
