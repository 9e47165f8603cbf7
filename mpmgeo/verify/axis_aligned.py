"""A neo-Hookean cube in which a standing wave runs along every axis: large strains, no shear.

    u_i = A sin(πX_i) sin(π(φ_i + ct)),    φ = (0, 2/3, 4/3),    c = √(E/ρ)
    F_ii = 1 + Aπ cos(πX_i) sin(π(φ_i + ct)),    J = F_xx F_yy F_zz
    b_i = π² u_i (μ/ρ − c² − (λ (ln J − 1) − μ)/(ρ F_ii²))

It begins deformed, and all faces are planes of symmetry. Source:
Wallstedt and Guilkey (2008), J. Comput. Phys. 227, 9628–9642, here in three dimensions.
"""

from dataclasses import dataclass
from math import pi, sqrt
from typing import ClassVar

import numpy as np

from mpmgeo.verify.problem import Problem

PHASES = np.array([0.0, 2 / 3, 4 / 3])


@dataclass(frozen=True)
class AxisAligned(Problem):
    """Cube of 1 m, `amplitude` of the waves [m]."""

    name: ClassVar[str] = "axis_aligned"
    time: ClassVar[float] = 0.02
    length: ClassVar[float] = 1.0

    young: float = 1e4
    poisson: float = 0.3
    density: float = 1.0
    amplitude: float = 0.05

    @property
    def speed(self) -> float:
        """Return √(E/ρ) [m/s], with which the phase runs."""
        return sqrt(self.young / self.density)

    def case(self, cell: float, particles: int) -> dict:
        """Return the case but for its step; `cell` [m]."""
        number = round(1 / cell)
        cube = {"type": "cuboid", "point_p1": [0, 0, 0], "point_p2": [1, 1, 1], "material_id": 1}
        return {
            "title": f"Axis-aligned manufactured solution, {number} cells",
            "gravity": [0, 0, 0],
            "mesh": {"cells_number": 3 * [number], "cells_dimension": 3 * [cell]},
            "materials": [self.material("neo-hookean")],
            "body": [cube | {"particles_per_direction": 3 * [particles]}],
        }

    def displacement(self, X: np.ndarray, t: float) -> np.ndarray:
        """Return the displacement (n, 3) [m] of the points X (n, 3) [m] at time t [s]."""
        return self.amplitude * np.sin(pi * X) * np.sin(pi * (PHASES + self.speed * t))

    def velocity(self, X: np.ndarray, t: float) -> np.ndarray:
        """Return the velocity (n, 3) [m/s] of the points X (n, 3) [m] at time t [s]."""
        rate = pi * self.speed * self.amplitude
        return rate * np.sin(pi * X) * np.cos(pi * (PHASES + self.speed * t))

    def gradient(self, X: np.ndarray, t: float) -> np.ndarray:
        """Return the deformation gradient (n, 3, 3) at the points X (n, 3) [m] at time t [s]."""
        return self._stretch(X, t)[:, :, None] * np.eye(3)

    def body_force(self, t: float, X: np.ndarray) -> np.ndarray:
        """Return the acceleration (n, 3) [m/s²] that the motion needs."""
        (λ, μ), ρ = self.lame, self.density
        Λ = self._stretch(X, t)
        lnJ = np.log(Λ.prod(axis=1))[:, None]
        factor = μ / ρ - self.speed**2 - (λ * (lnJ - 1) - μ) / (ρ * Λ**2)
        return pi**2 * self.displacement(X, t) * factor

    def _stretch(self, X, t):
        wave = np.cos(pi * X) * np.sin(pi * (PHASES + self.speed * t))
        return 1 + self.amplitude * pi * wave
