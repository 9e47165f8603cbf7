"""An elastic column under its own weight, between smooth walls, on a smooth floor.

    σzz = −ρg (H − z),    u = −ρg (H z − z²/2)/M,    M = E (1 − ν)/((1 + ν)(1 − 2ν))

Source: equilibrium of a slice and Hooke's law without lateral strain; small displacements.
"""

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Column:
    """Column of height [m]: young [Pa], poisson [-], density [kg/m³], gravity [m/s²] downwards."""

    height: float
    young: float
    poisson: float
    density: float
    gravity: float

    @property
    def confined_modulus(self) -> float:
        """Return the stiffness without lateral strain, M [Pa]."""
        ν = self.poisson
        return self.young * (1 - ν) / ((1 + ν) * (1 - 2 * ν))

    def vertical_stress(self, z: np.ndarray) -> np.ndarray:
        """Return σzz (n,) [Pa] at heights z (n,) [m] above the floor."""
        return -self.density * self.gravity * (self.height - z)

    def vertical_displacement(self, z: np.ndarray) -> np.ndarray:
        """Return the displacement (n,) [m] along z at heights z (n,) [m] above the floor."""
        weight = self.density * self.gravity
        return -weight * (self.height * z - z**2 / 2) / self.confined_modulus
