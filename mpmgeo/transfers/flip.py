"""FLIP: particles keep their velocity and take on what the nodes' changes; PIC blended in.

    v ← f (v + h Σ S a) + (1 − f) Σ S u

u, a: velocity after the step and acceleration of the nodes. The share 1 − f takes noise that no
node sees away, and motion that is finer than the cells.

Source: Brackbill and Ruppel (1986), J. Comput. Phys. 65, 314–343; the blend: Stomakhin, Schroeder,
Chai, Teran and Selle (2013), ACM Trans. Graph. 32, 102.
"""

from dataclasses import dataclass
from typing import ClassVar, NamedTuple

from mpmgeo.parameters import parameter
from mpmgeo.transfers.transfer import Transfer, carried


class Blend(NamedTuple):
    """Share of FLIP [-]."""

    f: float


@dataclass(frozen=True)
class Flip(Transfer):
    """Particles take on what the velocity of the nodes changes by."""

    type: ClassVar[str] = "flip"

    flip: float = parameter(
        "Share of the change; the rest is the velocity of the nodes",
        minimum=0,
        maximum=1,
        default=1.0,
    )

    @property
    def symbols(self):
        """Return what kernels take for it, None for plain FLIP."""
        return None if self.flip == 1.0 else Blend(self.flip)


@carried.register(Blend)
def blend(transfer, h, v, u, a):
    return transfer.f * (v + h * a) + (1.0 - transfer.f) * u
