"""Loads: one file each, one line each in LOADS."""

from mpmgeo.loads.base_acceleration import BaseAcceleration
from mpmgeo.loads.box import BoxLoad
from mpmgeo.loads.coupling import HydroMechanicalCoupling
from mpmgeo.loads.gravity import Gravity
from mpmgeo.loads.in_time import InTime
from mpmgeo.loads.point import PointLoad
from mpmgeo.loads.pore_pressure import (
    InitialPressureBox,
    InitialPressureMaterial,
    PrescribedPressureBox,
    PressureForceBox,
)
from mpmgeo.loads.prescribed_velocity import PrescribedVelocity
from mpmgeo.loads.record import Record, read_record

LOADS = (
    BoxLoad,
    PointLoad,
    PrescribedVelocity,
    InitialPressureBox,
    InitialPressureMaterial,
    PrescribedPressureBox,
    PressureForceBox,
    HydroMechanicalCoupling,
    BaseAcceleration,
)
"""All loads; forces add up in this order, and of several pore pressures the last one counts."""

__all__ = [
    "LOADS",
    "BaseAcceleration",
    "BoxLoad",
    "Gravity",
    "HydroMechanicalCoupling",
    "InTime",
    "InitialPressureBox",
    "InitialPressureMaterial",
    "PointLoad",
    "PrescribedPressureBox",
    "PrescribedVelocity",
    "PressureForceBox",
    "Record",
    "read_record",
]
