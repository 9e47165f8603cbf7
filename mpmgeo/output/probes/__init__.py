"""Probes, what histories are taken of: one file each, one line each in PROBES."""

from mpmgeo.output.probes.box import BoxProbe
from mpmgeo.output.probes.particles import ParticleProbe
from mpmgeo.output.probes.planes import PlaneProbe
from mpmgeo.output.probes.points import PointProbe

PROBES = (PointProbe, ParticleProbe, BoxProbe, PlaneProbe)
