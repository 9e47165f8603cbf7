"""Damping of the motion: what a case may ask for. The forces act in `mpm/grid_update.py`."""

from dataclasses import dataclass
from typing import ClassVar

from mpmgeo.parameters import parameter


@dataclass(frozen=True)
class NoDamping:
    """No damping."""

    type: ClassVar[str] = "none"


@dataclass(frozen=True)
class LocalDamping:
    """A nodal force against the velocity, a share of the out-of-balance force (Cundall 1987)."""

    type: ClassVar[str] = "local"

    value: float = parameter("Share of the out-of-balance force", minimum=0, default=0.0)


@dataclass(frozen=True)
class KineticDamping:
    """All velocities set to zero whenever the kinetic energy has passed a peak (Cundall 1982)."""

    type: ClassVar[str] = "kinetic"


DAMPINGS = (NoDamping, LocalDamping, KineticDamping)
