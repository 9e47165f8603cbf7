"""Damping of the motion: one file each, one line each in DAMPINGS."""

from mpmgeo.damping.damping import NoDamping
from mpmgeo.damping.kinetic import KineticDamping
from mpmgeo.damping.local import LocalDamping
from mpmgeo.damping.mass import MassDamping

DAMPINGS = (NoDamping, LocalDamping, KineticDamping, MassDamping)

__all__ = ["DAMPINGS", "KineticDamping", "LocalDamping", "MassDamping", "NoDamping"]
