"""Two discs meet head on in plane strain, and part again: energy and momentum stay what they were.

Discs of the radius r whose centres are d apart, each at the speed v, meet at t = (d − 2r)/(2v).
What energy is lost is the method's. Source: Sulsky, Chen and Schreyer (1994), Comput. Methods Appl.
Mech. Eng. 118, 179–196, here with a neo-Hookean law.
"""

from dataclasses import dataclass
from math import hypot, pi
from typing import ClassVar

import numpy as np

from mpmgeo.verify.problem import Problem, plane_strain


@dataclass(frozen=True)
class CollidingDiscs(Problem):
    """Discs of the radius 0.2 m in a square of 1 m; `speed` [m/s] of each along either axis."""

    name: ClassVar[str] = "colliding_discs"
    time: ClassVar[float] = 3.5
    length: ClassVar[float] = 1.0
    radius: ClassVar[float] = 0.2
    centre: ClassVar[float] = 0.2

    young: float = 1e3
    poisson: float = 0.3
    density: float = 1e3
    speed: float = 0.1

    @property
    def contact(self) -> float:
        """Return when they meet [s]."""
        return (hypot(0.6, 0.6) - 2 * self.radius) / (2 * self.fastest)

    @property
    def kinetic_energy(self) -> float:
        """Return the kinetic energy of both in a metre of thickness, before they meet [J/m]."""
        return self.density * pi * self.radius**2 * 2 * self.speed**2

    @property
    def fastest(self) -> float:
        """Return the speed of a disc [m/s]."""
        return hypot(self.speed, self.speed)

    def case(self, cell: float, particles: int) -> dict:
        """Return the case but for its step; `cell` [m]."""
        bodies = [
            _disc(centre, self.radius, cell, particles) | {"initial_velocity": [v, v, 0]}
            for centre, v in ((self.centre, self.speed), (1 - self.centre, -self.speed))
        ]
        return {
            "title": f"Colliding discs, {1 / cell:.0f} cells",
            "gravity": [0, 0, 0],
            "mesh": plane_strain(cell, (0.0, 0.0), (1.0, 1.0)),
            "materials": [self.material("neo-hookean")],
            "body": bodies,
        }

    def start(self, simulation) -> None:
        """Begin as the bodies of the case do."""

    def error(self, simulation) -> float:
        """Return by how much energy has changed, in shares of that of the start."""
        now = simulation.solver.tally()
        start = float((now.mass * self.speed**2).sum())
        return abs(float((now.kinetic + now.strain).sum()) / start - 1)

    def momentum(self, simulation) -> np.ndarray:
        """Return the momentum (3,) in shares of Σ m |v| at the start."""
        now = simulation.solver.tally()
        return now.momentum.sum(axis=0) / (now.mass.sum() * self.fastest)


def _disc(centre, radius, cell, particles, corners=400):
    """Return a disc one cell thick as a body; `centre` is that of either axis [m]."""
    φ = 2 * pi * np.arange(corners) / corners
    x, y = centre + radius * np.cos(φ), centre + radius * np.sin(φ)
    return {
        "type": "polygon_2d",
        "points": np.stack([x, y, 0 * φ], axis=1).tolist(),
        "extrude_direction": "z",
        "extrude_displacement": cell,
        "discretization_length": cell,
        "particles_per_direction": [particles, particles, 1],
        "material_id": 1,
    }
