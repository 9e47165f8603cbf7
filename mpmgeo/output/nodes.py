"""The nodes of the grid as scripts see them."""

from typing import NamedTuple

import numpy as np

from mpmgeo.naming import GHOSTS


class Nodes(NamedTuple):
    """Nodes with mass: index with two ghost layers, position [m], mass [kg], velocity [m/s]."""

    index: np.ndarray
    position: np.ndarray
    mass: np.ndarray
    velocity: np.ndarray


def nodes_of(solver, mesh):
    """Return the nodes that carried mass in the last step, in a mesh of cells and an origin."""
    grid = solver.grid
    mass, velocity = grid.solid.at_nodes("mass"), grid.solid.at_nodes("velocity")
    index, used = grid.indices().reshape(-1, 3), mass > solver.cutoff
    position = index[used] * np.array(mesh.cells_dimension) + mesh.origin
    return Nodes(index[used] + GHOSTS, position, mass[used], velocity[used])
