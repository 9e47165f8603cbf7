"""Regular positions in a box of cells: the common ground of the generated bodies."""

from dataclasses import dataclass
from math import ceil, prod

import numpy as np

from mpmgeo.bodies.cloud import Cloud
from mpmgeo.positions import NOWHERE, resolution

ROUND_OFF = 1e-9
MOST_POSITIONS = 10**9


def too_many(number: float) -> str | None:
    """Return that a number of particle positions is too large, None if it is not."""
    if number <= MOST_POSITIONS:
        return None
    return (
        f"the body needs about {number:.3g} particle positions, "
        f"more than the {MOST_POSITIONS:.0e} that fit"
    )


@dataclass(frozen=True)
class Lattice:
    """Candidate particle positions: `cells` boxes of edges `cell`, `per_cell` positions in each.

    All members hold three numbers, one an axis; `start` is the lowest corner [m], `extent` the
    size that was asked for [m], of which the cells cover at least the whole, but for `slack` [m],
    what round-off may add to it.
    """

    start: np.ndarray
    extent: np.ndarray
    cell: np.ndarray
    cells: tuple[int, ...]
    per_cell: tuple[int, ...]
    slack: np.ndarray

    @classmethod
    def over(cls, start, extent, cell, per_cell, zero=NOWHERE) -> "Lattice":
        """Cover a box with whole cells, forgiving round-off in sizes and in coordinates.

        `zero` (3,) [m]: where `start` counts from. Raises ValueError if that makes more than a
        thousand million positions.
        """
        ratios = [float(e) / float(c) for e, c in zip(extent, cell, strict=True)]
        number = prod(max(ratio, 1.0) for ratio in ratios) * prod(map(float, per_cell))
        if message := too_many(number):
            raise ValueError(message)
        start, extent, cell = (np.array(list(a), dtype=np.float64) for a in (start, extent, cell))
        slack = np.maximum(ROUND_OFF * extent, resolution(zero, start, start + extent))
        cells = tuple(max(1, ceil(n)) for n in (extent - slack) / cell)
        return cls(start, extent, cell, cells, tuple(per_cell), slack)

    @property
    def number(self) -> int:
        """How many candidate positions there are; a body keeps some or all of them."""
        return prod(self.cells) * prod(self.per_cell)

    @property
    def size(self) -> np.ndarray:
        """Edge lengths of a particle (3,) [m]."""
        return self.cell / self.per_cell

    def covers(self, position: np.ndarray) -> np.ndarray:
        """Tell which of the positions (n, 3) [m] lie in its cells, not only at their border."""
        low, high = self.start + self.slack, self.start + self.cell * self.cells - self.slack
        return ((position > low) & (position < high)).all(axis=1)

    def coordinates(self) -> tuple[np.ndarray, ...]:
        """Return x, y, z of all positions [m] with shapes (X,1,1), (1,Y,1), (1,1,Z)."""
        axes = zip(self.start, self.cell, self.cells, self.per_cell, strict=True)
        return np.ix_(*(o + d * ((np.arange(n * p) + 0.5) / p) for o, d, n, p in axes))

    def cloud(self, fastest, keep=None, notes=()) -> Cloud:
        """Return the positions where `keep` (broadcasts to (X,Y,Z)) holds, or all of them.

        Cells follow each other with z fastest; within a cell `fastest`, "x" or "z", runs fastest.
        """
        shape = tuple(n * p for n, p in zip(self.cells, self.per_cell, strict=True))
        columns = [
            self._by_cell(np.broadcast_to(axis, shape), fastest) for axis in self.coordinates()
        ]
        if keep is not None:
            kept = np.flatnonzero(self._by_cell(np.broadcast_to(keep, shape), fastest))
            columns = [column[kept] for column in columns]
        position = np.stack(columns, axis=1)
        return Cloud(position, np.full(position.shape, self.size), tuple(notes))

    def _by_cell(self, values, fastest):
        (nx, ny, nz), (px, py, pz) = self.cells, self.per_cell
        within = (5, 3, 1) if fastest == "x" else (1, 3, 5)
        return values.reshape(nx, px, ny, py, nz, pz).transpose(0, 2, 4, *within).ravel()

    def surplus(self, axes="xyz") -> list[str]:
        """Return one sentence for each of the axes along which the cells exceed the extent."""
        covered = self.cell * self.cells
        return [
            f"the size along {name}, {self.extent[a]:g} m, is not a multiple of the cell, "
            f"{self.cell[a]:g} m: {self.cells[a]} whole cells make {covered[a]:g} m"
            for a, name in enumerate("xyz")
            if name in axes and covered[a] > self.extent[a] + 2 * self.slack[a]
        ]
