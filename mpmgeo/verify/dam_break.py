"""A column of water that collapses: where its front is, and how high it stands at the wall.

    T = n t √(g/a),  Z = x/a,    τ = t √(g/a),  H = y/(n² a)

for a column a wide and n² a high against a wall at x = 0 on a floor at z = 0, with x the place of
the front and y the height at the wall. Source: Martin and Moyce (1952), Phil. Trans. R. Soc. A 244,
312–324.
"""

from dataclasses import dataclass
from math import sqrt

import numpy as np

CAPILLARY_LENGTH = 2.7e-3
"""√(surface tension/(ρ g)) of water [m]: a front of real water is hardly thinner."""


@dataclass(frozen=True)
class DamBreak:
    """Column of water: width a [m], slenderness n² [-], gravity [m/s²]."""

    width: float
    slenderness: float
    gravity: float

    def follow(self, simulation, samples: int = 100) -> tuple[np.ndarray, np.ndarray]:
        """Run the case, one cell thick along y; return (T, Z) and (τ, H), each (samples, 2)."""
        cell = simulation.case.mesh.cells_dimension[1]
        area = simulation.field("volume") / cell
        τ = sqrt(self.gravity / self.width)
        front, height = [], []
        for instant in simulation.case.time * np.arange(1, samples + 1) / samples:
            simulation.run(until=instant)
            here = simulation.field("active") == 1
            water = simulation.field("position")[here], area[here]
            time = τ * simulation.time
            front.append((sqrt(self.slenderness) * time, self.front(*water)))
            height.append((time, self.height(*water)))
        return np.array(front), np.array(height)

    def front(self, position: np.ndarray, area: np.ndarray) -> float:
        """Return Z: the foremost place where the water is one capillary length deep.

        `position` (n, 3) [m]; `area` (n,) [m²] is what particles fill of the plane at rest. The
        depth is area over length, in strips of a/16, linear between their middles.
        """
        strip = self.width / 16
        depth = np.bincount((position[:, 0] / strip).astype(int), area / strip)
        last = np.flatnonzero(depth >= CAPILLARY_LENGTH)[-1]
        here, ahead = np.append(depth, 0.0)[last : last + 2]
        share = (here - CAPILLARY_LENGTH) / (here - ahead)
        return (last + 0.5 + share) * strip / self.width

    def height(self, position: np.ndarray, area: np.ndarray) -> float:
        """Return H: the upper edge of the highest particle that is nearer than a/8 to the wall.

        `position` (n, 3) [m]; `area` (n,) [m²] of particles that are squares at rest.
        """
        near = position[:, 0] < self.width / 8
        top = (position[near, 2] + np.sqrt(area[near]) / 2).max()
        return top / (self.slenderness * self.width)


def difference(curve: np.ndarray, measured: np.ndarray) -> np.ndarray:
    """Return by how much a curve (m, 2) is above measured points (n, 2), at their times (n,)."""
    return np.interp(measured[:, 0], *curve.T) - measured[:, 1]


def delay(curve: np.ndarray, measured: np.ndarray) -> np.ndarray:
    """Return by how much later measured points (n, 2) are than a curve (m, 2) that rises (n,)."""
    times, values = curve.T
    return measured[:, 0] - np.interp(measured[:, 1], np.maximum.accumulate(values), times)
