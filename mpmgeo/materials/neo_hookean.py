"""Compressible neo-Hookean elasticity, for strains and rotations of any size.

    σ = (λ ln J I + μ (b − I))/J,    b = F Fᵀ,    J = det F
    w = (½ μ (tr b − 3) − μ ln J + ½ λ (ln J)²)/J,    μ = E / (2(1 + ν))

The stress is that of the deformation gradient F, whatever the path: b turns with the material, so
that a rotation makes no stress and needs no objective rate. For small strains it is Hooke's law.

Source: Bonet and Wood, Nonlinear Continuum Mechanics for Finite Element Analysis, 2nd ed. (2008),
section 6.4.3.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from math import log
from typing import ClassVar, NamedTuple

import numpy as np

from mpmgeo.materials.elastic import Elastic
from mpmgeo.materials.hyperelastic import energy_of, stress_of
from mpmgeo.numerics.jit import inlined
from mpmgeo.numerics.matrices import determinant


class Symbols(NamedTuple):
    λ: float
    μ: float

    STATE = ()
    HYPERELASTIC = True


@dataclass(frozen=True)
class NeoHookean(Elastic):
    """Elastic solid for large strains and rotations."""

    type: ClassVar[str] = "neo-hookean"

    @property
    def symbols(self) -> Symbols:
        """Return what the kernels use."""
        λ, G2, _ = self.moduli
        return Symbols(λ, 0.5 * G2)

    def problems(self) -> Iterator[tuple[str, str]]:
        """Yield (key, message) for a rate, and what all laws have to say."""
        yield from super().problems()
        if self.objective_rate != "none":
            message = "its stress turns with the deformation gradient; leave the rate out"
            yield "objective_rate", message

    def stiffening(self, volume, F) -> float:
        """Return by how much ω² of the stiffest particle exceeds what it was at the start, ≥ 1.

        J M = λ (1 − ln J) + μ (1 + b) along an axis of b; Gershgorin's bound stands for b.
        """
        λ, G2, _ = self.moduli
        A = F.reshape(-1, 3, 3)
        b = np.abs(A @ A.transpose(0, 2, 1)).sum(axis=2).max(axis=1)
        M = λ * (1.0 - np.log(volume)) + 0.5 * G2 * (1.0 + b)
        return float((M / (λ + G2)).max(initial=1.0))


@inlined
def left_cauchy_green(F):
    """Return b = F Fᵀ, six components."""
    xx, xy, xz, yx, yy, yz, zx, zy, zz = F
    return (
        xx * xx + xy * xy + xz * xz,
        yx * yx + yy * yy + yz * yz,
        zx * zx + zy * zy + zz * zz,
        xx * yx + xy * yy + xz * yz,
        yx * zx + yy * zy + yz * zz,
        xx * zx + xy * zy + xz * zz,
    )


@stress_of.register(Symbols)
def neo_hookean(law, F):
    J = determinant(F)
    b = left_cauchy_green(F)
    μ, p = law.μ / J, (law.λ * log(J) - law.μ) / J
    return p + μ * b[0], p + μ * b[1], p + μ * b[2], μ * b[3], μ * b[4], μ * b[5]


@energy_of.register(Symbols)
def neo_hookean_energy(law, F):
    J = determinant(F)
    b, lnJ = left_cauchy_green(F), log(J)
    tr = b[0] + b[1] + b[2]
    return (0.5 * law.μ * (tr - 3.0) - law.μ * lnJ + 0.5 * law.λ * lnJ * lnJ) / J
