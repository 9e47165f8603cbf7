"""Blocks, their keys and who covers whom, against plain searches."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

from mpmgeo.state.grid import (
    CHUNKS,
    KEY_SHIFT,
    Grid,
    Mesh,
    corners_of,
    cut,
    keys_of,
)
from mpmgeo.state.layout import NODES, SIDE

WIDTHS = (2, 3, 4, 5, 6, 9, 10)
MESH = Mesh.of((1.0, 1.0, 1.0), (40, 40, 40))


def random_corners(seed, count=40, extent=4):
    """Return some block corners, negative ones too, without duplicates and in order of keys."""
    random = np.random.default_rng(seed)
    corners = np.unique(random.integers(-extent, extent, (count, 3)), axis=0)
    return corners[np.argsort(keys_of(corners))]


def covered(width, corners):
    """Return the grid of a shape whose owner blocks are at `corners`."""
    grid = Grid(MESH, 3 * (width,))
    grid.cover(keys_of(corners))
    return grid


def test_mesh_symbols():
    mesh = Mesh.of((0.5, 0.25, 2), (3, 4, 5))
    assert (mesh.hx, mesh.hy, mesh.hz) == (0.5, 0.25, 2.0)
    assert (mesh.ix, mesh.iy, mesh.iz) == (2.0, 4.0, 0.5)
    assert (mesh.nx, mesh.ny, mesh.nz) == (3, 4, 5)
    assert all(isinstance(value, float) for value in mesh[:6])


limit = st.integers(-KEY_SHIFT, KEY_SHIFT - 1)


@given(hnp.arrays(np.int64, st.tuples(st.integers(1, 20), st.just(3)), elements=limit))
def test_keys_name_corners_and_sort_like_them(corners):
    keys = keys_of(corners)
    assert (corners_of(keys) == corners).all()
    by_key, by_corner = corners[np.argsort(keys)], corners[np.lexsort(corners.T[::-1])]
    assert (by_key == by_corner).all()


@pytest.mark.parametrize("width", WIDTHS)
def test_sizes_follow_from_the_width(width):
    grid = Grid(MESH, 3 * (width,))
    assert grid.rows == 3 * (SIDE + width - 1,)
    assert grid.record == grid.rows[0] ** 3 * 8
    # the nodes of a tile, counted from the block's first one, lie over that many blocks
    assert grid.reach == 3 * ((grid.rows[0] - 1) // SIDE + 1,)


@pytest.mark.parametrize("width", WIDTHS)
def test_above_and_below_agree_with_a_search(width):
    corners = random_corners(width)
    grid = covered(width, corners)
    axis = range(grid.reach[0])
    steps = [np.array([i, j, k]) for i in axis for j in axis for k in axis]
    owner = {tuple(c): b for b, c in enumerate(corners.tolist())}
    reached = {tuple(c + step) for c in corners for step in steps}
    assert set(map(tuple, grid.active_corner)) == reached
    assert len(grid.active) == len(reached)
    assert (np.diff(grid.active) > 0).all()
    for o, step in enumerate(steps):
        assert (grid.active_corner[grid.above[:, o]] == corners + step).all()
        expected = [owner.get(tuple(c), -1) for c in (grid.active_corner - step).tolist()]
        assert grid.below[:, o].tolist() == expected


@pytest.mark.parametrize("width", WIDTHS)
def test_buffers_have_room(width):
    grid = covered(width, random_corners(width))
    assert grid.tiles.size >= len(grid.keys) * grid.record
    assert grid.nodes.size >= len(grid.active) * NODES * 8
    assert grid.scratch.size == CHUNKS * grid.record
    assert grid.records().shape == grid.indices().shape[:2] + (8,) == (len(grid.active), NODES, 8)
    assert grid.tiles.ctypes.data % 64 == grid.nodes.ctypes.data % 64 == 0


def test_indices_count_z_fastest():
    grid = covered(3, np.array([[-1, 2, 0]]))
    first = grid.indices()[0]
    assert first[:5].tolist() == [[-4, 8, 0], [-4, 8, 1], [-4, 8, 2], [-4, 8, 3], [-4, 9, 0]]
    assert first[-1].tolist() == [-1, 11, 3]


@pytest.mark.parametrize("width", [3, 10])
def test_records_follow_their_blocks(width):
    """Nodes that stay active keep their record, others begin at zero."""
    grid = covered(width, random_corners(1))
    grid.records()[:] = grid.active_corner.sum(axis=1)[:, None, None] + 1000.0
    before = set(map(tuple, grid.active_corner))
    grid.cover(keys_of(random_corners(2, count=60)))
    stayed = np.array([tuple(c) in before for c in grid.active_corner])
    assert stayed.any() and not stayed.all()
    expected = np.where(stayed, grid.active_corner.sum(axis=1) + 1000.0, 0.0)
    assert (grid.records() == expected[:, None, None]).all()


def test_no_blocks_at_all():
    grid = covered(3, random_corners(3))
    grid.cover(np.empty(0, np.int64))
    assert grid.active.size == grid.above.size == grid.below.size == grid.records().size == 0


def test_buffers_shrink_with_the_particles():
    grid = covered(3, random_corners(4, count=400, extent=8))
    large = grid.nbytes()
    grid.cover(keys_of(np.array([[0, 0, 0]])))
    assert grid.nbytes() < large / 3


@given(st.lists(st.integers(0, 50), min_size=0, max_size=300))
def test_cut_covers_all_blocks_once_and_evenly(work):
    start = np.concatenate([[0], np.cumsum(work, dtype=np.int64)])
    bounds = cut(start)
    assert len(bounds) == CHUNKS + 1
    assert bounds[0] == 0 and bounds[-1] == len(work)
    assert (np.diff(bounds) >= 0).all()
    if len(work):
        largest = np.diff(start[bounds]).max(initial=0)
        assert largest <= start[-1] / CHUNKS + 2 * max(work)
