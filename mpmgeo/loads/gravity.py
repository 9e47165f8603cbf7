"""Gravity that changes in time."""

from dataclasses import dataclass

from mpmgeo.loads.in_time import InTime
from mpmgeo.parameters import Vector, parameter


@dataclass(frozen=True)
class Gravity(InTime):
    """An acceleration of gravity, times a factor in time."""

    value: Vector = parameter("Acceleration where the factor is one", unit="m/s²")
