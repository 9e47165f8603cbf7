"""Runs that end at a state of rest: when they do, when they do not, and what they say."""

import numpy as np
import pytest

import mpmgeo
from mpmgeo.run.rest import goal_of
from mpmgeo.run.watch import Watcher

WEIGHT, HEIGHT, OEDOMETRIC = 2000 * 9.81, 1.0, 1e6 * 0.7 / 1.3 / 0.4
KINETIC, LOCAL = {"type": "kinetic"}, {"type": "local", "value": 0.3}


def column(until, damping=KINETIC, **more):
    """Return the case of a column of ten cells under its weight."""
    walls = {f"plane_{axis}{side}": "sliding" for axis in "XY" for side in "0n"}
    case = {
        "time": 5.0,
        "gravity": [0, 0, -9.81],
        "critical_time_step_multiplier": 0.3,
        "stress_scheme_update": "MUSL",
        "mesh": {
            "cells_number": [2, 2, 12],
            "cells_dimension": [0.1, 0.1, 0.1],
            "boundary_conditions": {"plane_Z0": "fixed", **walls},
        },
        "materials": [{"type": "elastic", "id": 1, "density": 2000, "young": 1e6, "poisson": 0.3}],
        "body": [
            {
                "type": "cuboid",
                "point_p1": [0, 0, 0],
                "point_p2": [0.2, 0.2, HEIGHT],
                "material_id": 1,
            }
        ],
        "damping": damping,
        "results": {"print": 1},
        "until": until,
    }
    return mpmgeo.Simulation(mpmgeo.load_case(case | more))


@pytest.mark.parametrize("damping", [KINETIC, LOCAL], ids=lambda damping: damping["type"])
@pytest.mark.parametrize("scheme", ["USL", "MUSL", "USF", "NPC"])
@pytest.mark.parametrize("until", [{"unbalanced_force": 3e-4}, {"kinetic_energy": 1e-6}])
def test_column_ends_at_the_stresses_of_rest(damping, scheme, until):
    simulation = column(until, damping, stress_scheme_update=scheme).run()
    assert simulation.stopped.startswith("at rest after")
    assert simulation.messages[-1] == simulation.stopped
    assert simulation.time < 3.0
    z, stress = simulation.field("position")[:, 2], simulation.field("stress")[:, 2]
    assert np.abs(stress + WEIGHT * (HEIGHT - z)).max() < 0.04 * WEIGHT * HEIGHT


def test_both_figures_have_to_be_reached():
    both = {"unbalanced_force": 1e-3, "kinetic_energy": 1e-5}
    ends = [column({key: value}).run().steps for key, value in both.items()]
    simulation = column(both).run()
    assert simulation.steps >= max(ends)
    assert all(figure <= both[key.replace(" ", "_")] for key, figure in figures(simulation).items())


def figures(simulation):
    return goal_of(simulation).figures


class Looks(Watcher):
    """Keeps kinetic energy and figures of every step."""

    def __init__(self):
        self.rows = []

    def after_step(self, simulation):
        goal = goal_of(simulation)
        self.rows.append((simulation.kinetic_energy(), *goal.latest.values()))


def test_particles_that_have_just_been_stopped_are_not_at_rest():
    """After a stop the energy is zero and grows from nothing; the figure is that of the peak."""
    looks = Looks()
    column({"kinetic_energy": 1e-9, "every": 1}, time=0.3).run(watchers=[looks])
    energy, figure = np.transpose(looks.rows)
    stops = np.flatnonzero(energy == 0.0)
    assert len(stops) > 2
    assert np.isinf(figure[: stops[0]]).all()
    assert (figure[stops[0] : stops[0] + 10] > 0.1).all()
    assert (figure[stops] > 0.0).all()


def test_first_steps_are_not_at_rest():
    looks = Looks()
    until = {"unbalanced_force": 0.5, "kinetic_energy": 0.01, "every": 1}
    column(until, LOCAL, time=0.02).run(watchers=[looks])
    _, unbalanced, kinetic = np.transpose(looks.rows)
    assert (unbalanced[:8] > 0.5).all()
    assert (kinetic[:8] > 0.2).all()


def test_loads_that_change_put_rest_off():
    gravity = {"value": [0, 0, -9.81], "time": [0.0, 1.0, 2.0], "factor": [1.0, 1.0, 1.5]}
    simulation = column({"unbalanced_force": 1e-2}, gravity=gravity).run()
    assert 2.0 <= simulation.time < 3.0
    stress = simulation.field("stress")[:, 2].min()
    assert stress == pytest.approx(-1.5 * WEIGHT * 0.975 * HEIGHT, rel=0.03)


def test_nodal_loads_do_work():
    loads = [[[x, y, HEIGHT], [0, 0, -100.0]] for x in (0.0, 0.1, 0.2) for y in (0.0, 0.1, 0.2)]
    until = {"unbalanced_force": 1e-3, "kinetic_energy": 1e-4}
    still = {"gravity": [0, 0, 0], "nodal_point_load": loads}
    simulation = column(until, **still).run()
    assert simulation.stopped
    lower = simulation.field("position")[:, 2] < 0.5
    stress = simulation.field("stress")[lower, 2]
    assert stress == pytest.approx(-900 / 0.04, rel=0.02)


def test_without_rest_the_end_says_so():
    simulation = column({"unbalanced_force": 1e-9}, time=0.2).run()
    assert simulation.stopped is None
    assert simulation.messages[-1].startswith("not at rest when the time of the case is over")
    assert "wanted 1e-09" in simulation.messages[-1]


def test_what_nothing_acts_on_is_not_known_to_rest():
    simulation = column({"unbalanced_force": 1e-3}, gravity=[0, 0, 0], time=0.5).run()
    assert simulation.stopped is None


def test_last_state_is_written(tmp_path):
    case = column({"unbalanced_force": 1e-3}).case
    simulation = mpmgeo.Simulation(case, output=tmp_path).run()
    files = sorted(path.name for path in (tmp_path / "particles").glob("*.vtu"))
    assert files == ["particles_1.vtu", "particles_2.vtu"]
    last = (tmp_path / "time-energy.csv").read_text().splitlines()[-1]
    assert float(last.split(",")[0]) == simulation.time


@pytest.mark.parametrize("damping", [KINETIC, LOCAL], ids=lambda damping: damping["type"])
def test_resumed_run_ends_where_the_whole_one_does(tmp_path, damping):
    until = {"unbalanced_force": 1e-3, "kinetic_energy": 1e-5, "every": 20}
    whole = column(until, damping).run()
    half = column(until, damping).step(whole.steps - 77)
    half.save(tmp_path / "half.npz")
    resumed = mpmgeo.Simulation.resume(tmp_path / "half.npz").run()
    assert resumed.steps == whole.steps
    assert resumed.stopped == whole.stopped
    for key in ("position", "velocity", "stress"):
        assert resumed.field(key).tobytes() == whole.field(key).tobytes()


def test_what_is_at_rest_makes_no_step(tmp_path):
    whole = column({"unbalanced_force": 1e-3}).run()
    whole.save(tmp_path / "rest.npz")
    steps = whole.steps
    assert whole.run().steps == steps
    resumed = mpmgeo.Simulation.resume(tmp_path / "rest.npz").run()
    assert resumed.steps == steps
    assert resumed.stopped.startswith("at rest already")


def test_results_are_those_without_looks():
    looked = column({"unbalanced_force": 1e-12, "kinetic_energy": 1e-15}, LOCAL, time=0.3).run()
    plain = column(None, LOCAL, time=0.3).run()
    for key in ("position", "velocity", "stress"):
        assert looked.field(key).tobytes() == plain.field(key).tobytes()


def test_figures_do_not_depend_on_threads():
    until = {"unbalanced_force": 1e-12, "kinetic_energy": 1e-15, "every": 7}
    case = column(until, LOCAL, time=0.1).case
    one, two = (mpmgeo.Simulation(case, threads=n) for n in (1, 2))
    for simulation in (one, two):
        simulation.solver.small = False
        simulation.run()
    assert figures(one) == figures(two)


@pytest.mark.parametrize(
    "until, more, words",
    [
        ({}, {}, "is needed, or both"),
        ({"unbalanced_force": 1e-3}, {"damping": {"type": "none"}}, "nothing leads to rest"),
        ({"unbalanced_force": 1e-3}, {"damping": {"type": "local"}}, "nothing leads to rest"),
        ({"unbalanced_force": 1e-3}, {"compatibility": "mpm-geomechanics"}, "runs until its time"),
        ({"unbalanced_force": 1e-3}, {"n_phases": 2}, "one phase"),
        ({"unbalanced_force": 0}, {}, "above 0"),
        (
            {"kinetic_energy": 1e-3},
            {"prescribed_velocity": [{"plane": "Z0", "velocity": [None, None, 0]}]},
            "prescribed_velocity",
        ),
    ],
)
def test_refused(until, more, words):
    with pytest.raises(mpmgeo.CaseError, match=words):
        column(until, **more)
