"""A column of aluminium bars collapses as in the experiment: surface, run-out, failure line."""

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import mpmgeo
from mpmgeo.damping import NoDamping
from mpmgeo.transfers import Tpic
from mpmgeo.verify.expected import compare
from mpmgeo.verify.heap import Heap, difference

FOLDER = Path(__file__).parents[2] / "inputs" / "column_collapse"
BAR = 0.0015  # diameter of the larger bars [m]; the surface was measured down to this height
STRIP = 0.005  # width over which heights are taken [m]
RUN_OUT = 0.44


def measured(name):
    """Return x and z (k,) [m] of a line of the experiment."""
    return np.loadtxt(FOLDER / f"{name}.csv", delimiter=",", skiprows=1).T


def column(cell):
    """Return the case that ships, with cells of another size [m]."""
    case = json.loads((FOLDER / "case.json").read_text(encoding="utf-8"))
    shipped = case["mesh"]["cells_dimension"][0]
    x, _, z = case["mesh"]["cells_number"]
    case["mesh"]["cells_number"] = [round(n * shipped / cell) for n in (x, cell / shipped, z)]
    case["mesh"]["cells_dimension"] = 3 * [cell]
    case["body"]["column"]["point_p2"][1] = cell
    return mpmgeo.load_case(case)


def heap_of(simulation):
    """Return the heap that a column has become."""
    case = simulation.case
    cell, body = case.mesh.cells_dimension[1], case.body[0]
    density = case.materials[0].density
    return Heap.of(simulation, density, cell, cell / body.particles_per_direction[0])


def figures(heap):
    """Return the differences of surface and failure line, and the run-out, all in m."""
    x, surface = measured("free_surface")
    places, line = measured("failure_line")
    return (
        difference(heap.height(x, STRIP), surface),
        difference(heap.failure_line(places, way=0.001), line),
        heap.front(BAR, STRIP),
    )


def test_heap_of_a_block():
    """Height, front and what did not move of a block of 3 by 2 particles with one far ahead."""
    x, z = np.meshgrid([0.5, 1.5, 2.5], [0.5, 1.5])
    position = np.array([*zip(x.ravel(), z.ravel(), strict=True), (9.5, 0.5)])
    moved = np.where(position[:, 1] > 1, 0.1, 0.0)
    heap = Heap(position, moved, np.ones(7), 1.0)
    assert heap.height(np.array([0.0, 1.0, 5.0, 9.5]), 1.0) == pytest.approx([2, 2, 0, 1])
    assert heap.front(1.0, 0.5) == pytest.approx(3.0)
    assert heap.failure_line(np.array([1.0, 6.0]), 0.01) == pytest.approx([1.0, 0.0])


@pytest.mark.slow
def test_coarse_column():
    """Cells of 5 mm, 3,200 particles: surface within 4 mm, run-out within a tenth."""
    surface, failure, front = figures(heap_of(mpmgeo.Simulation(column(0.005)).run()))
    assert surface < 0.004
    assert failure < 0.012
    assert front == pytest.approx(RUN_OUT, abs=0.045)


@pytest.mark.slow
def test_coarse_column_without_damping():
    """With TPIC it needs none: surface within 4 mm, run-out within 20 mm, and it comes to rest."""
    case = replace(column(0.005), damping=NoDamping(), transfer=Tpic())
    simulation = mpmgeo.Simulation(case).run()
    surface, _, front = figures(heap_of(simulation))
    assert surface < 0.004
    assert front == pytest.approx(RUN_OUT, abs=0.02)
    assert simulation.kinetic_energy() < 1e-7


@pytest.mark.slow
def test_column_collapse():
    """The case that ships, 12,800 particles: surface within 5 mm, run-out within 20 mm."""
    case = mpmgeo.load_case(FOLDER / "case.json", strict=True)
    simulation = mpmgeo.Simulation(case)
    for comparison in compare(simulation, case):
        assert comparison.agrees, str(comparison)
    surface, failure, front = figures(heap_of(simulation))
    assert surface < 0.005
    assert failure < 0.012
    assert front == pytest.approx(RUN_OUT, abs=0.02)
