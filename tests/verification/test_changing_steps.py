"""Steps that change: their order, what they do to energy, and those that follow from speeds."""

from itertools import pairwise

import numpy as np
import pytest

import mpmgeo
from mpmgeo.run.watch import Watcher

LEAPFROGS = ["USL", "MUSL", "USF"]


def column(scheme="MUSL", **more):
    """Return the simulation of a column of ten cells to which gravity is applied at once."""
    walls = {f"plane_{axis}{side}": "sliding" for axis in "XY" for side in "0n"}
    case = {
        "time": 0.2,
        "gravity": [0, 0, -9.81],
        "stress_scheme_update": scheme,
        "critical_time_step_multiplier": 0.3,
        "mesh": {
            "cells_number": [1, 1, 12],
            "cells_dimension": [0.1, 0.1, 0.1],
            "boundary_conditions": {"plane_Z0": "fixed", **walls},
        },
        "materials": [{"type": "elastic", "id": 1, "density": 2000, "young": 1e7, "poisson": 0.3}],
        "body": [
            {
                "type": "cuboid",
                "point_p1": [0, 0, 0],
                "point_p2": [0.1, 0.1, 1.0],
                "material_id": 1,
            }
        ],
        "results": {"print": 4},
    }
    return mpmgeo.Simulation(mpmgeo.load_case(case | more))


def prescribe(simulation, steps):
    """Give a simulation that has made no step the steps of a list, one after the other."""
    solver = simulation.solver
    solver.effect("time step")._landing = lambda _: steps[min(solver.steps, len(steps) - 1)]
    solver.time_step = steps[0]
    if (loads := solver.effect("loads in time")) is not None:
        loads.resumed(solver)


def smooth(count):
    """Return steps that swing between 0.6 and 1.4 of their mean."""
    s = np.arange(count + 1) / count
    return np.diff(s + 0.4 * np.sin(2 * np.pi * s) / (2 * np.pi))


def rough(count):
    """Return steps of two lengths in turn."""
    return np.resize([0.7, 1.3], count) / count


SMALL = {"value": [0, 0, -0.01], "ramp": {"type": "sine", "duration": 0.04}}


@pytest.mark.parametrize("steps", [smooth, rough], ids=lambda steps: steps.__name__)
@pytest.mark.parametrize("scheme", ["MUSL", "USF", "NPC-CD"])
def test_second_order(scheme, steps):
    """Half the steps, a quarter of the error in stress; USL, which damps, is of the first order."""
    found = []
    for count in (200, 400, 800):
        simulation = column(scheme, time=10.0, time_step="adaptive", gravity=SMALL)
        prescribe(simulation, [*(0.05 * steps(count)), 1e-12])
        simulation.step(count + 1)  # stresses of USF are those of the positions a step before
        assert simulation.time == pytest.approx(0.05)
        found.append(simulation.field("stress")[:, 2])
    errors = [np.linalg.norm(one - other) for one, other in pairwise(found)]
    assert np.log2(errors[0] / errors[1]) == pytest.approx(2.0, abs=0.15)
    assert errors[0] < 0.01 * np.linalg.norm(found[-1])


@pytest.mark.parametrize("scheme", LEAPFROGS)
def test_energy_does_not_drift(scheme):
    """The balance of a vibration under sudden gravity, with steps of two lengths in turn."""
    simulation = column(
        scheme, time=10.0, time_step="adaptive", results={"print": 1, "energy": {"every": 1}}
    )
    prescribe(simulation, 0.4 * rough(3200))
    rows = []
    for _ in range(3200):
        simulation.advance()
        rows.append(simulation.energy())
    balance = np.abs([row["balance"] for row in rows])
    moved = max(row["kinetic"] for row in rows)
    assert balance.max() < 0.012 * moved
    assert balance[1600:].max() < 2.5 * balance[:1600].max()


class Times(Watcher):
    """Keeps the time after every step."""

    def __init__(self):
        self.times = [0.0]

    def after_step(self, simulation):
        self.times.append(simulation.time)


@pytest.mark.parametrize("scheme", [*LEAPFROGS, "NPC", "NPC-CD"])
def test_steps_land_on_outputs(scheme, tmp_path):
    case = column(scheme, time_step="adaptive", time=0.1, results={"print": 7}).case
    simulation, times = mpmgeo.Simulation(case, output=tmp_path), Times()
    first = simulation.time_step
    simulation.run(watchers=[times])
    assert simulation.time == 0.1
    rows = (tmp_path / "time-energy.csv").read_text().splitlines()[1:]
    assert [float(row.split(",")[0]) for row in rows] == [0.1 * (k / 7) for k in range(8)]
    steps = np.diff(times.times)
    assert steps.max() <= 1.001 * first
    assert steps.min() >= 0.5 * first
    assert first <= 0.9 * simulation.stable_time_step


def shot(speed, **more):
    """Return a cube that is pushed by gravity until it is as fast as the waves in it."""
    case = {
        "time": 0.1,
        "time_step": "adaptive",
        "gravity": [speed / 0.1, 0, 0],
        "stress_scheme_update": "MUSL",
        "mesh": {"cells_number": [160, 4, 4], "cells_dimension": [0.1, 0.1, 0.1]},
        "materials": [{"type": "elastic", "id": 1, "density": 2000, "young": 1e6, "poisson": 0}],
        "body": [
            {
                "type": "cuboid",
                "point_p1": [0.1, 0.1, 0.1],
                "point_p2": [0.3, 0.3, 0.3],
                "material_id": 1,
            }
        ],
        "results": {"print": 3},
    }
    return mpmgeo.Simulation(mpmgeo.load_case(case | more))


def test_step_follows_the_speed_and_says_so():
    simulation, steps = shot(200.0), []

    class Compared(Watcher):
        def after_step(self, simulation):
            speed = np.linalg.norm(simulation.field("velocity"), axis=1).max()
            limit = 0.25 * 0.1 / (np.sqrt(1e6 / 2000) + speed)
            steps.append((simulation.time_step / limit, simulation.time_step))

    simulation.run(watchers=[Compared()])
    share, step = np.transpose(steps)
    assert share[0] < 1.1  # nothing is known of the growth of a speed before there is one
    assert share[1:].max() < 1.02  # never late: the growth is counted beforehand
    assert step[-1] < 0.2 * step[0]
    told = [message for message in simulation.messages if "the time step is" in message]
    assert len(told) == 1
    assert "body 1, material 1" in told[0]
    assert "has a speed of" in told[0]


def test_stiffer_material_shortens_the_step():
    """A neo-Hookean column that its weight squeezes to a half."""
    law = {"type": "neo-hookean", "id": 1, "density": 2000, "young": 2e4, "poisson": 0.4}
    simulation = column(
        "MUSL",
        time_step="adaptive",
        time=2.0,
        gravity={"value": [0, 0, -40], "ramp": {"type": "sine", "duration": 1.0}},
        materials=[law],
        damping={"type": "local", "value": 0.8},
    ).run()
    told = [message for message in simulation.messages if "the time step is" in message]
    assert any("become stiffer" in message for message in told)


@pytest.mark.parametrize("ledger", [False, True], ids=["without", "with"])
def test_free_fall_is_no_surplus(ledger):
    """The energy of a body that nothing holds is told from work although the steps change."""
    results = {"print": 1} | ({"energy": {"every": 1}} if ledger else {})
    simulation = shot(200.0, results=results, stress_scheme_update="USL").run()
    assert not [message for message in simulation.messages if "more than were put in" in message]
    if ledger:
        figures = simulation.energy()
        assert abs(figures["balance"]) < 1e-9 * figures["kinetic"]


def test_equal_bits_of_all_threads():
    case = shot(50.0).case
    one, two = (mpmgeo.Simulation(case, threads=n) for n in (1, 2))
    for simulation in (one, two):
        simulation.solver.small = False
        simulation.run()
    assert one.steps == two.steps
    assert one.time_step == two.time_step
    for key in ("position", "velocity", "stress"):
        assert one.field(key).tobytes() == two.field(key).tobytes()


@pytest.mark.parametrize("scheme", ["MUSL", "USF", "NPC"])
def test_resumed_equals_whole(tmp_path, scheme):
    whole = shot(80.0, stress_scheme_update=scheme)
    half = shot(80.0, stress_scheme_update=scheme).step(33)
    half.save(tmp_path / "half.npz")
    resumed = mpmgeo.Simulation.resume(tmp_path / "half.npz").run()
    whole.run()
    assert resumed.steps == whole.steps
    assert resumed.time == whole.time == 0.1
    assert resumed.time_step == whole.time_step
    for key in ("position", "velocity", "stress"):
        assert resumed.field(key).tobytes() == whole.field(key).tobytes()


def test_loads_and_motions_in_time_go_with_it():
    """A plane that is moved at a steady rate compresses a column slowly and evenly."""
    push = {"plane": "Zn", "velocity": [None, None, -0.1]}
    mesh = {
        "cells_number": [1, 1, 10],
        "cells_dimension": [0.1, 0.1, 0.1],
        "boundary_conditions": {"plane_Z0": "fixed", "plane_Zn": "fixed"},
    }
    simulation = column(
        "USL",
        time_step="adaptive",
        time=0.1,
        gravity=[0, 0, 0],
        mesh=mesh,
        prescribed_velocity=[push],
        damping={"type": "local", "value": 0.5},
    ).run()
    assert np.isfinite(simulation.field("stress")).all()
    assert simulation.time == 0.1


@pytest.mark.parametrize(
    "value, words",
    [("adaptiv", "did you mean"), ("0.1", 'or "adaptive"'), (-1.0, "at least 0")],
)
def test_wrong_words(value, words):
    with pytest.raises(mpmgeo.CaseError, match=words):
        column(time_step=value)


def test_refused_with_compatibility():
    with pytest.raises(mpmgeo.CaseError, match="keeps its step"):
        column(time_step="adaptive", compatibility="mpm-geomechanics")
