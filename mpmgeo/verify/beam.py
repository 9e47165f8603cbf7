"""Bending of a slender cantilever with rectangular section, clamped at x = 0, shear included.

    EI w″″ = q,    w = q/(24EI) (x⁴ − 4lx³ + 6l²x²) + q/(κGA) (lx − x²/2)    (load q along the beam)
    w = F/(6EI) (3lx² − x³) + F x/(κGA)                                       (load F at its end)

Source: Timoshenko and Gere, Mechanics of Materials (1972), ch. 6 and 7; κ = 5/6. Between two
smooth planes the beam cannot widen: E/(1 − ν²) stands for E.
"""

from dataclasses import dataclass

import numpy as np

SHEAR_FACTOR = 5 / 6


@dataclass(frozen=True)
class Cantilever:
    """Cantilever of length and depth [m], in plane strain: young [Pa], poisson [-]."""

    length: float
    depth: float
    young: float
    poisson: float

    @property
    def bending_stiffness(self) -> float:
        """Return EI of a strip one metre wide [N m]."""
        return self.young / (1 - self.poisson**2) * self.depth**3 / 12

    @property
    def shear_stiffness(self) -> float:
        """Return κGA of a strip one metre wide [N/m]."""
        return SHEAR_FACTOR * self.young / (2 * (1 + self.poisson)) * self.depth

    def under_uniform_load(self, load: float, x: np.ndarray) -> np.ndarray:
        """Return the deflection (n,) [m] at x (n,) [m] under `load` [N/m²] along the beam."""
        l = self.length
        bending = load / (24 * self.bending_stiffness) * (x**4 - 4 * l * x**3 + 6 * l**2 * x**2)
        return bending + load / self.shear_stiffness * (l * x - x**2 / 2)

    def under_end_load(self, load: float, x: np.ndarray) -> np.ndarray:
        """Return the deflection (n,) [m] at x (n,) [m] under `load` [N/m] at the end."""
        bending = load / (6 * self.bending_stiffness) * (3 * self.length * x**2 - x**3)
        return bending + load / self.shear_stiffness * x
