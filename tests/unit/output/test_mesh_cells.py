from types import SimpleNamespace

import numpy as np
import pytest
import pyvista

from mpmgeo.output.mesh_cells import all_cells, block_cells
from mpmgeo.output.vtu import write_hexahedra

MESH = SimpleNamespace(
    cells_number=(3, 1, 6), cells_dimension=(0.5, 0.25, 2.0), origin=(-1.0, 10.0, 0.3)
)
NODES = np.array([8, 6, 11])


def every_block():
    return [(i, j, k) for i in range(0, 8, 4) for j in range(0, 8, 4) for k in range(0, 12, 4)]


def test_nodes_and_cells_are_numbered_x_fastest_with_ghosts():
    cells = all_cells(MESH)
    assert cells.points.shape == (8 * 6 * 11, 3)
    assert cells.connectivity.shape == (7 * 5 * 10, 8)
    assert cells.node_id.dtype == cells.cell_id.dtype == np.uint64
    np.testing.assert_array_equal(cells.node_id, np.arange(8 * 6 * 11))
    np.testing.assert_allclose(cells.points[0], [-2.0, 9.5, -3.7])
    np.testing.assert_allclose(cells.points[1], [-1.5, 9.5, -3.7])
    np.testing.assert_allclose(cells.points[8], [-2.0, 9.75, -3.7])
    np.testing.assert_allclose(cells.points[48], [-2.0, 9.5, -1.7])
    i, j, k = 2, 2, 2
    np.testing.assert_allclose(cells.points[i + 8 * j + 48 * k], MESH.origin)
    expected = [i + 8 * j + 48 * k for k in range(10) for j in range(5) for i in range(7)]
    np.testing.assert_array_equal(cells.cell_id, expected)
    np.testing.assert_array_equal(cells.connectivity[:, 0], cells.cell_id)
    assert cells.connectivity[0].tolist() == [0, 1, 9, 8, 48, 49, 57, 56]


def test_cells_are_well_formed_hexahedra_of_the_cell_size(tmp_path):
    cells = all_cells(MESH)
    path = tmp_path / "grid.vtu"
    on_nodes, on_cells = {"NodeId": cells.node_id}, {"CellId": cells.cell_id}
    write_hexahedra(path, cells.points, cells.connectivity, on_nodes, on_cells)
    volume = pyvista.read(path).compute_cell_sizes()["Volume"]
    np.testing.assert_allclose(volume, 0.25, rtol=1e-12)


def test_all_blocks_make_all_cells():
    for expected, got in zip(all_cells(MESH), block_cells(MESH, every_block()), strict=True):
        np.testing.assert_array_equal(got, expected)
        assert got.dtype.kind == expected.dtype.kind


@pytest.mark.parametrize(
    "blocks", [[(0, 0, 0)], [(4, 4, 8), (0, 0, 4)], [(0, 4, 0), (4, 0, 0)] * 2]
)
def test_blocks_make_the_cells_whose_lowest_node_is_theirs(blocks):
    every, some = all_cells(MESH), block_cells(MESH, blocks)
    index = np.stack(np.unravel_index(every.cell_id.astype(int), NODES[::-1])[::-1], axis=1)
    wanted = np.any([(index // 4 * 4 == block).all(axis=1) for block in blocks], axis=0)
    np.testing.assert_array_equal(some.cell_id, every.cell_id[wanted])
    np.testing.assert_array_equal(some.node_id, np.unique(every.connectivity[wanted]))
    np.testing.assert_array_equal(
        some.node_id[some.connectivity], every.connectivity[wanted].astype(np.uint64)
    )
    np.testing.assert_array_equal(some.points, every.points[some.node_id.astype(int)])


@pytest.mark.parametrize("blocks", [[], [(8, 0, 0)], [(-4, 0, 0)], np.zeros((0, 3), int)])
def test_blocks_outside_make_no_cells(blocks):
    cells = block_cells(MESH, blocks)
    assert len(cells.cell_id) == len(cells.node_id) == len(cells.points) == 0
    assert cells.connectivity.shape == (0, 8)


def test_a_mesh_of_many_cells_costs_only_its_blocks():
    huge = SimpleNamespace(
        cells_number=(100_000, 100_000, 100_000), cells_dimension=(1, 1, 1), origin=(0, 0, 0)
    )
    cells = block_cells(huge, [(50_000, 99_996, 40_000)])
    assert len(cells.cell_id) == 64
    assert len(cells.points) == 125
    assert cells.points.min(axis=0).tolist() == [49_998, 99_994, 39_998]
    nodes = 100_005
    assert cells.cell_id[0] == 50_000 + nodes * (99_996 + nodes * 40_000)
