"""Scaled inertia: the same forces, longer steps, the same rest."""

import numpy as np
import pytest

import mpmgeo

WEIGHT, HEIGHT = 2000 * 9.81, 1.0


def column(scaling, **more):
    """Return the simulation of a column of ten cells under its weight."""
    walls = {f"plane_{axis}{side}": "sliding" for axis in "XY" for side in "0n"}
    case = {
        "time": 20.0,
        "gravity": [0, 0, -9.81],
        "stress_scheme_update": "MUSL",
        "critical_time_step_multiplier": 0.3,
        "density_scaling": scaling,
        "mesh": {
            "cells_number": [1, 1, 12],
            "cells_dimension": [0.1, 0.1, 0.1],
            "boundary_conditions": {"plane_Z0": "fixed", **walls},
        },
        "materials": [{"type": "elastic", "id": 1, "density": 2000, "young": 1e6, "poisson": 0.3}],
        "body": [
            {
                "type": "cuboid",
                "point_p1": [0, 0, 0],
                "point_p2": [0.1, 0.1, HEIGHT],
                "material_id": 1,
            }
        ],
        "damping": {"type": "local", "value": 0.3},
        "results": {"print": 1},
    }
    return mpmgeo.Simulation(mpmgeo.load_case(case | more))


@pytest.mark.parametrize("scheme", ["USL", "MUSL", "USF"])
@pytest.mark.parametrize("damping", [{"type": "local", "value": 0.3}, {"type": "kinetic"}])
def test_four_times_the_inertia_in_steps_twice_as_long_is_the_same_path(scheme, damping):
    """Step by step and bit for bit, with half the velocities, for all is divided by powers of 2."""
    more = {"stress_scheme_update": scheme, "damping": damping}
    real = column(1, time_step=5e-4, **more).step(200)
    scaled = column(4, time_step=1e-3, **more).step(200)
    assert scaled.field("position").tobytes() == real.field("position").tobytes()
    assert scaled.field("stress").tobytes() == real.field("stress").tobytes()
    assert (2.0 * scaled.field("velocity")).tobytes() == real.field("velocity").tobytes()
    assert scaled.stable_time_step == pytest.approx(2.0 * real.stable_time_step)
    assert scaled.critical_time_step == pytest.approx(2.0 * real.critical_time_step)


@pytest.mark.parametrize("time_step", [None, "adaptive"])
def test_rest_is_the_same(time_step):
    until = {"unbalanced_force": 3e-4, "kinetic_energy": 1e-6}
    more = {"until": until} | ({"time_step": time_step} if time_step else {})
    real, scaled = column(1, **more).run(), column(100, **more).run()
    assert scaled.time_step == pytest.approx(10 * real.time_step, rel=0.05)
    assert scaled.steps == pytest.approx(real.steps, rel=0.1)
    z, stress = scaled.field("position")[:, 2], scaled.field("stress")[:, 2]
    assert np.abs(stress + WEIGHT * (HEIGHT - z)).max() < 0.04 * WEIGHT * HEIGHT
    assert np.array_equal(scaled.field("mass"), real.field("mass"))
    assert scaled.field("density") == pytest.approx(real.field("density"), rel=1e-3)


def test_long_steps_are_stable():
    """0.9 of the limit that is stated, which has grown tenfold."""
    step = 0.9 * column(100).stable_time_step
    simulation = column(100, time_step=step, until={"unbalanced_force": 1e-3}).run()
    assert simulation.stopped


def test_a_note_tells_the_factor():
    assert any("10 times as long" in message for message in column(100).messages)
    assert not any("density_scaling" in message for message in column(1).messages)


@pytest.mark.parametrize(
    "more, words",
    [
        ({"damping": {"type": "none"}}, 'type "local" or "kinetic"'),
        ({"damping": {"type": "mass", "alpha": 1.0}}, 'type "local" or "kinetic"'),
        ({"stress_scheme_update": "NPC"}, "is not for"),
        ({"compatibility": "mpm-geomechanics"}, "real inertia"),
        ({"results": {"energy": {"every": 1}}}, "balance of energy"),
        ({"n_phases": 2}, "two phases"),
        ({"density_scaling": 0.5}, "at least 1"),
    ],
)
def test_refused(more, words):
    with pytest.raises(mpmgeo.CaseError, match=words):
        column(100, **more)
