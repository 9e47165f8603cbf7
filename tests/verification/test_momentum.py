"""Without boundaries momentum stays; a smooth floor takes none of it along itself."""

import numpy as np
import pytest
from scenes import cuboid, scene, simulate, sphere

SCHEMES = ["USL", "MUSL", "USF"]


def momentum(simulation):
    return simulation.field("mass") @ simulation.field("velocity")


# Nodes of the linear shape with next to no mass take absurd velocities in a crash; MUSL heals it.
@pytest.mark.parametrize("locking", ["off", "cells"])
@pytest.mark.parametrize(
    ("scheme", "shape"), [("USL", "GIMP"), ("MUSL", "GIMP"), ("USF", "GIMP"), ("MUSL", "linear")]
)
def test_momentum_of_colliding_spheres(scheme, shape, locking):
    """Two spheres hit each other off centre; 1e-12 of the momentum that flies about."""
    case = scene(
        [16, 12, 12],
        0.1,
        [
            sphere([0.45, 0.6, 0.55], 0.4, initial_velocity=[2.0, 0.3, 0.0]),
            sphere([1.05, 0.6, 0.65], 0.4, initial_velocity=[-1.0, 0.0, 0.2]),
        ],
        time=0.3,
        critical_time_step_multiplier=0.3,
        stress_scheme_update=scheme,
        shape_function=shape,
        volumetric_locking=locking,
    )
    simulation = simulate(case)
    before = momentum(simulation)
    speeds = np.linalg.norm(simulation.field("velocity"), axis=1)
    size = simulation.field("mass") @ speeds
    start = simulation.kinetic_energy()
    for _ in range(10):
        simulation.run(until=simulation.time + 0.03)
        assert np.abs(momentum(simulation) - before).max() < 1e-12 * size
    assert simulation.kinetic_energy() < 0.9 * start  # they have met
    assert simulation.field("active").all()


@pytest.mark.parametrize("scheme", SCHEMES)
def test_a_box_slides_on_a_smooth_floor(scheme):
    """Weight makes it bounce up and down, its horizontal momentum stays."""
    case = scene(
        [30, 6, 8],
        0.1,
        [cuboid([0.3, 0.2, 0.0], [0.8, 0.4, 0.3], initial_velocity=[1.5, 0.0, 0.0])],
        time=1.0,
        gravity=[0, 0, -9.81],
        stress_scheme_update=scheme,
        boundary_conditions={"plane_Z0": "sliding"},
    )
    simulation = simulate(case).run()
    mass = simulation.field("mass").sum()
    x, y, _ = momentum(simulation)
    assert x == pytest.approx(1.5 * mass, rel=1e-11)
    assert abs(y) < 1e-11 * 1.5 * mass
    assert simulation.field("displacement")[:, 0].mean() == pytest.approx(1.5 * simulation.time)


def test_a_fixed_floor_stops_the_box():
    """Nodes come to rest; particles may keep velocities that cancel out at every node."""
    case = scene(
        [30, 6, 8],
        0.1,
        [cuboid([0.3, 0.2, 0.0], [0.8, 0.4, 0.3], initial_velocity=[0.5, 0.0, 0.0])],
        time=2.0,
        gravity=[0, 0, -9.81],
        damping={"type": "local", "value": 0.2},
        boundary_conditions={"plane_Z0": "fixed"},
    )
    simulation = simulate(case).run()
    nodes = simulation.nodes()
    start = 0.5 * nodes.mass.sum() * 0.5**2
    assert 0.5 * nodes.mass @ (nodes.velocity**2).sum(axis=1) < 1e-3 * start
    assert np.abs(simulation.field("displacement")[:, 0]).max() < 1e-3
