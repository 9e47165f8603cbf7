"""Isotropic linear elasticity in rate form; without an objective rate for small rotations only.

    Δσ = λ tr(Δε) I + 2G Δε,    G = E / (2(1 + ν)),    λ = K − 2G/3,    K = E / (3(1 − 2ν))

Source: Timoshenko and Goodier, Theory of Elasticity, 3rd ed., eq. (11).
"""

from dataclasses import dataclass
from math import sqrt
from typing import ClassVar, NamedTuple

from mpmgeo.materials.law import Law, Moduli, strain_energy, update_stress
from mpmgeo.numerics.jit import inlined
from mpmgeo.parameters import parameter


class Symbols(NamedTuple):
    λ: float
    G2: float

    STATE = ()


@dataclass(frozen=True)
class Elastic(Law):
    """Isotropic linear elastic solid."""

    type: ClassVar[str] = "elastic"

    young: float = parameter("Young's modulus", unit="Pa", above=0)
    poisson: float = parameter("Poisson's ratio", above=-1, below=0.5)

    @property
    def symbols(self) -> Symbols:
        """Return what the kernels use."""
        λ, G2, _ = self.moduli
        return Symbols(λ, G2)

    @property
    def moduli(self) -> Moduli:
        """Return λ and 2G, without viscosity."""
        G = self.young / (2 * (1 + self.poisson))
        K = self.young / (3 * (1 - 2 * self.poisson))
        return Moduli(λ=K - 2 * G / 3, G2=2 * G)

    @property
    def k0_at_rest(self) -> float:
        """Return ν/(1 − ν), that of a load without lateral strain."""
        return self.poisson / (1 - self.poisson)

    def sound_speed(self) -> float:
        """Return the speed of the compression wave [m/s]."""
        E, ν = self.young, self.poisson
        return sqrt(E * (1 - ν) / ((1 + ν) * (1 - 2 * ν) * self.density))


@inlined
def hooke(law, stress, strain):
    """Return the stress after an elastic strain increment, for any law with λ and G2 [Pa]."""
    xx, yy, zz, xy, yz, xz = strain
    p = law.λ * (xx + yy + zz)
    return (
        stress[0] + p + law.G2 * xx,
        stress[1] + p + law.G2 * yy,
        stress[2] + p + law.G2 * zz,
        stress[3] + law.G2 * xy,
        stress[4] + law.G2 * yz,
        stress[5] + law.G2 * xz,
    )


@update_stress.register(Symbols)
def elastic(law, stress, strain, state, dt):
    return hooke(law, stress, strain)


@strain_energy.register(Symbols)
@inlined
def hooke_energy(law, stress):
    """Return ½ σ : ε [J/m³] for the elastic strain of a stress, for any law with λ and G2."""
    xx, yy, zz, xy, yz, xz = stress
    tr = xx + yy + zz
    square = xx * xx + yy * yy + zz * zz + 2.0 * (xy * xy + yz * yz + xz * xz)
    return (square - law.λ / (3.0 * law.λ + law.G2) * tr * tr) / (2.0 * law.G2)
