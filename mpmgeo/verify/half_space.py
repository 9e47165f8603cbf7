"""An elastic half-space under a vertical force at one point of its surface.

    u_r = P/(4πG) (r z/d³ − (1 − 2ν) r/(d (d + z))),    u_z = P/(4πG d) (2(1 − ν) + z²/d²)

with r the distance from the axis, z the depth, d² = r² + z². Source: Boussinesq (1885), in
Johnson, Contact Mechanics (1985), eqs. (3.18) and (3.19).
"""

from dataclasses import dataclass
from math import pi

import numpy as np


@dataclass(frozen=True)
class HalfSpace:
    """Half-space below z = 0: young [Pa], poisson [-], force [N] pressing down at the origin."""

    young: float
    poisson: float
    force: float

    def displacement(self, position: np.ndarray) -> np.ndarray:
        """Return the displacement (n, 3) [m] at points (n, 3) [m] relative to the force, z up.

        Source: Johnson, eqs. (3.18a, b).
        """
        x, y, z, d = _coordinates(position)
        G = self.young / (2 * (1 + self.poisson))
        c = self.force / (4 * pi * G)
        outward = c * (z / d**3 - (1 - 2 * self.poisson) / (d * (d + z)))
        down = c / d * (2 * (1 - self.poisson) + z**2 / d**2)
        return np.stack([outward * x, outward * y, -down], axis=-1)

    def stress(self, position: np.ndarray) -> np.ndarray:
        """Return the stress (n, 6) [Pa], xx yy zz xy yz xz, at points (n, 3) [m], z up.

        Source: Johnson, eqs. (3.19a–d), with (σr − σθ)/r² reduced so that the axis is no exception.
        """
        x, y, z, d = _coordinates(position)
        c = self.force / (2 * pi)
        k = 1 - 2 * self.poisson
        hoop = -c * k * (1 / (d * (d + z)) - z / d**3)
        radial = c * (k * (2 * d + z) / (d**3 * (d + z) ** 2) - 3 * z / d**5)
        shear = 3 * c * z**2 / d**5
        xx, yy, xy = hoop + radial * x**2, hoop + radial * y**2, radial * x * y
        return np.stack([xx, yy, -shear * z, xy, shear * y, shear * x], axis=-1)


def _coordinates(position):
    x, y, up = np.moveaxis(np.asarray(position, float), -1, 0)
    return x, y, -up, np.sqrt(x**2 + y**2 + up**2)
