"""The problems of `verify/problem.py` by name: one file each, one line each in PROBLEMS."""

from mpmgeo.verify.axial_vibration import AxialVibration
from mpmgeo.verify.axis_aligned import AxisAligned
from mpmgeo.verify.colliding_discs import CollidingDiscs
from mpmgeo.verify.compaction import Compaction
from mpmgeo.verify.dyka_bar import DykaBar
from mpmgeo.verify.ring import Ring
from mpmgeo.verify.vortex import Vortex

PROBLEMS = {
    problem.name: problem
    for problem in (AxialVibration, AxisAligned, Vortex, Ring, Compaction, CollidingDiscs, DykaBar)
}
