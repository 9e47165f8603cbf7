"""Confined compression of a Mohr–Coulomb material from a stress-free state.

Without lateral strain the stresses grow elastically to yield, then along the edge of the surface
where the two lateral stresses are equal:

    σ = A ε,    σ' = B ε,    A = K + 4G/3,    B = K − 2G/3              until N σ' − σ = σc
    dσ = A dε − dλ (B M − A),    dσ' = B dε − dλ (M (A + B)/2 − B),    N dσ' = dσ

and elastically again when the strain turns. Strain and stress are axial, compression negative.

Source: the theory of de Souza Neto, Perić and Owen, Computational Methods for Plasticity (2008),
section 8.2, in one dimension.
"""

from dataclasses import dataclass

import numpy as np

from mpmgeo.materials.law import Law
from mpmgeo.materials.mohr_coulomb import strength


@dataclass(frozen=True)
class Oedometer:
    """Confined compression of a `law` of Mohr and Coulomb whose strengths are constant."""

    law: Law

    @property
    def modulus(self) -> float:
        """Return the elastic stiffness A [Pa]."""
        return self.law.symbols.λ + self.law.symbols.G2

    @property
    def yield_strain(self) -> float:
        """Return the strain at first yield [-]."""
        N, _, σc, _ = strength(self.law.symbols, 0.0, 0.0)
        return -σc / (self.modulus - N * self.law.symbols.λ)

    @property
    def plastic_modulus(self) -> float:
        """Return the stiffness in plastic flow [Pa]."""
        N, M, _, _ = strength(self.law.symbols, 0.0, 0.0)
        A, B = self.modulus, self.law.symbols.λ
        axial, lateral = B * M - A, M * (A + B) / 2 - B
        λ = (N * B - A) / (N * lateral - axial)
        return A - λ * axial

    def stress(self, strain: np.ndarray, unloaded_from: float | None = None) -> np.ndarray:
        """Return the axial stress (n,) [Pa] at strains (n,) of the first loading.

        With `unloaded_from`, the strains follow an unloading from there, before it yields again.
        """
        if unloaded_from is not None:
            return self.stress(unloaded_from) + self.modulus * (np.asarray(strain) - unloaded_from)
        elastic = np.maximum(strain, self.yield_strain)
        return self.modulus * elastic + self.plastic_modulus * (np.asarray(strain) - elastic)
