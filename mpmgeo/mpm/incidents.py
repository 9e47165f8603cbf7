"""What may befall particles: they leave the mesh, or diverge."""

from typing import NamedTuple

import numpy as np


class Departure(NamedTuple):
    """Particles that left the mesh in one step."""

    time: float  # [s]
    rows: np.ndarray
    position: np.ndarray  # (3,) of the first [m]


class Unsound(Exception):
    """A particle's state is NaN, infinite or faster than a cell in a step."""

    def __init__(self, material, row, step, time, position, velocity, stress):
        super().__init__(f"particle in row {row} diverged in step {step}")
        self.material, self.row, self.step, self.time = material, row, step, time
        self.position, self.velocity, self.stress = position, velocity, stress
