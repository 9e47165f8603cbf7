"""A body force from a script: exact motion, energy, the same bits after a snapshot, refusals."""

from math import cos, pi, sin

import numpy as np
import pytest
from scenes import cuboid, scene

import mpmgeo

BODIES = [cuboid([1, 1, 6], [2, 2, 7]), cuboid([2.5, 1, 3], [3.5, 2, 4], material_id=2)]
SOFT = {"type": "neo-hookean", "density": 500.0, "young": 1e5, "poisson": 0.2}
ω = 2 * pi / 0.4


def case(**keys):
    laws = [SOFT | {"id": 1}, SOFT | {"id": 2, "density": 1500.0}]
    keys = {"time": 0.4, "time_step": 2e-3, "gravity": [0, 0, 0], "materials": laws} | keys
    return scene([5, 4, 9], 1.0, BODIES, **keys)


def swinging(t, X):
    """Return the same acceleration for all particles."""
    return np.broadcast_to([3 * cos(ω * t), 0, -5 * sin(ω * t)], X.shape)


def stretching(t, X):
    """Return accelerations that pull the bodies apart."""
    return 40 * np.cos(3 * t) * np.sin(pi * X)


@pytest.mark.parametrize("scheme", ["USL", "MUSL", "USF"])
def test_a_rigid_motion_is_the_sum_of_its_accelerations(scheme):
    """By the rule of midpoints: velocities half a step before positions, to round-off."""
    simulation = mpmgeo.Simulation(case(stress_scheme_update=scheme), body_force=swinging)
    v, u, dt = np.zeros(3), np.zeros(3), simulation.time_step
    for n in range(60):
        v += (0.5 if n == 0 else 1.0) * dt * swinging(n * dt, np.zeros((1, 3)))[0]
        u += dt * v
        simulation.step()
    assert np.abs(simulation.field("velocity") - v).max() < 1e-12
    assert np.abs(simulation.field("displacement") - u).max() < 1e-12


def test_it_adds_to_gravity_and_constant_loads_at_the_places_of_the_start():
    load = {"point_p1": [1, 1, 6], "point_p2": [2, 2, 7], "load": [400.0, 0, 0]}
    keys = {"gravity": [0, 0, -1.0], "load_distributed_box": [load]}
    given = case(**keys)
    given["mesh"]["origin"] = [0.5, 0.0, 0.0]
    simulation = mpmgeo.Simulation(given, body_force=lambda t, X: 0.1 * X + t)
    start = simulation.field("position")
    simulation.step(20)
    m, t = simulation.field("mass")[:, None], simulation.time
    force = m * (0.1 * start + t + [0, 0, -1])
    force[:, 0] += np.repeat([50.0, 0.0], [8, 8])
    np.testing.assert_allclose(simulation.field("external_force"), force, rtol=1e-12)


def test_the_balance_of_energy_counts_its_work():
    keys = {"results": {"energy": {"every": 1}}, "stress_scheme_update": "MUSL"}
    simulation = mpmgeo.Simulation(case(**keys), body_force=swinging).run(until=0.13)
    row = simulation.energy()
    assert row["external"] > 100
    assert abs(row["balance"]) < 1e-9 * row["external"]


def test_a_resumed_run_has_the_same_bits(tmp_path):
    """With and without a balance of energy; particles have been sorted on the way."""
    keys = {"results": {"energy": {"every": 4}}}
    whole = mpmgeo.Simulation(case(**keys), body_force=stretching).step(100)
    first = mpmgeo.Simulation(case(**keys), body_force=stretching).step(60)
    first.save(tmp_path / "s.npz")
    again = mpmgeo.Simulation.resume(tmp_path / "s.npz", body_force=stretching).step(40)
    for key in ("position", "velocity", "stress", "deformation_gradient", "external_force"):
        assert (again.field(key) == whole.field(key)).all(), key
    assert again.energy() == whole.energy()
    with pytest.raises(ValueError, match="has a body_force, a function that no file holds"):
        mpmgeo.Simulation.resume(tmp_path / "s.npz")
    mpmgeo.Simulation(case()).save(tmp_path / "plain.npz")
    with pytest.raises(ValueError, match="has no body_force; leave it out"):
        mpmgeo.Simulation.resume(tmp_path / "plain.npz", body_force=stretching)


@pytest.mark.parametrize(
    ("force", "message"),
    [
        (lambda t, X: X[:, 0], r"the shape \(16,\); accepted: \(16, 3\)"),
        (lambda t, X: X / t, r"in row 0 at 0 s"),
    ],
    ids=["shape", "not finite"],
)
def test_values_that_cannot_be_are_refused(force, message):
    with (
        np.errstate(divide="ignore"),
        pytest.raises(ValueError, match=f"body_force returns.*{message}"),
    ):
        mpmgeo.Simulation(case(), body_force=force)


def test_what_does_not_go_with_it_is_refused():
    load = {"point_p1": [1, 1, 6], "point_p2": [2, 2, 7], "load": [1, 0, 0]}
    load["ramp"] = {"type": "sine", "duration": 0.1}
    with pytest.raises(ValueError, match="loads on particles that change in time"):
        mpmgeo.Simulation(case(load_distributed_box=[load]), body_force=swinging)
    fluid = {"density_fluid": 1000.0, "porosity": 0.4, "bulk_fluid": 1e6}
    fluid |= {"hydraulic_conductivity": [1e-3, 1e-3, 1e-3]}
    laws = [law | fluid for law in case()["materials"]]
    with pytest.raises(ValueError, match="body_force is for one phase"):
        mpmgeo.Simulation(case(materials=laws, n_phases=2), body_force=swinging)
