"""What a case is made into: time steps, outputs, and what reaches the solver."""

import numpy as np
import pytest
from assembly import RUBBER, SIDES, simulate, two_blocks

from mpmgeo.materials.elastic import Elastic

SOFT = Elastic(id=4, density=1e3, young=1e6, poisson=0.25)
HEAVY = Elastic(id=9, density=2e3, young=2e6, poisson=0.0)
UNUSED = {"type": "elastic", "id": 7, "density": 1.0, "young": 1e9, "poisson": 0}


# Time steps and outputs


def test_critical_time_step_counts_cells_waves_and_speed():
    """The smallest cell, the fastest wave of the materials in use, the fastest particle."""
    case = two_blocks()
    case["mesh"] = case["mesh"] | {"cells_dimension": [0.5, 0.25, 1.0]}
    case["materials"].append(UNUSED)
    wave = max(SOFT.sound_speed(), HEAVY.sound_speed())
    speed = np.sqrt(3.0**2 + 1.0 + 4.0)
    assert simulate(case).critical_time_step == pytest.approx(0.25 / (wave + speed))


def test_critical_time_step_of_mpm_geomechanics():
    """The mean cell size, all materials listed, no speed."""
    case = two_blocks(compatibility="mpm-geomechanics")
    case["mesh"] = case["mesh"] | {"cells_dimension": [0.5, 0.25, 1.0]}
    case["materials"].append(UNUSED)
    assert simulate(case).critical_time_step == pytest.approx(1.75 / 3 / np.sqrt(1e9))


@pytest.mark.parametrize("given", [None, 0])
def test_time_step_is_a_share_of_the_critical_one(given):
    case = two_blocks(time_step=given, critical_time_step_multiplier=0.125)
    if given is None:
        del case["time_step"]
    simulation = simulate(case)
    assert simulation.time_step == pytest.approx(0.125 * simulation.critical_time_step)


def test_time_step_as_given():
    assert simulate(two_blocks(time_step=1.0)).time_step == 1.0


@pytest.mark.parametrize(
    "time, wanted, interval",
    [(1.0, 10, 100), (1.0, 3, 333), (0.999, 10, 99), (0.01, 100, 1), (1.0, 0, 1), (1.0, -1, 1)],
)
def test_output_interval(time, wanted, interval):
    """R = max(1, floor(floor(time / dt) / print))."""
    simulation = simulate(two_blocks(time=time, results={"print": wanted}))
    assert simulation.output_interval == interval


def test_output_interval_of_an_automatic_step_of_mpm_geomechanics():
    """Cells of 0.1 m and waves of 50 m/s: 200 steps of 0.2 ms, where 199 would be 49 an output."""
    water = {"type": "newtonian", "id": 4, "density": 1e3, "viscosity": 1.0, "bulk": 2.5e6}
    case = two_blocks(time=0.04, compatibility="mpm-geomechanics", results={"print": 4})
    del case["time_step"]
    case |= {"critical_time_step_multiplier": 0.1, "materials": [water, water | {"id": 9}]}
    cells = {"cells_dimension": [0.1, 0.1, 0.1], "cells_number": [30, 30, 50]}
    case["mesh"] = case["mesh"] | cells
    assert simulate(case).output_interval == 50


def test_label_is_the_time_of_the_state():
    simulation = simulate(two_blocks())
    assert simulation.label == 0.0
    assert simulation.step(3).label == simulation.time == pytest.approx(3e-3)


def test_label_of_mpm_geomechanics_is_a_step_early():
    simulation = simulate(two_blocks(compatibility="mpm-geomechanics"))
    assert simulation.label == 0.0
    assert simulation.step().label == pytest.approx(0.0, abs=1e-18)
    assert simulation.step(9).label == pytest.approx(9e-3)


# What a case is made into


@pytest.mark.parametrize(
    "damping, compatibility, expected",
    [
        ({"type": "none"}, None, (None, None, False)),
        ({"type": "local", "value": 0.2}, None, (0.2, None, False)),
        ({"type": "local", "value": 0.0}, None, (None, None, False)),
        ({"type": "kinetic"}, None, (None, None, True)),
        ({"type": "local", "value": 0.2}, "mpm-geomechanics", (None, 0.2, False)),
    ],
)
def test_damping_reaches_the_solver(damping, compatibility, expected):
    extra = {} if compatibility is None else {"compatibility": compatibility}
    solver = simulate(two_blocks(damping=damping, **extra)).solver
    local = solver.damping[0].α if solver.damping else None
    delayed = None if solver.early_damping is None else solver.early_damping.α
    assert (local, delayed, solver.effect("kinetic damping") is not None) == expected


@pytest.mark.parametrize("shape, share", [("GIMP", 1e-24), ("linear", 1e-12)])
def test_cut_off_follows_the_lightest_particle(shape, share):
    """The mass that it has on a node that it reaches over by 1e-12 of a cell; once it was none."""
    keys = {"shape_function": shape}
    assert simulate(two_blocks(**keys)).solver.cutoff == pytest.approx(share * 1000 / 64)
    old = simulate(two_blocks(compatibility="mpm-geomechanics", **keys))
    assert old.solver.cutoff == 0.0


def test_symbols_are_made_once(monkeypatch):
    """A law's constants are computed when the solver is built, not step by step."""
    simulation = simulate(two_blocks())
    monkeypatch.setattr(Elastic, "symbols", property(lambda law: pytest.fail("made again")))
    simulation.step(3)
    with pytest.raises(pytest.fail.Exception):
        _ = RUBBER.symbols


def test_inactive_bodies_and_unused_materials_cost_nothing():
    case = two_blocks()
    case["body"][0]["active"] = False
    simulation = simulate(case).step()
    assert len(simulation.solver.sets) == 1
    assert (simulation.field("body") == 1).all() and len(simulation.field("id")) == 32


def test_a_case_without_particles_runs(tmp_path):
    """A body too small for any particle: nothing happens, but nothing fails either."""
    dot = {"type": "sphere", "center": [2, 1.5, 2.5], "diameter": 0.01, "material_id": 9}
    case = two_blocks(body=[dot], results={"material_point_results": ["all"]})
    simulation = simulate(case, output=tmp_path).run()
    assert simulation.field("velocity").shape == (0, 3)
    assert simulation.field("stress").shape == (0, 6)
    assert simulation.kinetic_energy() == 0.0


def test_sides_are_all_named():
    assert set(SIDES) == set(simulate(two_blocks()).case.mesh.boundary_conditions.kinds())
