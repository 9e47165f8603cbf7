"""A Newtonian fluid at rest, and the time step that its viscosity allows."""

import numpy as np
import pytest
from scenes import cuboid, initial_position, scene, simulate

from mpmgeo.run.watch import Diverged

WATER = {"type": "newtonian", "id": 1, "density": 1000.0, "viscosity": 1.0, "bulk": 2.5e6}


@pytest.mark.parametrize("scheme", ["USL", "MUSL"])
def test_hydrostatic_column(scheme):
    """The mean of every cell, in all directions, to 0.2 % of the largest pressure; no shear.

    Particles share the mean of their cell: single ones are off by a quarter of its weight.
    """
    case = scene(
        [1, 1, 20],
        0.1,
        [cuboid([0, 0, 0], [0.1, 0.1, 1.5])],
        materials=[WATER],
        time=1.0,
        gravity=[0, 0, -10.0],
        damping={"type": "kinetic"},
        stress_scheme_update=scheme,
    )
    simulation = simulate(case).run()
    depth = 1.5 - initial_position(simulation)[:, 2]
    exact = -1000.0 * 10.0 * depth.reshape(-1, 8).mean(axis=1)
    found = simulation.field("stress").reshape(-1, 8, 6).mean(axis=1)
    assert np.abs(found[:, :3] - exact[:, None]).max() < 0.002 * np.abs(exact).max()
    assert np.abs(found[:, 3:]).max() < 1e-6 * np.abs(exact).max()


def test_pool():
    """A pool twenty cells wide: ρ g × depth in every cell, to 0.1 % of that at the base."""
    h = 0.01
    case = scene(
        [20, 1, 14],
        h,
        [cuboid([0, 0, 0], [0.2, h, 0.1])],
        materials=[WATER | {"density": 1800.0, "viscosity": 0.0, "bulk": 1e6}],
        boundary_conditions={"plane_Zn": "free"},
        time=0.2,
        gravity=[0, 0, -9.81],
        damping={"type": "kinetic"},
        stress_scheme_update="MUSL",
    )
    simulation = simulate(case).run()
    depth = 0.1 - initial_position(simulation)[:, 2].reshape(-1, 8).mean(axis=1)
    found = simulation.field("stress")[:, 2].reshape(-1, 8).mean(axis=1)
    assert np.abs(found + 1800.0 * 9.81 * depth).max() < 1e-3 * 1800.0 * 9.81 * 0.1


def thick(**keys):
    """Return the simulation of a block of syrup in random motion."""
    block = cuboid([0.03, 0.03, 0.0], [0.53, 0.53, 0.5])
    syrup = WATER | {"viscosity": 1e5, "bulk": 1e6}
    simulation = simulate(scene([6, 6, 8], 0.1, [block], materials=[syrup], time=1.0, **keys))
    velocity = np.random.default_rng(0).normal(scale=0.1, size=simulation.field("velocity").shape)
    simulation.assign("velocity", velocity)
    return simulation


def test_automatic_time_step_of_a_thick_fluid():
    """The viscous limit keeps stable what the wave speed alone would not."""
    simulation = thick()
    assert simulation.time_step < 2e-2 * 0.25 * 0.1 / 31.6
    simulation.step(200)
    assert np.abs(simulation.field("velocity")).max() < 0.5
    with pytest.raises(Diverged):
        thick(time_step=0.25 * 0.1 / 31.6).step(200)


def test_old_time_step_does_not_know_viscosity():
    simulation = thick(compatibility="mpm-geomechanics")
    assert simulation.time_step == pytest.approx(0.25 * 0.1 / np.sqrt(1e3))
