"""Loads: one file each, one line each in LOADS under the JSON key that names it."""

from mpmgeo.loads.base_acceleration import BaseAcceleration
from mpmgeo.loads.box import BoxLoad
from mpmgeo.loads.coupling import HydroMechanicalCoupling
from mpmgeo.loads.point import PointLoad
from mpmgeo.loads.pore_pressure import (
    InitialPressureBox,
    InitialPressureMaterial,
    PrescribedPressureBox,
    PressureForceBox,
)
from mpmgeo.loads.prescribed_velocity import PrescribedVelocity
from mpmgeo.loads.record import Record, read_record

LOADS = {
    "nodal_point_load": PointLoad,
    "load_distributed_box": BoxLoad,
    "prescribed_velocity": PrescribedVelocity,
    "prescribed_pressure_box": PrescribedPressureBox,
    "initial_pressure_box": InitialPressureBox,
    "initial_pressure_material": InitialPressureMaterial,
    "pressure_force_box": PressureForceBox,
    "hydro_mechanical_coupling": HydroMechanicalCoupling,
    "earthquake": BaseAcceleration,
}

OF_THE_FLUID = (
    "prescribed_pressure_box",
    "initial_pressure_box",
    "initial_pressure_material",
    "pressure_force_box",
)
"""Loads that act with two phases only."""

__all__ = [
    "LOADS",
    "OF_THE_FLUID",
    "BaseAcceleration",
    "BoxLoad",
    "HydroMechanicalCoupling",
    "InitialPressureBox",
    "InitialPressureMaterial",
    "PointLoad",
    "PrescribedPressureBox",
    "PrescribedVelocity",
    "PressureForceBox",
    "Record",
    "read_record",
]
