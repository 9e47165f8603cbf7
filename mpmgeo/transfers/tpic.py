"""TPIC: particles take the nodes' velocity and its gradient, that of the shape's own slopes.

    v ← Σ S u,   C ← Σ u ⊗ ∇S

Source: Nakamura, Matsumura and Mizutani (2023), Comput. Methods Appl. Mech. Engrg. 403, 115720.
"""

from dataclasses import dataclass
from typing import ClassVar, NamedTuple

from mpmgeo.transfers.transfer import Transfer, carried, gradient_stencil


class Symbols(NamedTuple):
    """Nothing to choose."""


@dataclass(frozen=True)
class Tpic(Transfer):
    """Particles take on velocity and velocity gradient of the nodes."""

    type: ClassVar[str] = "tpic"
    is_affine: ClassVar[bool] = True

    @property
    def symbols(self):
        """Return what kernels take for it."""
        return Symbols()


@carried.register(Symbols)
def tpic(transfer, h, v, u, a):
    return u


@gradient_stencil.register(Symbols)
def own(transfer, w):
    return None
