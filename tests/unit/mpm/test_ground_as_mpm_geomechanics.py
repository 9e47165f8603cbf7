"""Distances and densities that files show, as MPM-Geomechanics has them: of a step's beginning."""

from pathlib import Path

import numpy as np
import pytest
import terrains
from terrains import on_slope, simulate, text_of

ANGLE = 20
OLD = {"compatibility": "mpm-geomechanics", "time_step": 1e-3}


def slope(tmp_path, **keys):
    """Return the simulation of a block some of whose particles are below a slope."""
    case = on_slope(tmp_path, ANGLE, 0.2, path=1.0, **({"gap": -0.3} | OLD | keys))
    tilt = np.tan(np.radians(ANGLE))
    triangles = terrains.patch(lambda x, y: -tilt * x, -20.0, 20.0, 40)  # small: others are lost
    Path(case["terrain_contact"]["stl_mesh"]).write_text(text_of(triangles))
    return simulate(case)


def height(simulation):
    return simulation.field("position") @ terrains.axes(ANGLE)[1]


def test_the_distance_is_that_gathered_before_particles_move(tmp_path):
    """On a plane it is exact; below the surface it is 0, where the particle has been put."""
    simulation = slope(tmp_path)
    assert simulation.field("distance_levelset") == pytest.approx(height(simulation))
    for steps in (1, 30):
        simulation.step(steps - simulation.steps - 1)
        before = height(simulation)
        simulation.step()
        found = simulation.field("distance_levelset")
        assert found == pytest.approx(np.maximum(before, 0.0), abs=1e-12)
        assert (found > 0).any()
    assert np.abs(height(simulation) - before).max() > 1e-6
    first = slope(tmp_path)
    assert (height(first) < 0).any()
    first.step()
    assert (first.field("distance_levelset") == 0).any()


def test_particles_that_are_far_have_their_distance(tmp_path):
    simulation = slope(tmp_path, size=(2, 2, 6), gap=0.0).step(5)
    far = height(simulation) > 3
    assert far.any() and not simulation.field("particle_contact_flag")[far].any()
    assert simulation.field("distance_levelset")[far] == pytest.approx(height(simulation)[far])


def weight(g, l=0.25):
    """Return the shape of a particle of half-size l at g from a node, both in cells."""
    a = np.abs(g)
    near, far = 1 - (a**2 + l**2) / (2 * l), (1 + l - a) ** 2 / (4 * l)
    return np.where(a < l, near, np.where(a < 1 - l, 1 - a, np.where(a < 1 + l, far, 0.0)))


def test_above_a_ridge_the_distances_of_the_nodes_are_gathered(tmp_path):
    case = on_slope(tmp_path, 0, 0.2, path=1.0, gap=0.3, **OLD)
    ridge = terrains.patch(lambda x, y: -0.5 * np.abs(x - 1.3), -20.3, 19.7, 40)
    Path(case["terrain_contact"]["stl_mesh"]).write_text(text_of(ridge))
    simulation = simulate(case).step(4)
    x = simulation.field("position")
    simulation.step()
    steps = np.stack(np.meshgrid(*3 * [np.arange(-1, 3)], indexing="ij"), -1).reshape(-1, 3)
    node = np.floor(x)[:, None] + steps  # cells of 1 m, an origin of whole metres
    S = weight(x[:, None] - node).prod(axis=2)
    zero = np.array(simulation.case.mesh.origin)
    d = simulation.solver.ground.distance((node - zero).reshape(-1, 3)).reshape(S.shape)
    assert S.sum(axis=1) == pytest.approx(1)
    touching = simulation.field("particle_contact_flag") == 1
    gathered, exact = (S * d).sum(axis=1), simulation.solver.ground.distance(x - zero)
    assert simulation.field("distance_levelset")[touching] == pytest.approx(gathered[touching])
    assert np.abs(gathered - exact)[touching].max() > 1e-3


def moments(simulation):
    """Return volume and first moment (3,) of what the density at the nodes stands for."""
    solver = simulation.solver
    index, density = solver.ground.density(solver)
    return density.sum(), density @ index + density.sum() * np.array(solver.population.zero)


@pytest.mark.parametrize("scheme", ["USL", "MUSL"])
def test_the_density_is_that_before_particles_move(tmp_path, scheme):
    """In cells of 1 m³ the nodes hold volume and first moment of the particles, as they were."""
    keys = {"stress_scheme_update": scheme}
    asked = {"print": 1, "grid_nodal_results": ["density_levelset"]}
    simulation = slope(tmp_path, results=asked, **keys)
    assert moments(simulation)[0] == 0
    volume = simulation.solver.population.size.prod(axis=1)
    simulation.step(20)
    before = volume @ simulation.field("position")
    simulation.step()
    found = moments(simulation)
    assert found[0] == pytest.approx(volume.sum())
    assert found[1] == pytest.approx(before, rel=1e-12)
    assert np.abs(volume @ simulation.field("position") - before).max() > 1e-5
    simulation.arrange()
    assert moments(simulation)[1] == pytest.approx(before, rel=1e-12)
    unasked = slope(tmp_path, **keys).step(21)
    assert (unasked.field("position") == simulation.field("position")).all()
