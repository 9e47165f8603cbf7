"""The outline of a heap of grains in plane strain: how high it stands, how far it runs, what slid.

The height of a heap is that of its mass at the density it was built with: Σ m over a strip, by
density, width and depth of the strip. Grains that fly ahead of the heap, or lie scattered before
it, are then as little as they are, however wide they lie apart. The front is where the height
first falls below a thickness that still counts as heap.
"""

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Heap:
    """Particles on the floor z = 0, beside a wall at x = 0.

    `position` (n, 2): x and z [m]; `displacement` (n,): its size [m]; `area` (n,): mass by density
    and depth [m²]; `size`: edge of a particle [m].
    """

    position: np.ndarray
    displacement: np.ndarray
    area: np.ndarray
    size: float

    @classmethod
    def of(cls, simulation, density: float, depth: float, size: float):
        """Return the heap of a simulation of plane strain in x and z, `depth` [m] along y."""
        area = simulation.field("mass") / (density * depth)
        displacement = np.linalg.norm(simulation.field("displacement"), axis=1)
        return cls(simulation.field("position")[:, [0, 2]], displacement, area, size)

    def height(self, x: np.ndarray, width: float) -> np.ndarray:
        """Return the mean heights (k,) [m] of the strips of a `width` [m] around places x (k,)."""
        low, high = np.maximum(x - width / 2, 0.0), x + width / 2
        return (self._up_to(high) - self._up_to(low)) / (high - low)

    def _up_to(self, x):
        """Return the areas (k,) [m²] between the wall and the places x (k,)."""
        left = self.position[:, 0] - self.size / 2
        share = np.clip((np.asarray(x)[:, None] - left) / self.size, 0.0, 1.0)
        return share @ self.area

    def front(self, thickness: float, width: float) -> float:
        """Return the x [m] at which the height, of strips of a `width`, sinks below `thickness`."""
        x = np.arange(0.0, self.position[:, 0].max() + 2 * width, self.size / 2)
        height = self.height(x, width)
        k = int((height < thickness).argmax())
        return float(np.interp(thickness, [height[k], height[k - 1]], [x[k], x[k - 1]]))

    def failure_line(self, x: np.ndarray, way: float) -> np.ndarray:
        """Return the heights (k,) [m] at places x (k,) up to which nothing moved by `way` [m]."""
        rests = self.displacement <= way
        return np.array([self._top(rests & self._near(place)) for place in x])

    def _near(self, place):
        return np.abs(self.position[:, 0] - place) <= self.size

    def _top(self, chosen):
        return self.position[chosen, 1].max(initial=0.0) + self.size / 2 if chosen.any() else 0.0


def difference(found: np.ndarray, expected: np.ndarray) -> float:
    """Return the root of the mean square of the difference of two outlines (k,)."""
    return float(np.sqrt(np.mean((np.asarray(found) - np.asarray(expected)) ** 2)))
