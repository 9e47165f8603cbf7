"""Bodies that fill a geometry with particles: one file each, one line each in BODIES."""

from mpmgeo.bodies.cloud import Cloud
from mpmgeo.bodies.cuboid import Cuboid
from mpmgeo.bodies.polygon_2d import Polygon2D
from mpmgeo.bodies.sphere import Sphere

BODIES = (Cuboid, Sphere, Polygon2D)

__all__ = ["BODIES", "Cloud", "Cuboid", "Polygon2D", "Sphere"]
