"""Pressures of the pore fluid and forces on it: they act with two phases."""

from dataclasses import dataclass

from mpmgeo.parameters import Vector, parameter
from mpmgeo.region import Box


@dataclass(frozen=True)
class PrescribedPressureBox(Box):
    """A pore pressure that the particles which start in a closed box keep."""

    pressure: float = parameter("Pore pressure, compression positive", unit="Pa")


@dataclass(frozen=True)
class InitialPressureBox(Box):
    """A pore pressure at the start of the particles in a closed box."""

    pressure: float = parameter("Pore pressure, compression positive", unit="Pa")


@dataclass(frozen=True)
class InitialPressureMaterial:
    """A pore pressure at the start of all particles of a material."""

    material_id: int = parameter("Number of the material")
    pressure: float = parameter("Pore pressure, compression positive", unit="Pa")


@dataclass(frozen=True)
class PressureForceBox(Box):
    """A force on the pore fluid of every particle that starts in a closed box."""

    pressure_force: Vector = parameter("Force on each particle, subtracted", unit="N")
