"""Splines: a bar between a fixed plane and its free end, a block that slides down a terrain."""

from dataclasses import replace
from math import cos, hypot, pi
from pathlib import Path

import numpy as np
import pytest

import mpmgeo
from mpmgeo.verify.bar import Bar

INPUTS = Path(__file__).parents[2] / "inputs"
SPLINE = pytest.mark.parametrize("shape", ["quadratic-bspline", "cubic-bspline"])
BAR = Bar(velocity_peak=1e-3)


def error(shape, cells):
    """Return the mean error of the displacement after 1¼ vibrations, relative to the peak."""
    time = 1.25 * BAR.period
    case = BAR.case(cells, "USL", time, courant=0.2) | {"shape_function": shape}
    case["body"][0]["particles_per_direction"] = [2, 1, 1]
    simulation = mpmgeo.Simulation(mpmgeo.load_case(case))
    x = BAR.start(simulation)
    simulation.run()
    off = simulation.field("displacement")[:, 0] - BAR.displacement(x, time)
    return np.sqrt((off**2).mean()) / BAR.displacement_peak


@SPLINE
def test_errors_fall_faster_than_with_gimp(shape):
    """GIMP's are of second order at best, whatever the plane."""
    coarse, fine = error(shape, 8), error(shape, 16)
    assert np.log2(coarse / fine) > 3
    assert fine < 5e-4 < error("GIMP", 16)


@SPLINE
def test_friction_on_a_terrain(shape):
    """As a rigid block, in a mesh whose planes are more than two cells away."""
    case = mpmgeo.load_case(INPUTS / "terrain_slide" / "case.json")
    origin = tuple(x - 3.0 for x in case.mesh.origin)
    cells = tuple(n + 6 for n in case.mesh.cells_number)
    mesh = replace(case.mesh, origin=origin, cells_number=cells)
    simulation = mpmgeo.Simulation(replace(case, shape_function=shape, mesh=mesh))
    while simulation.time < 0.5:
        simulation.step()
    x, _, z = simulation.field("displacement").mean(axis=0)
    way = 9.81 * (0.5 - 0.3 * cos(pi / 6)) * simulation.time**2 / 2
    assert hypot(x, z) == pytest.approx(way, rel=0.01)


def test_a_terrain_that_moves():
    """The block follows it as with GIMP, whose shape it nearly has."""
    case = mpmgeo.load_case(INPUTS / "seismic_terrain" / "case.json")
    speeds = []
    for shape in ("GIMP", "quadratic-bspline"):
        simulation = mpmgeo.Simulation(replace(case, shape_function=shape))
        while simulation.time < 0.15:
            simulation.step()
        speeds.append(simulation.field("velocity")[:, 0].mean())
    assert speeds[1] == pytest.approx(speeds[0], rel=0.06)
