"""Newtonian fluid: slightly compressible, linearly viscous.

    σ = (σm + κ tr(Δε)) I + 2μ (D − ⅓ tr(D) I),    D = Δε/Δt

σm is the mean of the old stress: pressure accumulates, viscous stress does not, so that rotation
changes nothing. A fluid of tensile strength T opens voids of the volumetric strain θ where the mean
stress would exceed it, and closes them before it bears pressure again:

    t = σm + κ (θ + tr(Δε)),    σm → min(t, T),    θ → (t − min(t, T))/κ

Source: Batchelor, An Introduction to Fluid Dynamics (1967), eq. (3.3.11).
"""

from dataclasses import dataclass
from math import sqrt
from typing import ClassVar, NamedTuple

from mpmgeo.materials.law import Law, Moduli, strain_energy, update_stress
from mpmgeo.numerics.jit import inlined
from mpmgeo.parameters import parameter


class Symbols(NamedTuple):
    κ: float
    μ: float

    STATE = ()


class Tearing(NamedTuple):
    """A fluid of limited tensile strength T."""

    κ: float
    μ: float
    T: float

    STATE = ("opening",)


@dataclass(frozen=True)
class Newtonian(Law):
    """Slightly compressible viscous fluid."""

    type: ClassVar[str] = "newtonian"
    is_fluid: ClassVar[bool] = True

    viscosity: float = parameter("Dynamic viscosity", unit="Pa s", minimum=0, default=0.0)
    bulk: float = parameter("Bulk modulus", unit="Pa", above=0)
    tensile: float | None = parameter(
        "Largest tensile mean stress, beyond which voids open; absent: unlimited",
        unit="Pa",
        minimum=0,
        default=None,
    )

    @property
    def symbols(self) -> Symbols | Tearing:
        """Return what the kernels use."""
        if self.tensile is None:
            return Symbols(κ=self.bulk, μ=self.viscosity)
        return Tearing(κ=self.bulk, μ=self.viscosity, T=self.tensile)

    @property
    def moduli(self) -> Moduli:
        """Return bulk modulus and viscosity."""
        return Moduli(self.bulk, 0.0, self.viscosity)

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
    mean = (stress[0] + stress[1] + stress[2]) / 3.0
    mean += law.κ * (strain[0] + strain[1] + strain[2])
    return with_viscous_stress(law.μ, mean, strain, dt)


@update_stress.register(Tearing)
def tearing(law, stress, strain, state, dt):
    mean = (stress[0] + stress[1] + stress[2]) / 3.0
    mean += law.κ * (state[0] + strain[0] + strain[1] + strain[2])
    borne = min(mean, law.T)
    return *with_viscous_stress(law.μ, borne, strain, dt), (mean - borne) / law.κ


@strain_energy.register(Symbols)
@strain_energy.register(Tearing)
def compression_energy(law, stress):
    mean = (stress[0] + stress[1] + stress[2]) / 3.0
    return mean * mean / (2.0 * law.κ)


@inlined
def with_viscous_stress(μ, mean, strain, dt):
    """Return six components of stress: the mean one, and that of the deviator of the strain."""
    xx, yy, zz, xy, yz, xz = strain
    q = 2.0 * μ / dt
    p = mean - q * (xx + yy + zz) / 3.0
    return p + q * xx, p + q * yy, p + q * zz, q * xy, q * yz, q * xz
