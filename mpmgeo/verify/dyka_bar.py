"""A wave in an elastic bar: one quarter moves off at first, the other end is fixed.

The bar lies in 0 ≤ x ≤ L and is free at x = 0, where the quarter 0 ≤ x < L/4 has the velocity v₀.
With w, that velocity continued evenly about 0 and oddly about L (period 4L), c = √(E/ρ) and Z = ρc,

    v = ½ [w(x − ct) + w(x + ct)],    σ = ½ Z [w(x + ct) − w(x − ct)]

Source: Dyka and Ingel (1995), Computers & Structures 57, 573–580; d'Alembert's solution.
"""

from dataclasses import dataclass
from math import ceil, sqrt
from typing import ClassVar

import numpy as np

from mpmgeo.simulation import Simulation

GAUSS = (0.5 - 0.5 / sqrt(3.0), 0.5 + 0.5 / sqrt(3.0))
"""Places of two particles in a cell, in cells: the points of Gauss's quadrature."""

FREE_CELLS = 2  # of the mesh before the free end


@dataclass(frozen=True)
class DykaBar:
    """Bar of length [m], density [kg/m³], young [Pa], whose first quarter moves off [m/s]."""

    name: ClassVar[str] = "dyka_bar"

    length: float = 0.1333
    density: float = 7833.0
    young: float = 200e9
    velocity: float = -5.0
    time: float = 1e-4  # at which it is looked at [s]

    @property
    def wave_speed(self) -> float:
        """Return √(E/ρ) [m/s]."""
        return sqrt(self.young / self.density)

    def _continued(self, s):
        """Return w at places s [m]."""
        s = np.mod(s, 4 * self.length) / self.length
        forth, back = (s < 0.25) | (s > 3.75), (s > 1.75) & (s < 2.25)
        return self.velocity * (forth * 1.0 - back)

    def velocity_at(self, x: np.ndarray, time: float) -> np.ndarray:
        """Return the velocity [m/s] of points x [m] at a time [s]."""
        way = self.wave_speed * time
        return 0.5 * (self._continued(x - way) + self._continued(x + way))

    def stress_at(self, x: np.ndarray, time: float) -> np.ndarray:
        """Return the axial stress [Pa] of points x [m] at a time [s]."""
        way, Z = self.wave_speed * time, self.density * self.wave_speed
        return 0.5 * Z * (self._continued(x + way) - self._continued(x - way))

    def case(self, cells: int, scheme="NPC", shape="LME", courant=0.1, particles=2, **keys) -> dict:
        """Return the case of the bar, one cell thick, with `particles` a cell and direction.

        Two lie at the points of Gauss's quadrature, but evenly with GIMP, as any other number.
        """
        h = self.length / cells
        steps = ceil(self.time / (courant * h / self.wave_speed))
        evenly = (np.arange(particles) + 0.5) / particles
        places = GAUSS if particles == 2 and shape != "GIMP" else evenly
        along = (np.arange(cells)[:, None] + places).ravel()
        x, y, z = np.meshgrid(along, places, places, indexing="ij")
        position = h * np.stack([x.ravel(), y.ravel(), z.ravel()], axis=1)
        volume = (h / particles) ** 3
        moves = x.ravel() * h < self.length / 4
        bodies = [
            self._body(position[moves], volume, initial_velocity=[self.velocity, 0.0, 0.0]),
            self._body(position[~moves], volume),
        ]
        return {
            "title": f"Bar of Dyka and Ingel, {cells} cells, {scheme}, {shape}",
            "time": self.time,
            "time_step": self.time / steps,
            "stress_scheme_update": scheme,
            "shape_function": shape,
            "mesh": {
                "origin": [-FREE_CELLS * h, 0.0, 0.0],
                "cells_number": [cells + FREE_CELLS, 1, 1],
                "cells_dimension": [h, h, h],
                "boundary_conditions": {"plane_X0": "free", "plane_Xn": "fixed"},
            },
            "materials": [
                {
                    "type": "elastic",
                    "id": 1,
                    "young": self.young,
                    "density": self.density,
                    "poisson": 0.0,
                }
            ],
            "body": bodies,
            "n_threads": 1,
        } | keys

    def _body(self, position, volume, **keys):
        listing = {"position": position.tolist(), "volume": [volume] * len(position)}
        return {"type": "particles", "material_id": 1, "particles": listing} | keys

    def simulation(
        self, cells, shape="GIMP", scheme="USL", particles=2, courant=0.1, **keys
    ) -> Simulation:
        """Return the simulation of the bar, as those of `verify.problem`."""
        return Simulation(self.case(cells, scheme, shape, courant, particles, **keys))

    def error(self, simulation) -> float:
        """Return the error of velocity in the mean square [m/s]."""
        return self.errors(simulation)[0]

    def errors(self, simulation) -> tuple[float, float]:
        """Return the errors, in the mean square, of velocity [m/s] and axial stress [Pa]."""
        x = simulation.field("position")[:, 0] - simulation.field("displacement")[:, 0]
        v = simulation.field("velocity")[:, 0] - self.velocity_at(x, simulation.time)
        σ = simulation.field("stress")[:, 0] - self.stress_at(x, simulation.time)
        return float(np.sqrt(np.mean(v**2))), float(np.sqrt(np.mean(σ**2)))
