"""Particles whose size follows their material: geometry, the plain twin, what the state holds."""

import numpy as np
import pytest
from test_plain_twin import assert_same, assert_same_steps, scene

import mpmgeo
from mpmgeo.case.building.sets import FLOOR
from mpmgeo.mpm.core.domain import MOST, moments
from mpmgeo.mpm.effects.domains import LARGE
from mpmgeo.verify.plain_domain import FollowingSolver

DOMAIN = {"particle_domain": "updated"}


def turn(angle):
    """Return the rows of a rotation about z."""
    c, s = np.cos(angle), np.sin(angle)
    return (c, -s, 0.0), (s, c, 0.0), (0.0, 0.0, 1.0)


def sizes(B, *maps):
    """Return the half-sizes of second moments after some maps, one after the other."""
    for rows in maps:
        B = moments(B, *rows)
    return np.sqrt(B[:3])


BRICK = (0.3**2, 0.1**2, 0.2**2, 0.0, 0.0, 0.0)
CUBE = (0.25**2, 0.25**2, 0.25**2, 0.0, 0.0, 0.0)
STRETCH = (1.6, 0.0, 0.0), (0.0, 0.8, 0.0), (0.0, 0.0, 1.1)


def test_stretch_along_the_axes_changes_each_edge_by_its_own():
    np.testing.assert_allclose(sizes(BRICK, STRETCH), [0.48, 0.08, 0.22], rtol=1e-14)


@pytest.mark.parametrize("angle", [0.1, 0.7, np.pi / 2, 3.0])
def test_no_turn_changes_a_cube(angle):
    np.testing.assert_allclose(sizes(CUBE, turn(angle)), 0.25, rtol=1e-14)


def test_a_quarter_turn_in_many_steps_exchanges_stretched_edges():
    steps = [turn(np.pi / 2 / 50)] * 50
    np.testing.assert_allclose(sizes(CUBE, STRETCH, *steps), [0.2, 0.4, 0.275], rtol=1e-12)


def test_shear_leaves_the_thickness_of_layers():
    shear = (1.0, 0.5, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)
    np.testing.assert_allclose(sizes(CUBE, shear), [0.25 * 1.25**0.5, 0.25, 0.25], rtol=1e-14)


def domains(simulation):
    """Return half-sizes and second moments of a simulation in row order."""
    half, moments = np.zeros((simulation.solver.count, 3)), np.zeros((simulation.solver.count, 6))
    for s in simulation.solver.sets:
        half[s.row], moments[s.row] = s.half, s.domain
    return half, moments


@pytest.mark.parametrize("small", [True, False], ids=["serial", "threaded"])
@pytest.mark.parametrize("scheme", ["USL", "MUSL"])
def test_agrees_with_the_plain_twin(scheme, small):
    case = scene(stress_scheme_update=scheme, **DOMAIN)
    case["body"][1] |= {"particles_per_direction": [1, 3, 2]}
    simulation = mpmgeo.Simulation(mpmgeo.load_case(case))
    simulation.solver.small = small
    random = np.random.default_rng(7)
    velocity = simulation.field("velocity")
    simulation.assign("velocity", velocity + random.uniform(-3, 3, velocity.shape))
    twin = FollowingSolver(simulation.solver)
    start = twin.half.copy()
    assert_same_steps(simulation, twin)
    half, moments = domains(simulation)
    assert_same(half, twin.half, "half")
    assert_same(moments, twin.domain.reshape(-1, 9)[:, [0, 4, 8, 1, 5, 2]], "domain")
    assert np.abs(half - start).max() > 0.02
    assert half.max() == MOST
    assert half.min() >= FLOOR * start.min()


def cube(**keys):
    """A cube of 27 cells in free space, whose particles can be given any velocity."""
    free = {f"plane_{plane}": "free" for plane in ("X0", "Xn", "Y0", "Yn", "Z0", "Zn")}
    return (
        {
            "time": 1.0,
            "time_step": 1e-4,
            "mesh": {
                "cells_number": [9, 9, 9],
                "cells_dimension": [0.1, 0.2, 0.1],
                "boundary_conditions": free,
            },
            "materials": [
                {"type": "elastic", "id": 1, "density": 1e3, "young": 1e3, "poisson": 0.0}
            ],
            "body": [
                {
                    "type": "cuboid",
                    "point_p1": [0.3, 0.6, 0.3],
                    "point_p2": [0.6, 1.2, 0.6],
                    "material_id": 1,
                }
            ],
        }
        | DOMAIN
        | keys
    )


def test_flight_leaves_sizes_and_places():
    case = cube()
    case["body"][0]["initial_velocity"] = [2.0, -1.0, 3.0]
    simulation = mpmgeo.Simulation(case)
    start, half = simulation.field("position").copy(), domains(simulation)[0]
    simulation.step(500)
    way = simulation.field("position") - start
    np.testing.assert_allclose(way, np.tile([0.1, -0.05, 0.15], (len(way), 1)), atol=1e-13)
    np.testing.assert_allclose(domains(simulation)[0], half, atol=1e-12)


@pytest.mark.parametrize("scheme", ["USL", "MUSL"])
def test_momentum_stays(scheme):
    simulation = mpmgeo.Simulation(cube(stress_scheme_update=scheme))
    random = np.random.default_rng(3)
    count = simulation.solver.count
    simulation.assign("velocity", random.uniform(-1, 1, (count, 3)))
    simulation.assign("stress", random.uniform(-500, 500, (count, 6)))
    mass = simulation.field("mass")
    before = mass @ simulation.field("velocity")
    simulation.step(100)
    assert np.abs(mass @ simulation.field("velocity") - before).max() < 1e-12 * mass.sum()


def test_sets_of_equal_particles_pay_nothing_without_it():
    solver = mpmgeo.Simulation(cube(particle_domain="initial")).solver
    assert isinstance(solver.sets[0].half, tuple)
    assert solver.sets[0].domain is None
    assert solver.effect("domains") is None


def restless(**keys):
    """Return a simulation of the scene of the twin with domains."""
    return mpmgeo.Simulation(mpmgeo.load_case(scene(**DOMAIN, **keys)))


def test_resumed_run_is_the_uninterrupted_one(tmp_path):
    whole, first = restless(), restless()
    first.step(20).save(tmp_path / "state.npz")
    again = mpmgeo.Simulation.resume(tmp_path / "state.npz")
    whole.step(40)
    again.step(20)
    for one, other in zip(domains(whole), domains(again), strict=True):
        np.testing.assert_array_equal(one, other)
    for key in ("position", "velocity", "stress"):
        np.testing.assert_array_equal(whole.field(key), again.field(key))


def test_state_that_is_kept_holds_sizes():
    simulation = restless()
    simulation.step(20)
    before = [a.copy() for a in domains(simulation)]
    simulation.keep()
    simulation.step(20)
    simulation.restore()
    for kept, now in zip(before, domains(simulation), strict=True):
        np.testing.assert_array_equal(kept, now)


def test_threads_do_not_change_bits():
    one, two = restless(), restless()
    one.solver.small, two.solver.small = True, False
    one.step(30)
    two.step(30)
    for a, b in zip(domains(one), domains(two), strict=True):
        np.testing.assert_array_equal(a, b)


def test_particles_beyond_a_cell_are_told_of_once():
    simulation = mpmgeo.Simulation(cube())
    x = simulation.field("position")
    simulation.assign("velocity", 300.0 * (x - x.mean(axis=0)) * [1, 0, 0])
    simulation.step(150)
    told = [message for message in simulation.messages if "more than a cell" in message]
    assert len(told) == 1
    assert "particle " in told[0]
    half, moments = domains(simulation)
    assert half.max() == MOST
    assert moments.max() > LARGE
