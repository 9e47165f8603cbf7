"""Newtonian fluid: slightly compressible, linearly viscous.

    σ = (σm + κ tr(Δε)) I + 2μ (D − ⅓ tr(D) I),    D = Δε/Δt

σm is the mean of the old stress: pressure accumulates, viscous stress does not, so that rotation
changes nothing. There is no cavitation: the mean stress may become tensile.

Source: Batchelor, An Introduction to Fluid Dynamics (1967), eq. (3.3.11).
"""

from dataclasses import dataclass
from math import sqrt
from typing import ClassVar, NamedTuple

from mpmgeo.materials.law import Law, update_stress
from mpmgeo.parameters import parameter


class Symbols(NamedTuple):
    κ: float
    μ: float

    STATE = ()


@dataclass(frozen=True)
class Newtonian(Law):
    """Slightly compressible viscous fluid."""

    type: ClassVar[str] = "newtonian"

    viscosity: float = parameter("Dynamic viscosity", unit="Pa s", minimum=0, default=0.0)
    bulk: float = parameter("Bulk modulus", unit="Pa", above=0)

    @property
    def symbols(self) -> Symbols:
        """Return what the kernels use."""
        return Symbols(κ=self.bulk, μ=self.viscosity)

    def sound_speed(self) -> float:
        """Return the speed of the compression wave [m/s]."""
        return sqrt(self.bulk / self.density)

    def critical_time_step(self, cell: float, speed: float) -> float:
        """Return the largest stable step [s] in a `cell` [m] where particles move at `speed` [m/s].

        The fastest wave that cells of the size h hold, ω = 2c/h, is damped by ξ = 4μ/(3ρch) times
        the critical damping: Δt = 2/ω (√(1 + ξ²) − ξ), for large viscosity 3ρh²/(8μ). Source:
        Belytschko, Liu and Moran, Nonlinear Finite Elements (2000), section 6.2.
        """
        ξ = 4 * self.viscosity / (3 * self.density * self.sound_speed() * cell)
        # √(1 + ξ²) − ξ without the difference of two large numbers
        return super().critical_time_step(cell, speed) / (sqrt(1 + ξ * ξ) + ξ)


@update_stress.register(Symbols)
def newtonian(law, stress, strain, state, dt):
    xx, yy, zz, xy, yz, xz = strain
    tr = xx + yy + zz
    p = (stress[0] + stress[1] + stress[2]) / 3.0 + law.κ * tr
    q = 2.0 * law.μ / dt
    p -= q * tr / 3.0
    return p + q * xx, p + q * yy, p + q * zz, q * xy, q * yz, q * xz
