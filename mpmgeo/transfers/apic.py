"""APIC: particles take the nodes' velocity and the linear field about them that fits it best.

    v ← Σ S u,   C ← (Σ S u ⊗ (x_n − x_p)) D⁻¹,   D = Σ S (x_n − x_p) ⊗ (x_n − x_p)

D is diagonal, as shapes are products, and taken from the weights themselves, which walls may cut.

Source: Jiang, Schroeder, Selle, Teran and Stomakhin (2015), ACM Trans. Graph. 34, 51.
"""

from dataclasses import dataclass
from typing import ClassVar, NamedTuple

from numba.cpython.unsafe.tuple import tuple_setitem

from mpmgeo.transfers.transfer import Transfer, carried, gradient_stencil, with_moments


class Symbols(NamedTuple):
    """Nothing to choose."""


@dataclass(frozen=True)
class Apic(Transfer):
    """Particles take on the velocity of the nodes and the affine field that conserves spin."""

    type: ClassVar[str] = "apic"
    is_affine: ClassVar[bool] = True

    @property
    def symbols(self):
        """Return what kernels take for it."""
        return Symbols()


@carried.register(Symbols)
def apic(transfer, h, v, u, a):
    return u


@gradient_stencil.register(Symbols)
def fitted(transfer, w):
    w, S = with_moments(w), len(w) // 2
    D = w[S + 1]  # Σ S (x_n − x_p)² is Σ S (x_n − x_p) x_n
    for i in range(2, S):
        D = D + w[S + i] * (1.0 * i)
    for i in range(S):
        w = tuple_setitem(w, S + i, w[S + i] / D)
    return w
