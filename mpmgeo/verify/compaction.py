"""A neo-Hookean column between smooth walls (ν = 0) sinks under its weight to half its height.

    σzz = P = −ρ₀ g (l₀ − Z),    P = μ (Λ − 1/Λ),    Λ = (P + √(P² + 4μ²))/(2μ)

at the height Z of the start: the area stays, so that the stress is statically determined. The place
of a point is the integral of Λ from the floor. Source: Bardenhagen and Kober (2004), Comput. Model.
Eng. Sci. 5, 477–495, here with a neo-Hookean law.
"""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from mpmgeo.verify.problem import Problem


@dataclass(frozen=True)
class Compaction(Problem):
    """Column of 10 m; gravity [m/s²] grows without a jolt and is damped."""

    name: ClassVar[str] = "compaction"
    time: ClassVar[float] = 30.0
    length: ClassVar[float] = 10.0

    young: float = 1e4
    poisson: float = 0.0
    density: float = 80.0
    gravity: float = 9.81

    def case(self, cell: float, particles: int) -> dict:
        """Return the case but for its step; `cell` [m]."""
        corner = [cell, cell, self.length]
        column = {"type": "cuboid", "point_p1": [0, 0, 0], "point_p2": corner, "material_id": 1}
        slowest = np.pi / 2 * self.wave_speed / self.length  # [1/s] of all vibrations, at rest
        return {
            "title": f"Compaction under self-weight, {self.length / cell:.0f} cells",
            "gravity": {
                "value": [0, 0, -self.gravity],
                "ramp": {"type": "sine", "duration": self.time / 2},
            },
            "mesh": {
                "cells_number": [1, 1, round(self.length / cell) + 1],
                "cells_dimension": 3 * [cell],
                "boundary_conditions": {"plane_Zn": "free"},
            },
            "materials": [self.material("neo-hookean")],
            "body": [column | {"particles_per_direction": [1, 1, particles]}],
            "damping": {"type": "mass", "alpha": slowest},
        }

    def start(self, simulation) -> None:
        """Begin at rest."""

    def stress(self, Z: np.ndarray) -> np.ndarray:
        """Return σzz (n,) [Pa] of the points that were Z (n,) [m] above the floor."""
        return -self.density * self.gravity * (self.length - np.asarray(Z))

    def place(self, Z: np.ndarray) -> np.ndarray:
        """Return how high (n,) [m] the points are that were Z (n,) [m] above the floor."""
        nodes, weights = np.polynomial.legendre.leggauss(40)
        share = (nodes + 1) / 2
        Z = np.asarray(Z, float)[..., None]
        return (self._stretch(Z * share) * weights).sum(axis=-1) * Z[..., 0] / 2

    def error(self, simulation) -> float:
        """Return Σ|σzz − exact| V₀ over ρ₀ g l₀ Σ V₀, V₀ the volumes of the start."""
        V = simulation.field("mass") / self.density
        Z = (simulation.field("position") - simulation.field("displacement"))[:, 2]
        off = np.abs(simulation.field("stress")[:, 2] - self.stress(Z))
        return float((off * V).sum() / (self.density * self.gravity * self.length * V.sum()))

    def _stretch(self, Z):
        P, μ = self.stress(Z), self.young / 2
        return (P + np.sqrt(P**2 + 4 * μ**2)) / (2 * μ)
