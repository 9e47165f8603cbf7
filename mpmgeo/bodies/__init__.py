"""Bodies of particles: one file each, one line each in BODIES."""

from mpmgeo.bodies.cloud import Cloud
from mpmgeo.bodies.cuboid import Cuboid
from mpmgeo.bodies.gmsh import Gmsh
from mpmgeo.bodies.particles import Particles
from mpmgeo.bodies.particles_from_file import ParticlesFromFile, ParticlesList
from mpmgeo.bodies.polygon_2d import Polygon2D
from mpmgeo.bodies.sphere import Sphere

BODIES = (Cuboid, Sphere, Polygon2D, Particles, ParticlesFromFile, ParticlesList, Gmsh)

__all__ = [
    "BODIES",
    "Cloud",
    "Cuboid",
    "Gmsh",
    "Particles",
    "ParticlesFromFile",
    "ParticlesList",
    "Polygon2D",
    "Sphere",
]
