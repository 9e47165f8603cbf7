"""Axial vibration of an elastic bar, fixed at x = 0 and free at x = l, in one of its modes.

    v = v₀ cos ωt sin βx,    u = v₀/ω sin ωt sin βx,    β = (2k − 1) π/(2l),    ω = β √(E/ρ)

Source: Timoshenko, Vibration Problems in Engineering, 2nd ed. (1937), art. 50. It holds for small
displacements and no lateral strain (ν = 0).
"""

from dataclasses import dataclass
from math import ceil, cos, pi, sin, sqrt

import numpy as np


@dataclass(frozen=True)
class Bar:
    """Bar of length [m], young [Pa], density [kg/m³], peak velocity [m/s], in mode 1, 2, …"""

    length: float = 25.0
    young: float = 100.0
    density: float = 1.0
    velocity_peak: float = 1e-3
    mode: int = 1

    @property
    def wave_number(self) -> float:
        """Return β [1/m]."""
        return (2 * self.mode - 1) * pi / (2 * self.length)

    @property
    def wave_speed(self) -> float:
        """Return √(E/ρ) [m/s]."""
        return sqrt(self.young / self.density)

    @property
    def angular_frequency(self) -> float:
        """Return ω [rad/s]."""
        return self.wave_number * self.wave_speed

    @property
    def period(self) -> float:
        """Return the time of one vibration [s]."""
        return 2 * pi / self.angular_frequency

    @property
    def displacement_peak(self) -> float:
        """Return the largest displacement of the mode [m]."""
        return self.velocity_peak / self.angular_frequency

    def velocity(self, x: np.ndarray, time: float) -> np.ndarray:
        """Return the axial velocity (n,) [m/s] of the points x (n,) [m] at `time` [s]."""
        return self._shape(x) * self.velocity_peak * cos(self.angular_frequency * time)

    def displacement(self, x: np.ndarray, time: float) -> np.ndarray:
        """Return the axial displacement (n,) [m] of the points x (n,) [m] at `time` [s]."""
        return self._shape(x) * self.displacement_peak * sin(self.angular_frequency * time)

    def _shape(self, x):
        return np.sin(self.wave_number * np.asarray(x))

    def case(self, cells: int, scheme: str, time: float, courant: float = 0.5) -> dict:
        """Return the case of the bar, one cell thick, in `cells` cells along its length.

        The step is the largest that divides `time` [s] and moves a wave no more than `courant`
        cells; the motion starts when `start` sets the velocities.
        """
        h = self.length / cells
        steps = ceil(time * self.wave_speed / (courant * h) - 1e-9)
        return {
            "title": f"Axial vibration of a bar, {cells} cells, {scheme}",
            "time": time,
            "time_step": time / steps,
            "stress_scheme_update": scheme,
            # Two more cells, so that the free end never meets the far plane.
            "mesh": {"cells_number": [cells + 2, 1, 1], "cells_dimension": [h, h, h]},
            "materials": [
                {
                    "type": "elastic",
                    "id": 1,
                    "young": self.young,
                    "density": self.density,
                    "poisson": 0.0,
                }
            ],
            "body": [
                {
                    "type": "cuboid",
                    "point_p1": [0, 0, 0],
                    "point_p2": [self.length, h, h],
                    "material_id": 1,
                }
            ],
            "n_threads": 1,
        }

    def start(self, simulation) -> np.ndarray:
        """Give the particles the velocity of time 0 and return their x (n,) [m]."""
        position = simulation.field("position")
        velocity = np.zeros_like(position)
        velocity[:, 0] = self.velocity(position[:, 0], 0.0)
        simulation.assign("velocity", velocity)
        return position[:, 0]
