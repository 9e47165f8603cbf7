"""Mass-proportional damping: a force −α m v, half of it by the velocity after the step.

    v ← [v (1 − αh/2) + h a] / (1 + αh/2),   that is  a ← (a − α v) / (1 + αh/2)

A free body slows down as e^(−αt), to second order in the step.
"""

from dataclasses import dataclass
from typing import ClassVar, NamedTuple

from mpmgeo.damping.damping import Damping, damp
from mpmgeo.parameters import parameter


class Symbols(NamedTuple):
    """Rate of damping [1/s]."""

    α: float


@dataclass(frozen=True)
class MassDamping(Damping):
    """A nodal force against the velocity, proportional to mass and velocity."""

    type: ClassVar[str] = "mass"
    order: ClassVar[int] = 1  # implicit: after all other forces

    alpha: float = parameter("Rate at which free motion decays", unit="1/s", minimum=0)

    @property
    def symbols(self):
        """Return what acts at the nodes."""
        return Symbols(self.alpha)


@damp.register(Symbols)
def mass(model, h, ax, ay, az, vx, vy, vz):
    α = model.α
    w = 1.0 / (1.0 + 0.5 * α * h)
    return w * (ax - α * vx), w * (ay - α * vy), w * (az - α * vz)
