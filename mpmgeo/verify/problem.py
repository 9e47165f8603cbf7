"""What problems with exact solutions have in common: one file each, listed in `verify/problems.py`.

    problem = Vortex()
    simulation = problem.simulation(10, shape="cubic-bspline", scheme="MUSL").run()
    problem.error(simulation)

`cells` counts cells along the length that the problem says, and the step is the longest below a
share of the critical one that divides its time, so that an error against the run time can be had of
any shape, scheme and number of particles alike.
"""

from dataclasses import dataclass
from math import ceil
from typing import ClassVar

import numpy as np

from mpmgeo.simulation import Simulation
from mpmgeo.verify.convergence import Convergence


@dataclass(frozen=True)
class Problem:
    """A motion that is known; SI units. A problem says `case`, and of the motion what it has."""

    name: ClassVar[str]
    time: ClassVar[float]  # [s] at which the error is measured
    length: ClassVar[float]  # [m] that the cells divide

    young: float
    poisson: float
    density: float

    def case(self, cell: float, particles: int) -> dict:
        """Return the case but for its step: cubic cells [m], `particles` in a cell and axis."""
        raise NotImplementedError

    def displacement(self, X: np.ndarray, t: float) -> np.ndarray:
        """Return the displacement (n, 3) [m] of the points X (n, 3) [m] at time t [s]."""
        raise NotImplementedError

    def velocity(self, X: np.ndarray, t: float) -> np.ndarray:
        """Return the velocity (n, 3) [m/s] of the points X (n, 3) [m] at time t [s]."""
        raise NotImplementedError

    def gradient(self, X: np.ndarray, t: float) -> np.ndarray:
        """Return the deformation gradient (n, 3, 3) at the points X (n, 3) [m] at time t [s]."""
        raise NotImplementedError

    body_force = None
    """None, or a function (t, X) that returns the acceleration (n, 3) [m/s²] it needs."""

    fastest = 0.0
    """Largest speed of a particle [m/s], where it counts beside that of waves."""

    @property
    def lame(self) -> tuple[float, float]:
        """Return λ and μ [Pa]."""
        E, ν = self.young, self.poisson
        return E * ν / ((1 + ν) * (1 - 2 * ν)), E / (2 * (1 + ν))

    @property
    def wave_speed(self) -> float:
        """Return the speed of the compression wave [m/s]."""
        λ, μ = self.lame
        return ((λ + 2 * μ) / self.density) ** 0.5

    def material(self, kind: str) -> dict:
        """Return the material of a type of law."""
        values = {"density": self.density, "young": self.young, "poisson": self.poisson}
        return {"type": kind, "id": 1} | values

    def simulation(
        self,
        cells: int,
        shape: str = "GIMP",
        scheme: str = "USL",
        particles: int = 2,
        courant: float = 0.2,
        **keys,
    ) -> Simulation:
        """Return the simulation of the problem as it begins, `keys` added to its case.

        `courant`: largest step, in shares of the time of a wave across a cell, particles moving.
        """
        cell = self.length / cells
        speed = self.wave_speed + self.fastest
        steps = ceil(self.time * speed / (courant * cell) - 1e-9)
        case = self.case(cell, particles) | {
            "time": self.time,
            "time_step": self.time / steps,
            "shape_function": shape,
            "stress_scheme_update": scheme,
        }
        simulation = Simulation(case | keys, body_force=self.body_force)
        self.start(simulation)
        return simulation

    def start(self, simulation: Simulation) -> None:
        """Give the particles the displacements, gradients and velocities of time 0."""
        X = simulation.field("position")
        simulation.assign("displacement", self.displacement(X, 0.0))
        simulation.assign("deformation_gradient", self.gradient(X, 0.0))
        simulation.assign("velocity", self.velocity(X, 0.0))

    def error(self, simulation: Simulation) -> float:
        """Return the root mean square of the errors of the displacement [m]."""
        u = simulation.field("displacement")
        X = simulation.field("position") - u
        off = u - self.displacement(X, simulation.time)
        return float(np.sqrt((off**2).sum(axis=1).mean()))

    def refined(self, cells, **choices) -> Convergence:
        """Return the errors with each of several numbers of `cells`, run with the same choices."""
        errors = [self.error(self.simulation(n, **choices).run()) for n in cells]
        return Convergence(self.length / np.array(cells), np.array(errors))


def plane_strain(cell: float, low, high, **planes) -> dict:
    """Return a mesh one cell thick from `low` to `high` (2,) [m], free but for its two sides."""
    number = [round((b - a) / cell) for a, b in zip(low, high, strict=True)]
    sides = dict.fromkeys(("plane_X0", "plane_Y0", "plane_Xn", "plane_Yn"), "free")
    return {
        "origin": [*low, 0.0],
        "cells_number": [*number, 1],
        "cells_dimension": 3 * [cell],
        "boundary_conditions": sides | dict.fromkeys(("plane_Z0", "plane_Zn"), "sliding") | planes,
    }


def sector(inner, outer, angle: float, cell: float, particles: int) -> dict:
    """Return a ring, or a part of it from the x axis on, one cell thick, in circles of particles.

    `inner`, `outer`: radii [m]; `angle`: of the part [rad]. Every particle has the volume of its
    share of a circle; shapes that know sizes take it for a cube.
    """
    circles = max(1, round((outer - inner) / cell * particles))
    thickness = (outer - inner) / circles
    position, volume = [], []
    for r in inner + thickness * (np.arange(circles) + 0.5):
        count = round(angle * r / thickness)
        φ = angle * (np.arange(count) + 0.5) / count
        position.append(np.stack([r * np.cos(φ), r * np.sin(φ), np.full(count, cell / 2)], axis=1))
        volume.append(np.full(count, r * thickness * angle / count * cell))
    particles = {
        "position": np.concatenate(position).tolist(),
        "volume": np.concatenate(volume).tolist(),
    }
    return {"type": "particles", "material_id": 1, "particles": particles}
