"""A prestressed body that spins rigidly: with an objective rate the stress turns with it."""

from math import cos, sin

import numpy as np
import pytest
from scenes import RUBBER, cuboid, initial_position, scene, simulate

CENTRE = np.array([0.8, 0.8, 0.8])
STRESS = np.array([-3e3, 1e3, 2e3, 0.0, 0.0, 0.0])
ANGLE = 1e-3  # of a step


def spinning(rate, scheme="USL"):
    """Return a simulation of a block that spins about z by ANGLE a step, under uniform stress.

    The first step turns it without strain in the eyes of the rate: Hughes and Winget's sees
    displacements, others see velocities.
    """
    case = scene(
        [8, 8, 8],
        0.2,
        [cuboid([0.2, 0.2, 0.2], [1.4, 1.4, 1.4])],
        materials=[RUBBER | {"objective_rate": rate}],
        time=1.0,
        time_step=1e-4,
        stress_scheme_update=scheme,
    )
    simulation = simulate(case)
    x = simulation.field("position") - CENTRE
    across = np.stack([-x[:, 1], x[:, 0], 0 * x[:, 0]], axis=1)
    step = ANGLE * across
    if rate == "hughes-winget":
        step = sin(ANGLE) * across - (1 - cos(ANGLE)) * x * [1, 1, 0]
    simulation.assign("velocity", step / simulation.time_step)
    simulation.assign("stress", np.tile(STRESS, (len(x), 1)))
    return simulation


def turned(angle):
    Q = np.array([[cos(angle), -sin(angle), 0], [sin(angle), cos(angle), 0], [0, 0, 1]])
    σ = Q @ np.diag(STRESS[:3]) @ Q.T
    return np.array([σ[0, 0], σ[1, 1], σ[2, 2], σ[0, 1], σ[1, 2], σ[0, 2]])


def inside(simulation, steps):
    """Return the stresses of the particles that the surface has not reached yet (n, 6)."""
    simulation.step(steps)
    far = np.abs(initial_position(simulation) - CENTRE).max(axis=1) < 0.6 - 0.2 * (steps + 1)
    assert far.sum() >= 8
    return simulation.field("stress")[far]


@pytest.mark.parametrize("scheme", ["USL", "USF"])
def test_stress_turns_with_the_body(scheme):
    """Without a rate it stays; the rates agree with the turn to their order in the angle."""
    largest = np.abs(STRESS).max()
    error = {
        rate: np.abs(inside(spinning(rate, scheme), 1) - turned(ANGLE)).max() / largest
        for rate in ("none", "jaumann", "hughes-winget")
    }
    assert error["none"] > ANGLE
    assert error["jaumann"] < 3 * ANGLE**2
    assert error["hughes-winget"] < ANGLE**2
