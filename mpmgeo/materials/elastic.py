"""Isotropic linear elasticity in rate form, without rotation of the stress (small rotations).

    Δσ = λ tr(Δε) I + 2G Δε,    G = E / (2(1 + ν)),    λ = K − 2G/3,    K = E / (3(1 − 2ν))

Source: Timoshenko and Goodier, Theory of Elasticity, 3rd ed., eq. (11).
"""

from dataclasses import dataclass
from math import sqrt
from typing import ClassVar, NamedTuple

from mpmgeo.materials.law import update_stress
from mpmgeo.parameters import parameter


class Symbols(NamedTuple):
    λ: float
    G2: float

    STATE = ()


@dataclass(frozen=True)
class Elastic:
    """Isotropic linear elastic solid."""

    type: ClassVar[str] = "elastic"

    id: int = parameter("Number by which bodies refer to the material")
    density: float = parameter("Initial density", unit="kg/m³", above=0)
    young: float = parameter("Young's modulus", unit="Pa", above=0)
    poisson: float = parameter("Poisson's ratio", above=-1, below=0.5)

    @property
    def symbols(self) -> Symbols:
        """Return what the kernels use."""
        G = self.young / (2 * (1 + self.poisson))
        K = self.young / (3 * (1 - 2 * self.poisson))
        return Symbols(λ=K - 2 * G / 3, G2=2 * G)

    def sound_speed(self) -> float:
        """Return the speed of the compression wave [m/s]."""
        s = self.symbols
        return sqrt((s.λ + s.G2) / self.density)


@update_stress.register(Symbols)
def elastic(law, stress, strain, state, dt):
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
