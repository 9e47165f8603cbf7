"""Mohr–Coulomb: linear elasticity, friction and cohesion, dilation, tension cut-off, softening.

    N σ₃ − σ₁ ≤ σc,    N = (1 + sin φ)/(1 − sin φ),    σc = 2 c √N    (shear)
    σ₃ ≤ T                                                           (tension)

for the principal stresses σ₁ ≤ σ₂ ≤ σ₃. An elastic trial stress beyond the surface returns to it
along the gradient of M σ₃ − σ₁ in shear, M as N with the angle of dilation ψ, and along that of σ₃
in tension. The return keeps the principal axes, so that the plastic strain follows from the drop of
the principal stresses. It gathers as

    εp ← εp + √(⅔ Δεp : Δεp)

with the strengths of εp before the step (`mohr_coulomb_strength.py`). What tension opens has to
close before stress returns (`opening.py`). For large rotations the stress turns with the Jaumann
rate unless another is chosen.

Source: de Souza Neto, Perić and Owen, Computational Methods for Plasticity (2008), chapter 8; at
rest Jaky (1944), J. Soc. Hung. Eng. Archit. 78, 355–358.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from math import inf, radians, sin, sqrt, tan
from typing import ClassVar

from mpmgeo.materials import mohr_coulomb_legacy
from mpmgeo.materials.elastic import Elastic, hooke, hooke_energy
from mpmgeo.materials.law import strain_energy, update_stress
from mpmgeo.materials.mohr_coulomb_return import (
    cut_off,
    flow_number,
    lost_strain,
    return_to_surface,
    tensile_part,
)
from mpmgeo.materials.mohr_coulomb_strength import Constant, Softening, Undrained, strength
from mpmgeo.materials.opening import square_of_flow, strain_of_opening
from mpmgeo.materials.rotation import objective_rate
from mpmgeo.numerics.jit import compiled, inlined
from mpmgeo.numerics.tensors import invariants, on_same_axes, principal
from mpmgeo.parameters import parameter

SOFTENING = ("friction", "dilation", "cohesion", "tensile")
"""The strengths that may soften, by the words of the keys."""


def _after(key, doc, **bounds):
    return parameter(
        f"{doc} after much plastic strain; absent: {key}",
        key=f"softening.{key}.residual",
        default=None,
        minimum=0,
        **bounds,
    )


def _active(key, doc):
    return parameter(f"Whether {doc} softens", key=f"softening.{key}.active", default=False)


@dataclass(frozen=True)
class MohrCoulomb(Elastic):
    """Elastic solid with friction, cohesion, dilation, tension cut-off and softening."""

    type: ClassVar[str] = "mohr-coulomb"

    friction: float = parameter("Angle of friction", unit="°", minimum=0, below=90, default=0.0)
    cohesion: float = parameter("Cohesion", unit="Pa", minimum=0, default=0.0)
    dilation: float = parameter("Angle of dilation", unit="°", minimum=0, below=90, default=0.0)
    tensile: float | None = parameter(
        "Tensile strength; absent: cohesion/tan(friction), unlimited without friction",
        unit="Pa",
        minimum=0,
        default=None,
    )
    su_vertical_stress: float = parameter(
        "Undrained strength over vertical stress; 0: cohesion and friction count instead",
        minimum=0,
        default=0.0,
    )
    softening: str = parameter(
        "How strengths soften with plastic strain",
        choices=("none", "exponential"),
        default="none",
    )
    eta: float = parameter(
        "Rate of exponential softening per plastic strain",
        key="softening.exponential.eta",
        minimum=0,
        default=0.0,
    )
    friction_residual: float | None = _after("friction", "Angle of friction", unit="°", below=90)
    friction_active: bool = _active("friction", "friction")
    dilation_residual: float | None = _after("dilation", "Angle of dilation", unit="°", below=90)
    dilation_active: bool = _active("dilation", "dilation")
    cohesion_residual: float | None = _after("cohesion", "Cohesion", unit="Pa")
    cohesion_active: bool = _active("cohesion", "cohesion")
    tensile_residual: float | None = _after("tensile", "Tensile strength", unit="Pa")
    tensile_active: bool = _active("tensile", "tensile strength")
    objective_rate: str = objective_rate("jaumann")

    def problems(self) -> Iterator[tuple[str, str]]:
        """Yield (key, message) where a strength without bound would have to soften, or as `Law`."""
        yield from super().problems()
        if self._softens("tensile") and self._peak("tensile") == inf:
            yield "tensile", "is required where it softens and friction, 0, does not limit it"

    def remarks(self) -> Iterator[tuple[str, str]]:
        """Yield (key, message) for what is possible, but hardly meant."""
        is_drained = self.su_vertical_stress == 0
        if is_drained and self.friction == 0 and self.cohesion == 0:
            yield "cohesion", "without cohesion and friction there is no strength in shear"
        if is_drained and self.dilation > self.friction:
            yield "dilation", f"exceeds friction, {self.friction:g}: plastic flow creates energy"
        if is_drained and self.friction > 0 and self.tensile is not None:
            apex = self.cohesion / tan(radians(self.friction))
            if self.tensile > apex:
                yield "tensile", f"acts as cohesion/tan(friction), {apex:g}, which it exceeds"
        for key in SOFTENING:
            yield from self._remarks_on_softening(key)
        if self.softening != "none" and self.eta == 0:
            yield "softening.exponential.eta", "softens nothing if it is 0"
        if self.softening != "none" and not any(map(self._softens, SOFTENING)):
            yield "softening", "without effect, since no strength is active in it"

    def _remarks_on_softening(self, key):
        active, none = f"softening.{key}.active", "without effect, since"
        if not getattr(self, f"{key}_active"):
            if getattr(self, f"{key}_residual") is not None:
                yield f"softening.{key}.residual", f"{none} {active} is not true"
        elif self.softening == "none":
            yield active, f'{none} softening is not "exponential"'
        elif self.su_vertical_stress > 0 and key in ("friction", "cohesion"):
            yield active, f"{none} su_vertical_stress takes the place of {key}"

    @property
    def k0_at_rest(self) -> float:
        """Return 1 − sin φ (Jaky 1944), 1 for undrained strength, which knows no φ."""
        return 1.0 - (0.0 if self.su_vertical_stress > 0 else sin(self._peak("friction")))

    def k0_range(self, vertical: float) -> tuple[float, float]:
        """Return Ka and Kp, between which N σ₃ − σ₁ ≤ σc, with principal stresses on the axes."""
        if self.su_vertical_stress > 0:
            return 1 - 2 * self.su_vertical_stress, 1 + 2 * self.su_vertical_stress
        N = flow_number(self._peak("friction"))
        bond = 2 * self.cohesion * sqrt(N) / vertical
        return (1 - bond) / N, N + bond

    def _softens(self, key):
        return self.softening != "none" and getattr(self, f"{key}_active")

    def _peak(self, key):
        """Return a strength before softening, angles in radians."""
        if key in ("friction", "dilation"):
            return radians(getattr(self, key))
        if key == "tensile" and self.tensile is None:
            φ = self._peak("friction")
            return self.cohesion / tan(φ) if φ > 0 else inf
        return getattr(self, key)

    def _residual(self, key):
        """Return a strength after softening, angles in radians; if it does not soften, the peak."""
        if not self._softens(key):
            return self._peak(key)
        value = getattr(self, f"{key}_residual")
        if value is None:
            value = getattr(self, key) or 0.0
        return radians(value) if key in ("friction", "dilation") else value

    @property
    def symbols(self) -> Constant | Softening | Undrained:
        """Return what the kernels use: symbols of one of three types."""
        stiffness = (*super().symbols, self.young, self.poisson)
        φ, ψ, c, T = (self._peak(key) for key in SOFTENING)
        φ_, ψ_, c_, T_ = (self._residual(key) for key in SOFTENING)
        T_loss = T - T_ if T_ < T else 0.0  # an unlimited tension loses nothing
        if self.su_vertical_stress > 0:
            return Undrained(*stiffness, self.su_vertical_stress, self.eta, ψ_, ψ - ψ_, T_, T_loss)
        if any(map(self._softens, SOFTENING)):
            losses = (φ_, φ - φ_, ψ_, ψ - ψ_, c_, c - c_, T_, T_loss)
            return Softening(*stiffness, self.eta, *losses)
        N, M = flow_number(φ), flow_number(ψ)
        σc = 2 * c * sqrt(N)
        return Constant(*stiffness, N, M, σc, cut_off(N, σc, T))

    @property
    def symbols_as_mpm_geomechanics(self) -> mohr_coulomb_legacy.Symbols:
        """Return the symbols of the return that leaves edges and corners alone."""
        φ, ψ, c, T = (self._peak(key) for key in SOFTENING)
        φ_, _, c_, T_ = (self._residual(key) for key in SOFTENING)
        if not self.tensile:
            T = self.cohesion / tan(φ) if φ > 0 else 0.0
            T_ = 0.0 if self._softens("tensile") else T
        strengths = (self.eta, φ, ψ, c, T, φ_, c_, T_, self.su_vertical_stress)
        return mohr_coulomb_legacy.Symbols(*super().symbols, *strengths)


@inlined
def flow(law, p, N, M, σc, T):
    """Return principal stresses, plastic strains and the strain that tension opens, after `p`."""
    s1, s2, s3 = p[0], p[1], p[2]
    y1, y2, y3 = return_to_surface(s1, s2, s3, law.ν / (1.0 - law.ν), N, M, σc, T)
    ε1, ε2, ε3 = lost_strain(s1 - y1, s2 - y2, s3 - y3, law.ν, law.E)
    return y1, y2, y3, ε1, ε2, ε3, tensile_part(ε1, ε2, ε3, M) if y3 == T else 0.0


@compiled
def while_open(law, stress, trial, εp, θ, N, M, σc, T):
    """Return stress and state of what is open by θ; apart from kernels, which seldom need it."""
    was_open = strain_of_opening(law, stress, θ)
    trial = hooke(law, trial, was_open)
    p = principal(trial)
    if N * p[2] - p[0] <= σc and p[2] <= T:
        return trial + (εp, 0.0)
    y1, y2, y3, ε1, ε2, ε3, wide = flow(law, p, N, M, σc, T)
    square = square_of_flow(on_same_axes(p, ε1, ε2, ε3), was_open, θ, wide)
    return on_same_axes(p, y1, y2, y3) + (εp + sqrt(2.0 / 3.0 * square), wide)


@update_stress.register(Constant)
@update_stress.register(Softening)
@update_stress.register(Undrained)
def mohr_coulomb(law, stress, strain, state, dt):
    trial = hooke(law, stress, strain)
    εp, θ = state
    N, M, σc, T = strength(law, trial[2], εp)
    m, s = invariants(trial)
    # whatever the directions: s₃ ≤ m + 2s, and N s₃ − s₁ ≤ (N − 1) m + 2s √(N² + N + 1)
    if θ == 0.0 and (N - 1.0) * m + s * (2.0 * N + 1.5) <= σc and m + 2.0 * s <= T:
        return trial + state
    if θ > 0.0:
        return while_open(law, stress, trial, εp, θ, N, M, σc, T)
    p = principal(trial)
    if N * p[2] - p[0] <= σc and p[2] <= T:
        return trial + state
    y1, y2, y3, ε1, ε2, ε3, wide = flow(law, p, N, M, σc, T)
    εp += sqrt(2.0 / 3.0 * (ε1 * ε1 + ε2 * ε2 + ε3 * ε3))
    return on_same_axes(p, y1, y2, y3) + (εp, wide)


for _symbols in (Constant, Softening, Undrained):
    strain_energy.register(_symbols)(hooke_energy)
