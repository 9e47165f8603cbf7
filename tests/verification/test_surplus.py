"""Energy from nowhere: the guard tells of it in time, and not where there is none."""

import warnings

import numpy as np
import pytest
from models import Counting
from scenes import cuboid, scene, simulate

import mpmgeo
from mpmgeo.verify.bar import Bar

CELL, CELLS = 0.1, 4
SPEED = 36.7  # of compression waves [m/s]
SEED = 1e-3  # of that speed: the first vibration
FREE = {f"plane_{plane}": "free" for plane in ("X0", "Xn", "Y0", "Yn", "Z0", "Zn")}


def flight(scheme, share, steps=2000, multiplier=0.5, **keys):
    """Return the simulation of a cube that vibrates and flies at a share of its wave speed."""
    low, high = CELL, (CELLS + 1) * CELL
    length = 3 * CELLS + int(share * multiplier * steps)
    velocity = [share * SPEED, 0, 0]
    case = scene(
        [length, CELLS + 2, CELLS + 2],
        CELL,
        [cuboid(3 * [low], 3 * [high], initial_velocity=velocity)],
        time=10.0,
        critical_time_step_multiplier=multiplier,
        stress_scheme_update=scheme,
        boundary_conditions=FREE,
        **keys,
    )
    case["materials"] = [case["materials"][0] | {"poisson": 0.3}]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", mpmgeo.CaseWarning)  # of how far the cube would fly
        simulation = simulate(case)
    x, v = simulation.field("position")[:, 0], simulation.field("velocity").copy()
    v[:, 0] += SEED * SPEED * np.sin(np.pi * (x - x.mean()) / np.ptp(x))
    simulation.assign("velocity", v)
    return simulation


def run(simulation, steps=2000):
    return simulation.run(until=(steps - 0.5) * simulation.time_step, watchers=[UntilTold()])


def within(simulation):
    return simulation.solver.tally().within


def told(simulation):
    return [message for message in simulation.messages if "than were put in" in message]


class UntilTold(mpmgeo.Watcher):
    """Stops a run once it is told of energy from nowhere."""

    def after_step(self, simulation):
        if told(simulation):
            raise mpmgeo.StopRun("told")


@pytest.mark.parametrize("every", [0, 50], ids=["", "with a balance"])
@pytest.mark.parametrize(("scheme", "share"), [("MUSL", 0.1), ("MUSL", 0.3), ("USF", 0.3)])
def test_a_vibration_that_flight_feeds_is_told_of(scheme, share, every):
    """Before it has grown to four times its energy, twice its amplitude."""
    keys = {"results": {"energy": {"every": every}}} if every else {}
    simulation = flight(scheme, share, **keys)
    start = within(simulation)
    run(simulation)
    (message,) = told(simulation)
    assert 1.5 < within(simulation) / start < 4
    assert f"likely cause: {scheme}, which lets a body that flies" in message
    assert message.endswith("try USL")


@pytest.mark.parametrize("share", [0.0, 0.1, 0.3])
def test_the_remedy_that_it_names_is_one(share):
    simulation = flight("USL", share)
    start = within(simulation)
    run(simulation)
    assert not told(simulation)
    assert within(simulation) < start


@pytest.mark.parametrize("scheme", ["MUSL", "USF"])
def test_nothing_is_told_of_a_vibration_in_one_place(scheme):
    assert not told(run(flight(scheme, 0.0)))


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
    """After 50 steps; after 60 the run diverges."""
    bar = Bar(velocity_peak=1e-9)
    with pytest.warns(mpmgeo.CaseWarning, match="exceeds the critical"):
        simulation = simulate(bar.case(25, "MUSL", 4 * bar.period, courant=2.0))
    bar.start(simulation)
    simulation.run(watchers=[UntilTold()])
    assert "likely cause: the time step of" in told(simulation)[0]


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
    solver = flight("MUSL", 0.3).solver
    assert solver.energies() is not None
    solver.sets[0].law = Counting(λ=1e5, G2=1e5)
    assert solver.energies() is None
