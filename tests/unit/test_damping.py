"""Damping at the nodes: how fast it takes motion away, and several kinds together."""

from math import exp, log

import numpy as np
import pytest
from assembly import assemble, by_row, planes, simulate, two_blocks

from mpmgeo.damping import LocalDamping, MassDamping
from mpmgeo.damping.damping import damp, damp_all

V = np.array([3.0, -2.0, 1.0])


def drifting(α, dt, scheme="USL", **more):
    """Return the solver of a body that flies freely against mass-proportional damping."""
    place = np.stack(np.meshgrid(*[np.arange(4) / 2 + 4.25] * 3), -1).reshape(-1, 3)
    damping = (MassDamping(alpha=α).symbols,)
    keys = {"mass": 1e9, "damping": damping, "time_step": dt, "scheme": scheme}
    return assemble(place, velocity=V, **keys, **more)


def left(α, dt, time, **more):
    """Return what is left of the velocity after a time, relative to the start."""
    solver = drifting(α, dt, **more)
    for _ in range(round(time / dt)):
        solver.step()
    v = by_row(solver, "v")
    assert np.abs(np.cross(v, V)).max() < 1e-12  # straight on
    return v[:, 0] / V[0], solver


@pytest.mark.parametrize("scheme", ["USL", "MUSL", "USF"])
def test_a_free_body_slows_down_as_an_exponential(scheme):
    """To 1e-3 with αΔt = 0.05, until a tenth is left; velocities are half a step early."""
    α, dt = 2.0, 0.025
    time = dt * round(log(10) / α / dt)
    share, _ = left(α, dt, time, scheme=scheme)
    assert share == pytest.approx(exp(-α * (time - dt / 2)), rel=1e-3)


def test_the_error_is_of_second_order():
    α, time = 2.0, 0.8
    steps = np.array([0.1, 0.05, 0.025, 0.0125])
    errors = [abs(left(α, dt, time)[0][0] - exp(-α * (time - dt / 2))) for dt in steps]
    assert np.diff(np.log(errors)) / np.diff(np.log(steps)) == pytest.approx(2.0, abs=0.1)


def test_it_acts_along_planes_only():
    """On planes that slide nothing moves across; a plane takes no more than it must."""
    solver = drifting(2.0, 1e-3, planes=planes("sliding"))
    for _ in range(50):
        solver.step()
    assert by_row(solver, "v") / V == pytest.approx(np.full((64, 3), exp(-2.0 * 0.0495)), rel=1e-6)


def test_several_act_in_turn():
    α, β = 0.3, 5.0
    local, mass = LocalDamping(value=α).symbols, MassDamping(alpha=β).symbols
    a, v, h = (1.0, -2.0, 0.5), (0.2, 0.4, -0.1), 1e-2
    first = damp(local, h, *a, *v)
    assert damp_all((local, mass), h, *a, *v) == damp(mass, h, *first, *v)
    assert damp_all((), h, *a, *v) == a


def test_the_case_orders_them():
    """Forces of other kinds first: the mass-proportional one is implicit."""
    kinds = [{"type": "mass", "alpha": 4.0}, {"type": "kinetic"}, {"type": "local", "value": 0.1}]
    solver = simulate(two_blocks(damping=kinds)).solver
    assert solver.damping == (LocalDamping(value=0.1).symbols, MassDamping(alpha=4.0).symbols)
    assert solver.effect("kinetic damping") is not None


def test_with_the_old_form_of_local_damping():
    kinds = [{"type": "local", "value": 0.1}, {"type": "mass", "alpha": 4.0}]
    solver = simulate(two_blocks(damping=kinds, compatibility="mpm-geomechanics")).solver
    assert solver.damping == (MassDamping(alpha=4.0).symbols,)
    assert solver.early_damping == LocalDamping(value=0.1).symbols


def test_the_old_form_of_kinetic_damping_stops_when_the_next_step_begins():
    """So files show velocities before the stop; the motion is the same."""
    case = two_blocks(damping={"type": "kinetic"}, gravity=[0, 0, -9.81])
    case["mesh"]["boundary_conditions"] |= {"plane_Z0": "fixed"}
    case["body"] = case["body"][:1]
    case["body"][0] |= {"point_p1": [1, 1, 0], "point_p2": [2, 2, 1]}
    new, old = simulate(case), simulate(case | {"compatibility": "mpm-geomechanics"})
    stops, energy = 0, 0.0
    for _ in range(150):
        new.step()
        old.step()
        assert old.field("position") == pytest.approx(new.field("position"), abs=1e-12)
        assert old.output_energy() == pytest.approx(new.output_energy())
        assert old.kinetic_energy() == old.output_energy() > 0
        passed = old.output_energy() < energy
        assert passed == (new.kinetic_energy() == 0)
        energy = 0.0 if passed else old.output_energy()
        stops += passed
    assert stops > 1
