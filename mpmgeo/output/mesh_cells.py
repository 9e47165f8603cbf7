"""The cells of the mesh as points and hexahedra."""

from math import prod
from typing import NamedTuple

import numpy as np

from mpmgeo.naming import GHOSTS
from mpmgeo.state.grid import SIDE

CORNERS = np.array(
    [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]]
)


class MeshCells(NamedTuple):
    """Cells of a mesh and the nodes they join, both in ascending order of their numbers.

    points (n, 3): nodes [m]; connectivity (m, 8): rows of `points` in VTK order; node_id (n,) and
    cell_id (m,): numbers in the mesh with its two ghost layers, x fastest; a cell has the number
    of its lowest node.
    """

    points: np.ndarray
    connectivity: np.ndarray
    node_id: np.ndarray
    cell_id: np.ndarray


def all_cells(mesh) -> MeshCells:
    """Return all cells of a mesh, ghost layers included.

    The mesh holds cells_number, cells_dimension [m] and origin [m], three numbers each.
    """
    nodes = _nodes(mesh)
    k, j, i = np.ogrid[tuple(slice(n - 1) for n in reversed(nodes))]
    lowest = (i + nodes[0] * (j + nodes[1] * k)).ravel()
    node_id = np.arange(prod(nodes))
    # The connectivity is by far the largest array: half as wide whenever that suffices.
    small = len(node_id) <= np.iinfo(np.int32).max
    connectivity = _corner_numbers(nodes, lowest.astype(np.int32) if small else lowest)
    return _joined(mesh, lowest, node_id, connectivity)


def block_cells(mesh, blocks) -> MeshCells:
    """Return the cells of a mesh whose lowest node lies in one of some blocks of 4³ nodes.

    `blocks` (b, 3) are the indices of the blocks' lowest nodes, counted with the ghost layers;
    what reaches beyond the mesh is left out.
    """
    nodes = _nodes(mesh)
    within = np.stack(np.meshgrid(*3 * [np.arange(SIDE)]), axis=-1).reshape(-1, 3)
    index = (np.asarray(blocks, dtype=np.int64).reshape(-1, 1, 3) + within).reshape(-1, 3)
    i, j, k = index[((index >= 0) & (index < nodes - 1)).all(axis=1)].T
    lowest = np.unique(i + nodes[0] * (j + nodes[1] * k))
    node_id, rows = np.unique(_corner_numbers(nodes, lowest), return_inverse=True)
    return _joined(mesh, lowest, node_id, rows.reshape(-1, 8))


def _nodes(mesh):
    return np.array(mesh.cells_number, dtype=np.int64) + 2 * GHOSTS + 1


def _corner_numbers(nodes, lowest):
    corners = CORNERS @ [1, nodes[0], nodes[0] * nodes[1]]
    return lowest[:, None] + corners.astype(lowest.dtype)


def _joined(mesh, lowest, node_id, connectivity):
    k, j, i = np.unravel_index(node_id, _nodes(mesh)[::-1])
    index = np.stack([i, j, k], axis=1)
    points = (index - GHOSTS) * np.array(mesh.cells_dimension) + mesh.origin
    return MeshCells(points, connectivity, node_id.astype(np.uint64), lowest.astype(np.uint64))
