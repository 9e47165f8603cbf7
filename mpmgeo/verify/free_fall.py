"""Free fall from rest, as a scheme with half a first step computes it, without any error.

    v = g (t − Δt/2),    u = g t²/2

Velocities live half a step before positions, so that the sum of v Δt is exactly g t²/2.
"""

import numpy as np


def velocity(gravity: np.ndarray, time: float, time_step: float) -> np.ndarray:
    """Return the velocity (3,) [m/s] that belongs to the state at `time` > 0 [s]."""
    return np.asarray(gravity) * (time - time_step / 2)


def displacement(gravity: np.ndarray, time: float) -> np.ndarray:
    """Return the displacement (3,) [m] at `time` [s]."""
    return np.asarray(gravity) * time**2 / 2


def kinetic_energy(mass: float, gravity: np.ndarray, time: float, time_step: float) -> float:
    """Return the kinetic energy [J] of `mass` [kg] that belongs to the state at `time` > 0 [s]."""
    return mass * float(np.sum(velocity(gravity, time, time_step) ** 2)) / 2
