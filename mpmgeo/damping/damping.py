"""What every kind of damping provides: JSON keys, and what it does at a node or with all particles.

One that acts at the nodes has `symbols`, a NamedTuple for whose type `damp` is registered. One that
acts on the particles as a whole has `effect`, which returns an `Effect`.
"""

from dataclasses import dataclass
from typing import ClassVar

from mpmgeo.numerics.dispatch import generic, in_turn


@dataclass(frozen=True)
class Damping:
    """A kind of damping; `order`: those of low order act first where there are several."""

    order: ClassVar[int] = 0

    @property
    def symbols(self):
        """Return what acts at the nodes, None if nothing does."""
        return None

    def effect(self):
        """Return what acts on the particles as a whole, None if nothing does."""
        return

    def effect_as_mpm_geomechanics(self):
        """Return the same as the program MPM-Geomechanics has it."""
        return self.effect()


@dataclass(frozen=True)
class NoDamping(Damping):
    """No damping."""

    type: ClassVar[str] = "none"


@generic
def damp(model, h, ax, ay, az, vx, vy, vz):
    """Return the acceleration of a node as damping leaves it, three numbers.

    v: velocity before the step [m/s]; h: step of the velocities [s].
    """


damp_all = in_turn(damp, "ax", "ay", "az")
"""`damp` for each of a tuple of models."""
