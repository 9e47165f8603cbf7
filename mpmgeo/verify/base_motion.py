"""A base that moves as a sine in each direction.

    v = A sin(2πft + α),    a = A 2πf cos(2πft + α),    u = A/(2πf) (cos α − cos(2πft + α))

A phase α of π or 0 lets the base start from rest.
"""

from dataclasses import dataclass
from math import pi
from pathlib import Path

import numpy as np


@dataclass(frozen=True)
class SineMotion:
    """Motion along x, y, z: velocity amplitude [m/s], frequency [Hz] above 0 and phase [rad]."""

    amplitude: tuple[float, float, float]
    frequency: tuple[float, float, float]
    phase: float

    def displacement(self, time: np.ndarray) -> np.ndarray:
        """Return the displacement (n, 3) [m] since time 0 at instants (n,) [s]."""
        A, ω, angle = self._terms(time)
        return A / ω * (np.cos(self.phase) - np.cos(angle))

    def velocity(self, time: np.ndarray) -> np.ndarray:
        """Return the velocity (n, 3) [m/s] at instants (n,) [s]."""
        A, _, angle = self._terms(time)
        return A * np.sin(angle)

    def acceleration(self, time: np.ndarray) -> np.ndarray:
        """Return the acceleration (n, 3) [m/s²] at instants (n,) [s]."""
        A, ω, angle = self._terms(time)
        return A * ω * np.cos(angle)

    def write_record(self, path: Path | str, end: float, interval: float) -> None:
        """Write the accelerations from 0 to `end` [s] every `interval` [s] as a text file."""
        time = np.arange(round(end / interval) + 1) * interval
        rows = np.column_stack([time, self.acceleration(time)])
        np.savetxt(path, rows, fmt="%.8g", delimiter=",", header="t,ax,ay,az", comments="")

    def _terms(self, time):
        ω = 2 * pi * np.array(self.frequency)
        return np.array(self.amplitude), ω, np.multiply.outer(time, ω) + self.phase
