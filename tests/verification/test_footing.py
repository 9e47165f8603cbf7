"""A strip footing pushed into cohesive ground: Prandtl's bearing capacity, to first order in h."""

import numpy as np
import pytest
from scenes import cuboid, scene, simulate

from mpmgeo.verify.footing import bearing_capacity

COHESION, HALF_WIDTH = 1000.0, 1.0
WIDTH, DEPTH = 5.0, 2.5
SPEED, WAY = 0.02, 0.045
GROUND = {
    "type": "mohr-coulomb",
    "id": 1,
    "density": 1000.0,
    "young": 1e6,
    "poisson": 0.3,
    "friction": 0.0,
    "cohesion": COHESION,
}


def pressure(h, sideways=None, **keys):
    """Return settlement [m] and mean pressure [Pa] under half a rigid footing, in time, and it all.

    `sideways`: velocity [m/s] of the footing along x; None: it is free there, thus smooth.
    """
    footing = cuboid([0, 0, DEPTH], [HALF_WIDTH, h, DEPTH + 2 * h])
    case = scene(
        [round(WIDTH / h), 1, round(DEPTH / h) + 4],
        h,
        [cuboid([0, 0, 0], [WIDTH, h, DEPTH]), footing],
        materials=[GROUND],
        boundary_conditions={"plane_Z0": "fixed", "plane_Zn": "free"},
        time=WAY / SPEED,
        critical_time_step_multiplier=0.5,
        damping={"type": "local", "value": 0.1},
        prescribed_velocity=[{"body": 2, "velocity": [sideways, None, -SPEED], "every": 20}],
        **keys,
    )
    simulation, rows = simulate(case), []
    while simulation.time < WAY / SPEED:
        simulation.step(20)
        force = -simulation.reactions()["prescribed_velocity_1"][2]
        rows.append((SPEED * simulation.time, force / (h * HALF_WIDTH)))
    return *np.array(rows).T, simulation


def plateau(way, q):
    """Return the mean pressure over the last third of the way, and by how much it still grows."""
    late = way > 2 / 3 * WAY
    slope, _ = np.polyfit(way[late], q[late], 1)
    return q[late].mean(), slope * WAY / 3


def mean_stresses(simulation, h):
    """Return the mean stresses [Pa] of the cells, x by z, of the ground beside and below."""
    ground = simulation.field("body") == 1
    x, _, z = np.floor(simulation.field("position")[ground].T / h).astype(int)
    V, p = simulation.field("volume")[ground], simulation.field("stress")[ground, :3].mean(axis=1)
    size = round(WIDTH / h), round(DEPTH / h) + 1
    sums = [np.zeros(size), np.zeros(size)]
    np.add.at(sums[0], (x, z), V)
    np.add.at(sums[1], (x, z), V * p)
    part = np.s_[: round(2 * HALF_WIDTH / h), round(1.0 / h) : round(DEPTH / h) - 1]
    return sums[1][part] / sums[0][part]


@pytest.mark.slow
def test_bearing_capacity():
    """The tool and what it drives with it are up to a cell larger than it is, and nothing is done
    against locking: the pressure is too high, by a share that halves with the cell. It stays on a
    plateau, and what two cell sizes extrapolate to is right.
    """
    exact = bearing_capacity(COHESION)
    (coarse, growth), (fine, finer_growth) = (plateau(*pressure(h)[:2]) for h in (0.125, 0.0625))
    assert 1.2 < coarse / exact < 1.35
    assert 1.1 < fine / exact < 1.2
    assert abs(growth) < 0.03 * exact
    assert abs(finer_growth) < 0.02 * exact
    assert 2 * fine - coarse == pytest.approx(exact, rel=0.03)


@pytest.mark.slow
def test_bearing_capacity_with_the_cure_of_locking():
    """Within 5 % for the width that is driven: to half a cell beyond the last node of the tool,
    which must not spread. Pressures of neighbouring cells do not alternate.
    """
    h = 0.0625
    way, q, simulation = pressure(h, sideways=0.0, volumetric_locking="cells")
    found, growth = plateau(way, q)
    driven = 1 + h / 2 / HALF_WIDTH
    assert found == pytest.approx(driven * bearing_capacity(COHESION), rel=0.05)
    assert abs(growth) < 0.03 * bearing_capacity(COHESION)
    p = mean_stresses(simulation, h)
    alternating = 0.25 * (p[1:, 1:] - p[:-1, 1:] - p[1:, :-1] + p[:-1, :-1])
    assert np.sqrt((alternating**2).mean()) < 0.05 * np.sqrt((p**2).mean())
