"""The vibrating bar of `verify/bar.py`, so slightly that theory of small displacements holds."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from mpmgeo.verify.bar import Bar
from mpmgeo.verify.problem import Problem


@dataclass(frozen=True)
class AxialVibration(Problem):
    """Bar of 25 m in its first mode, over 0.8 of a vibration; largest `speed` [m/s]."""

    name: ClassVar[str] = "axial_vibration"
    time: ClassVar[float] = 8.0
    length: ClassVar[float] = 25.0

    young: float = 100.0
    poisson: float = 0.0
    density: float = 1.0
    speed: float = 1e-3

    @property
    def bar(self) -> Bar:
        """Return the bar with its exact motion."""
        return Bar(self.length, self.young, self.density, self.speed)

    def case(self, cell: float, particles: int) -> dict:
        """Return the case but for its step; `cell` [m]."""
        case = self.bar.case(round(self.length / cell), "USL", self.time)
        case["body"][0]["particles_per_direction"] = [particles, 1, 1]
        return case | {"gravity": [0, 0, 0]}

    def displacement(self, X: np.ndarray, t: float) -> np.ndarray:
        """Return the displacement (n, 3) [m] of the points X (n, 3) [m] at time t [s]."""
        return self.bar.displacement(X[:, :1], t) * [1.0, 0.0, 0.0]

    def velocity(self, X: np.ndarray, t: float) -> np.ndarray:
        """Return the velocity (n, 3) [m/s] of the points X (n, 3) [m] at time t [s]."""
        return self.bar.velocity(X[:, :1], t) * [1.0, 0.0, 0.0]

    def gradient(self, X: np.ndarray, t: float) -> np.ndarray:
        """Return the deformation gradient (n, 3, 3) at the start, where nothing is strained."""
        return np.broadcast_to(np.eye(3), (len(X), 3, 3))
