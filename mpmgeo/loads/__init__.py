"""Loads: one file each, one line each in LOADS under the JSON key that names it."""

from mpmgeo.loads.base_acceleration import BaseAcceleration
from mpmgeo.loads.box import BoxLoad
from mpmgeo.loads.point import PointLoad
from mpmgeo.loads.record import Record, read_record

LOADS = {
    "nodal_point_load": PointLoad,
    "load_distributed_box": BoxLoad,
    "earthquake": BaseAcceleration,
}

__all__ = ["LOADS", "BaseAcceleration", "BoxLoad", "PointLoad", "Record", "read_record"]
