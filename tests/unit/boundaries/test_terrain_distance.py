"""Signed distances against formulas, and against a look at every triangle."""

import numpy as np
import pytest
import terrains

from mpmgeo.boundaries.distance import FAR, Ground, distances, fill
from mpmgeo.boundaries.surface import surface_of
from mpmgeo.numerics.chunks import ALONE
from mpmgeo.state.grid import Mesh

HILL = terrains.patch(lambda x, y: np.sin(2 * x) * np.cos(y), -3.0, 3.0, 20)
BOX = terrains.box([-1, -2, -3], [1, 2, 3])


def ground(corner, low=3 * [-1e9], high=3 * [1e9], **keys):
    return Ground.of(surface_of(corner, np.zeros((len(corner), 3))), low, high, 0.01, **keys)


def measured(corner, x, **keys):
    out = np.empty(len(x))
    distances(ALONE, ground(corner, **keys), np.asarray(x, float), out)
    return out


def anywhere(count=400, size=4.0, seed=0):
    return np.random.default_rng(seed).uniform(-size, size, (count, 3))


def test_distance_to_a_box_from_inside_and_outside():
    x = anywhere()
    beyond = np.abs(x) - [1, 2, 3]
    exact = np.linalg.norm(np.maximum(beyond, 0), axis=1) + np.minimum(beyond.max(axis=1), 0)
    assert measured(BOX, x) == pytest.approx(exact, abs=1e-12)


@pytest.mark.parametrize("angle", [0, 30, 80])
@pytest.mark.parametrize("size", [1.0, 1e5])
def test_distance_to_a_plane(angle, size):
    """However large its triangles are beside the mesh."""
    x = anywhere()
    exact = x @ terrains.axes(angle)[1]
    assert measured(size * terrains.plane(angle), x) == pytest.approx(exact, abs=1e-14 * 60 * size)


def nearest_of_all(corner, x):
    """Return distances without sign, from every triangle's plane, edges and corners."""
    a, b, c = (corner[:, i] for i in range(3))
    n = np.cross(b - a, c - a)
    n /= np.linalg.norm(n, axis=1)[:, None]
    best = np.full(len(x), np.inf)
    for p in range(len(x)):
        height = ((x[p] - a) * n).sum(axis=1)
        foot = x[p] - height[:, None] * n
        inside = np.ones(len(corner), bool)
        for u, v in ((a, b), (b, c), (c, a)):
            inside &= (np.cross(v - u, foot - u) * n).sum(axis=1) >= 0
            s = np.clip(((x[p] - u) * (v - u)).sum(axis=1) / ((v - u) ** 2).sum(axis=1), 0, 1)
            best[p] = min(best[p], np.linalg.norm(x[p] - u - s[:, None] * (v - u), axis=1).min())
        if inside.any():
            best[p] = min(best[p], np.abs(height[inside]).min())
    return best


def test_distance_to_hills_by_all_triangles():
    x = anywhere(100, 2.5)
    found = measured(HILL, x)
    assert np.abs(found) == pytest.approx(nearest_of_all(HILL, x), abs=1e-12)
    above = x[:, 2] - np.sin(2 * x[:, 0]) * np.cos(x[:, 1])
    clear = np.abs(above) > 0.1  # the triangles are not the sine itself
    assert (np.sign(found) == np.sign(above))[clear].all()


def test_beyond_the_border_there_is_no_ground():
    square = terrains.patch(lambda x, y: 0 * x, -1.0, 1.0, 2)
    x = [[0.5, 0.5, -0.2], [1.3, 0, -0.4], [1.3, 0, 0.4], [1.005, 0, -0.2], [-1.3, -1.4, -0.5]]
    assert measured(square, x) == pytest.approx(
        [-0.2, 0.5, 0.5, -np.hypot(0.005, 0.2), np.sqrt(0.5)]
    )


def test_signs_as_in_mpm_geomechanics_are_those_of_the_plane():
    square = terrains.patch(lambda x, y: 0 * x, -1.0, 1.0, 2)
    assert measured(square, [[1.3, 0, -0.4], [1.3, 0, 0.4]], by_plane=True) == pytest.approx(
        [-0.5, 0.5]
    )


def nodes_of(mesh, corner):
    steps = np.stack(np.meshgrid(*3 * [np.arange(4)], indexing="ij"), -1).reshape(-1, 3)
    index = corner[:, None] * 4 + steps
    return index * np.array(mesh[:3])


def test_blocks_of_nodes():
    """Near the surface they hold the distances of their nodes, elsewhere they are far."""
    mesh, hill = Mesh.of((0.25, 0.2, 0.125), (16, 20, 32)), HILL + 2.0
    corner = np.stack(np.meshgrid(range(4), range(5), range(8), indexing="ij"), -1).reshape(-1, 3)
    out = np.empty((len(corner), 64))
    fill(ALONE, ground(hill), mesh, 0.3, corner, out)
    x = nodes_of(mesh, corner)
    exact = measured(hill, x.reshape(-1, 3)).reshape(out.shape)
    near = np.abs(out) < FAR
    assert (near.all(axis=1) | (~near).all(axis=1)).all()
    assert 0.1 < near.mean() < 0.9
    assert out[near] == pytest.approx(exact[near])
    assert (np.abs(exact[~near]) > 0.3).all()
    assert (np.sign(out) == np.sign(exact))[~near].all()


def test_a_surface_that_ends_with_the_mesh_goes_on_straight():
    """So that a particle at the edge of the mesh gathers the right distance and normal."""
    mesh = Mesh.of((0.5, 0.5, 0.5), (8, 8, 8))
    slope = terrains.patch(lambda x, y: 1.0 + 0.5 * x, 0.0, 4.0, 8)
    corner = np.array([[-1, 0, 0], [2, 0, 1], [0, -1, 0], [-1, -1, 0], [2, 2, 1]])
    out = np.empty((len(corner), 64))
    fill(ALONE, ground(slope, [0, 0, 0], [4, 4, 4]), mesh, 10.0, corner, out)
    x = nodes_of(mesh, corner)
    exact = (x[..., 2] - 1.0 - 0.5 * x[..., 0]) / np.hypot(1, 0.5)
    assert out == pytest.approx(exact)
