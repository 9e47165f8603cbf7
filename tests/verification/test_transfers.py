"""Transfers of velocity beside plain FLIP: bodies that spin, vibrate in flight, are stretched."""

import numpy as np
import pytest

import mpmgeo
from mpmgeo.verify import limits, loaded_bar
from mpmgeo.verify.flight import Flight, case


def with_gradients(simulation):
    """Return the angular momentum of a square with that of gradients; quadratic spline."""
    within = sum(float((s.m * (s.C[:, 0, 1] - s.C[:, 1, 0])).sum()) for s in simulation.solver.sets)
    return limits.angular_momentum(simulation) + limits.CELL**2 / 4 * within


@pytest.mark.parametrize("transfer, error", [("apic", 1e-10), ("tpic", 0.01)])
def test_a_square_keeps_its_angular_momentum(transfer, error):
    """One turn, after which FLIP has lost half of it; nor does the square grow."""
    shape = {"shape_function": "quadratic-bspline", "transfer": transfer}
    simulation = mpmgeo.Simulation(limits.square(1.0, **shape))
    start, volume = limits.spin(simulation), simulation.field("volume").sum()
    before = limits.radius(simulation)
    simulation.run()
    assert limits.radius(simulation) / before == pytest.approx(1.0, abs=0.001)
    assert with_gradients(simulation) / start == pytest.approx(1.0, abs=error)
    assert simulation.field("volume").sum() / volume == pytest.approx(1.0, abs=0.01)


@pytest.mark.parametrize(
    "keys, most",
    [
        ({}, None),
        ({"transfer": "tpic"}, 1.0),
        ({"transfer": {"type": "flip", "flip": 0.99}, "shape_function": "cubic-bspline"}, 1.0),
    ],
    ids=["FLIP", "TPIC", "FLIP with PIC, cubic spline"],
)
def test_flight_brings_no_energy(keys, most):
    """MUSL at 0.3 wave speeds: FLIP with GIMP multiplies the vibration, TPIC never adds to it."""
    steps = 2000 if most is None else 500
    keys = {"stress_scheme_update": "MUSL", "shape_function": "GIMP"} | keys
    energy = Flight(case(0.3, 2, 0.5, steps, **keys)).energies(steps)
    assert (energy.max() > 10) if most is None else (energy.max() <= most)


def test_particles_that_cross_cells():
    """MUSL with GIMP, a bar strained by up to a fifth: FLIP gets worse with finer cells."""
    keys = {"stress_scheme_update": "MUSL", "shape_function": "GIMP"}
    flip, tpic = (
        [loaded_bar.error(cells, 0.1, transfer=transfer, **keys) for cells in (16, 32)]
        for transfer in ("flip", "tpic")
    )
    assert flip[1] > 1.2 * flip[0] > 0.05
    assert tpic[1] < tpic[0] < 0.03
    small = [loaded_bar.error(cells, 0.02, transfer="tpic", **keys) for cells in (16, 32)]
    assert small[1] < 0.6 * small[0] < 0.02


def test_a_tool_moves_as_prescribed_with_affine_particles():
    """A bar that is drawn out by a body of prescribed velocity has the stress E ln(1 + ε)."""
    simulation = mpmgeo.Simulation(limits.bar(transfer="apic")).run(until=0.5)
    assert limits.share_of_stress(simulation) == pytest.approx(1.0, abs=0.02)
    tool = simulation.field("body") == 2
    np.testing.assert_allclose(simulation.field("velocity")[tool, 0], 0.2, rtol=1e-12)
