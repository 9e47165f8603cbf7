"""What the fields of the grid hold, and under which names files hold them."""

from functools import cache

import numpy as np

from mpmgeo.naming import GHOSTS
from mpmgeo.positions import mean_edge

_NAMES = {
    "id": "NodeId",
    "active": "Active",
    "mass": "Mass",
    "velocity": "Velocity",
    "distance_levelset": "distance level set",
    "density_levelset": "density levelset",
    "volume": "Volume",
}


def grid_arrays(solver, node_id, keys):
    """Return the arrays of a grid file at the nodes `node_id` (n,), ascending, by their names."""
    grid, mesh = solver.grid, solver.grid.mesh
    nodes = np.array([mesh.nx, mesh.ny, mesh.nz]) + 2 * GHOSTS + 1
    mass, velocity = np.zeros(len(node_id)), np.zeros((len(node_id), 3))
    if {"active", "mass", "velocity"} & set(keys):
        index, known = grid.indices().reshape(-1, 3) + GHOSTS, grid.solid.at_nodes("mass")
        inside = (index >= 0).all(axis=1) & (index < nodes).all(axis=1)
        used = inside & (known > solver.cutoff)
        index = index[used]
        number = index @ np.array([1, nodes[0], nodes[0] * nodes[1]])
        at = np.searchsorted(node_id, number.astype(np.uint64))
        mass[at], velocity[at] = known[used], grid.solid.at_nodes("velocity")[used]
    ground = solver.ground
    values = {
        "id": lambda: node_id.astype(np.uint64),
        "active": lambda: (mass > 0).astype(np.uint8),
        "mass": lambda: mass,
        "velocity": lambda: velocity,
        "volume": lambda: _volume(mesh, nodes, node_id),
        "distance_levelset": lambda: np.zeros(len(node_id)),
        "density_levelset": lambda: np.zeros(len(node_id)),
    }
    if ground is not None:
        distance = cache(lambda: ground.distance(_position(mesh, nodes, node_id)))
        values["distance_levelset"] = distance
        values["density_levelset"] = lambda: _density(solver, nodes, node_id)
    arrays = {_NAMES[key]: values[key]() for key in keys}
    if ground is not None and solver.effect("base") is not None:
        near = 0.25 * mean_edge((mesh.hx, mesh.hy, mesh.hz))
        arrays["Seismic Node"] = (np.abs(distance()) < near).astype(np.uint8)
    return arrays


def _position(mesh, nodes, node_id):
    """Return the positions (n, 3) [m] of nodes in coordinates of the mesh."""
    i, j, k = _index(nodes, node_id)
    return (np.stack([i, j, k], axis=-1) - GHOSTS) * [mesh.hx, mesh.hy, mesh.hz]


def _index(nodes, node_id):
    number = node_id.astype(np.int64)
    return number % nodes[0], number // nodes[0] % nodes[1], number // (nodes[0] * nodes[1])


def _density(solver, nodes, node_id):
    """Return the share of the nodes' volume that particles fill."""
    index, density = solver.ground.density(solver)
    index = index + GHOSTS
    inside = (index >= 0).all(axis=1) & (index < nodes).all(axis=1) & (density > 0)
    number = index[inside] @ np.array([1, nodes[0], nodes[0] * nodes[1]])
    values = np.zeros(len(node_id))
    values[np.searchsorted(node_id, number.astype(np.uint64))] = density[inside]
    return values


def _volume(mesh, nodes, node_id):
    """Return the nodal volumes: a cell's, halved on every outer face of the ghosted mesh."""
    number = node_id.astype(np.int64)
    volume = np.full(len(number), mesh.hx * mesh.hy * mesh.hz)
    for count in nodes:
        number, index = number // count, number % count
        volume[(index == 0) | (index == count - 1)] *= 0.5
    return volume
