"""Pressures of the pore fluid and forces on it: they act with two phases."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from mpmgeo.action import Action
from mpmgeo.loads.box import ActionInBox, ForceInBox
from mpmgeo.parameters import Vector, parameter


class PressureInBox(ActionInBox):
    """A pore pressure of the particles that start in a closed box."""

    needs_two_phases: ClassVar[bool] = True
    is_kept: ClassVar[bool] = False

    def wets(self, position: np.ndarray, material: np.ndarray) -> np.ndarray:
        """Tell which particles have the pressure, from position (n, 3) [m] and material (n,)."""
        return self.contains(position)


@dataclass(frozen=True)
class PrescribedPressureBox(PressureInBox):
    """A pore pressure that the particles which start in a closed box keep."""

    key: ClassVar[str] = "prescribed_pressure_box"
    about: ClassVar[str] = "Pore pressures that particles keep; with two phases"
    is_kept: ClassVar[bool] = True

    pressure: float = parameter("Pore pressure, compression positive", unit="Pa")


@dataclass(frozen=True)
class InitialPressureBox(PressureInBox):
    """A pore pressure at the start of the particles in a closed box."""

    key: ClassVar[str] = "initial_pressure_box"
    about: ClassVar[str] = "Pore pressures at the start, in boxes; with two phases"

    pressure: float = parameter("Pore pressure, compression positive", unit="Pa")


@dataclass(frozen=True)
class InitialPressureMaterial(Action):
    """A pore pressure at the start of all particles of a material."""

    key: ClassVar[str] = "initial_pressure_material"
    about: ClassVar[str] = "Pore pressures at the start, of materials; with two phases"
    needs_two_phases: ClassVar[bool] = True
    is_kept: ClassVar[bool] = False

    material_id: int = parameter("Number of the material", names="materials")
    pressure: float = parameter("Pore pressure, compression positive", unit="Pa")

    def wets(self, position: np.ndarray, material: np.ndarray) -> np.ndarray:
        """Tell which particles have the pressure, from position (n, 3) [m] and material (n,)."""
        return material == self.material_id


@dataclass(frozen=True)
class PressureForceBox(ForceInBox):
    """A force on the pore fluid of every particle that starts in a closed box."""

    key: ClassVar[str] = "pressure_force_box"
    about: ClassVar[str] = "Forces on the pore fluid; with two phases"
    needs_two_phases: ClassVar[bool] = True

    pressure_force: Vector = parameter("Force on each particle, subtracted", unit="N")

    def fluid_force(self, position: np.ndarray) -> np.ndarray:
        """Return the force (n, 3) [N] on the fluid of particles that start at position (n, 3)."""
        return -np.array(self.pressure_force) * self.contains(position)[:, None]
