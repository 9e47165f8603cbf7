"""Where nodes lie in blocks and tiles, with other widths along the axes, too; fields by name."""

import numpy as np
import pytest

from mpmgeo.numerics.simd import LANES
from mpmgeo.state.field import Field, Lanes
from mpmgeo.state.grid import Grid, Mesh, keys_of
from mpmgeo.state.layout import (
    CUBE,
    NODES,
    SIDE,
    axes,
    block_of,
    blocks_along,
    edge,
    inner,
    nodes,
    place,
    side,
    volume,
)
from mpmgeo.state.layout import node_under as under


@pytest.mark.parametrize("rows", [CUBE, (6, 1, 6), (1, 5, 7), (9, 6, 1)])
def test_nodes_of_a_block_are_counted_along_z_first(rows):
    count, sides = nodes(rows), tuple(map(side, rows))
    index = np.array([axes(rows, n) for n in range(count)])
    assert [inner(rows, *i) for i in index.tolist()] == list(range(count))
    assert (index == np.stack(np.unravel_index(np.arange(count), sides), -1)).all()


def test_along_an_axis_without_changes_there_is_one_node():
    assert [edge(width) for width in (1, 2, 3, 9)] == [1, 5, 6, 12]
    assert [side(row) for row in (1, 5, 6, 12)] == [1, SIDE, SIDE, SIDE]
    assert nodes(CUBE) == NODES and nodes((6, 1, 6)) == SIDE**2


@pytest.mark.parametrize("rows", [(6, 6, 6), (5, 7, 13), (4, 4, 8)])
def test_places_in_a_tile_are_counted_along_z_first(rows):
    found = [place(rows, i, j, k) for i, j, k in np.ndindex(*rows)]
    assert found == list(range(volume(rows)))


@pytest.mark.parametrize("row, count", [(1, 1), (4, 1), (5, 2), (6, 2), (8, 2), (9, 3), (13, 4)])
def test_how_many_blocks_a_row_of_nodes_reaches_over(row, count):
    assert blocks_along(row) == count


@pytest.mark.parametrize("rows", [(6, 6, 6), (5, 7, 13), (6, 1, 6)])
def test_every_block_under_a_tile_has_a_column(rows):
    count = tuple(map(blocks_along, rows))
    found = [block_of(rows, *steps) for steps in np.ndindex(*count)]
    assert found == list(range(np.prod(count)))


@pytest.mark.parametrize("widths", [(2, 2, 2), (3, 3, 3), (6, 6, 6), (3, 1, 3), (1, 4, 4)])
def test_nodes_under_a_tile_are_those_of_the_grid(widths):
    grid = Grid(Mesh.of((1.0, 1.0, 1.0), (40, 40, 40)), widths)
    corners = np.array([[0, 1, 2], [1, 1, 2], [3, 0, 0]]) * (np.array(widths) > 1)
    grid.cover(np.unique(keys_of(corners)))
    index = grid.indices().reshape(-1, 3)
    for b, corner in enumerate(grid.corner):
        for i in np.ndindex(*grid.rows):
            assert (index[under(grid.above, b, grid.rows, *i)] == corner * SIDE + i).all()


def test_a_field_knows_its_lanes():
    field = Field(Lanes(tile={"mass": (0, 1)}, node={"velocity": (0, 3), "mass": (6, 1)}))
    field.fit(2, (6, 6, 6), 3)
    records = field.records()
    assert records.shape == (3, NODES, LANES)
    records[:] = np.arange(LANES)
    assert (field.at_nodes("velocity") == [0, 1, 2]).all()
    assert field.at_nodes("velocity").shape == (3 * NODES, 3)
    assert (field.at_nodes("mass") == 6).all()
    field.at_nodes("mass")[5] = 9.0
    assert records[0, 5, 6] == 9.0
    field.in_tiles("mass")[7] = 4.0
    assert field.tiles[7 * LANES] == 4.0
