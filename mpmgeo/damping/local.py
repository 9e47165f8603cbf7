"""Local damping: a force against the velocity, a share of the out-of-balance force.

    a ← a − α |a| v/|v|

Source: Cundall (1987), in Brown (ed.), Analytical and Computational Methods in Engineering Rock
Mechanics, chapter 4.
"""

from dataclasses import dataclass
from typing import ClassVar, NamedTuple

from mpmgeo.damping.damping import Damping, damp
from mpmgeo.parameters import parameter


class Symbols(NamedTuple):
    """Share of the out-of-balance force [-]."""

    α: float


@dataclass(frozen=True)
class LocalDamping(Damping):
    """A nodal force against the velocity, a share of the out-of-balance force (Cundall 1987)."""

    type: ClassVar[str] = "local"

    value: float = parameter("Share of the out-of-balance force", minimum=0, maximum=1, default=0.0)

    @property
    def symbols(self):
        """Return what acts at the nodes, None if nothing does."""
        return Symbols(self.value) if self.value else None


@damp.register(Symbols)
def local(model, h, ax, ay, az, vx, vy, vz):
    speed = (vx * vx + vy * vy + vz * vz) ** 0.5
    if speed < 1e-300:
        return ax, ay, az
    f = model.α * (ax * ax + ay * ay + az * az) ** 0.5 / speed
    return ax - f * vx, ay - f * vy, az - f * vz
