"""Energy from nowhere: the guard tells of it in time, and not where there is none."""

import pytest
from models import Counting
from scenes import cuboid, scene, simulate

import mpmgeo
from mpmgeo.verify import limits

CELL = limits.CELL


def flown(scheme, share, **keys):
    """Return the simulation of a cube that has flown, and vibrations at the start and the end.

    The flight ends when something is told.
    """
    simulation = simulate(limits.flight(share, stress_scheme_update=scheme, **keys))
    start = limits.vibrate(simulation)
    simulation.run(watchers=[limits.Heard(stops=True)])
    return simulation, start, limits.vibration(simulation)


def told(simulation):
    return list(filter(limits.is_surplus, simulation.messages))


@pytest.mark.parametrize("every", [0, 50], ids=["", "with a balance"])
@pytest.mark.parametrize(("scheme", "share"), [("MUSL", 0.1), ("MUSL", 0.3), ("USF", 0.3)])
def test_a_vibration_that_flight_feeds_is_told_of(scheme, share, every):
    """Before it has grown to four times its energy, twice its amplitude."""
    keys = {"results": {"energy": {"every": every}}} if every else {}
    simulation, start, end = flown(scheme, share, critical_time_step_multiplier=0.5, **keys)
    (message,) = told(simulation)
    assert 1.5 < end / start < 4
    assert f"likely cause: {scheme}, which lets a body that flies" in message
    assert message.endswith("with which bodies in flight gain nothing")


@pytest.mark.parametrize(
    ("scheme", "step", "share"),
    [("USL", 0.5, 0.1), ("USL", 0.5, 0.3), ("MUSL", 0.1, 0.3)],
)
def test_the_remedies_that_it_names_are_some(scheme, step, share):
    simulation, start, end = flown(scheme, share, critical_time_step_multiplier=step)
    assert not told(simulation)
    assert end < 1.5 * start


@pytest.mark.parametrize("scheme", ["MUSL", "USF"])
def test_nothing_is_told_of_a_vibration_in_one_place(scheme):
    simulation, start, end = flown(scheme, 0.0, critical_time_step_multiplier=0.5)
    assert not told(simulation)
    assert end < 1.5 * start


@pytest.mark.parametrize("scheme", ["USL", "MUSL", "USF"])
def test_nothing_is_told_of_bodies_that_fall_bounce_and_meet(scheme):
    """Two cubes in a box of sliding planes, one of them thrown at the other."""
    bodies = [
        cuboid((0.1, 0.1, 0.3), (0.5, 0.5, 0.7)),
        cuboid((0.7, 0.1, 0.2), (1.1, 0.5, 0.6), initial_velocity=[-3, 0, 1]),
    ]
    keys = {"gravity": [0, 0, -9.81], "stress_scheme_update": scheme}
    assert not told(simulate(scene([16, 8, 12], CELL, bodies, time=1.0, **keys)).run())


def test_a_step_above_the_limit_is_blamed_first():
    with pytest.warns(mpmgeo.CaseWarning, match="is stable here"):
        simulation, _, _ = flown("MUSL", 0.3, critical_time_step_multiplier=1.4)
    assert "up to which MUSL with GIMP is stable, try" in told(simulation)[0]


@pytest.mark.parametrize("scheme", ["USL", "MUSL", "USF"])
def test_nothing_is_told_of_the_first_steps_of_an_impact(scheme):
    """Although the energies are compared after every step."""
    body = cuboid((0, 0, 0), (0.4, 0.4, 0.4), initial_velocity=[0, 0, -3])
    keys = {"stress_scheme_update": scheme, "time": 0.2, "results": {"print": 0}}
    keys["results"]["material_point_results"] = ["none"]
    assert not told(simulate(scene([6, 6, 6], CELL, [body], **keys)).run())


def test_where_work_is_done_unseen_only_a_balance_can_tell():
    """A plate presses a column; without a balance nobody knows who put the energy in."""
    plate = {"plane": "Zn", "velocity": [None, None, -0.1]}
    case = scene([1, 1, 10], CELL, [cuboid((0, 0, 0), (CELL, CELL, 1.0))], time=0.2)
    case |= {"prescribed_velocity": {"plate": plate}, "stress_scheme_update": "MUSL"}
    blind = simulate(case)
    seeing = simulate(case | {"results": {"energy": {"every": 10}}})
    assert blind.solver.energies() is None
    for simulation in (blind, seeing):
        assert not told(simulation.run())
    assert seeing.solver.energies().turnover > 0.1


def test_a_law_without_strain_energy_keeps_the_guard_silent():
    solver = simulate(limits.flight(0.3)).solver
    assert solver.energies() is not None
    solver.sets[0].law = Counting(λ=1e5, G2=1e5)
    assert solver.energies() is None
