"""The fields a case may ask for, in the order in which files hold them, and what they hold."""

import numpy as np

PARTICLE_FIELDS = {
    "id": "particle number, in order of creation from 0",
    "material": "material id",
    "Su": "undrained shear strength [Pa]",
    "active": "1 while the particle takes part, 0 after it left the mesh",
    "pressure": "pore or fluid pressure [Pa]",
    "pore_pressure": "pore pressure of the one-way coupling [Pa]",
    "plastic_strain": "effective plastic strain [-]",
    "external_force": "gravity and box loads [N]",
    "displacement": "current minus initial position [m]",
    "distance_levelset": "signed distance to the terrain [m]",
    "particle_contact_force": "contact force [N]",
    "particle_contact_force_tangential": "tangential contact force [N]",
    "particle_contact_force_normal": "normal contact force [N]",
    "particle_contact_flag": "1 while in contact with the terrain",
    "velocity": "velocity [m/s]",
    "stress": "effective stress, six components [Pa]",
    "body": "body number, from 1",
}

GRID_FIELDS = {
    "id": "node number, x fastest, with two ghost layers",
    "active": "1 where the node carries mass",
    "mass": "nodal mass [kg]",
    "velocity": "nodal velocity [m/s], zero on inactive nodes",
    "distance_levelset": "signed distance to the terrain [m]",
    "density_levelset": "share of the nodal volume that particles fill [-]",
    "volume": "nodal volume [m³]",
}

_PARTICLE_NAMES = {
    "id": "Particle Id",
    "material": "Material Id",
    "active": "Particle Active",
    "pressure": "Pressure",
    "pore_pressure": "Pore Pressure",
    "plastic_strain": "Effective Plastic Strain",
    "external_force": "External Force",
    "displacement": "Displacement",
    "distance_levelset": "Distance-levelset",
    "velocity": "Velocity",
    "body": "Body Id",
}
_STRESS_NAMES = tuple(f"Stress_{axes}" for axes in ("XX", "YY", "ZZ", "XY", "XZ", "YZ"))
_STRESS_ORDER = (0, 1, 2, 3, 5, 4)  # files list xz before yz
_GRID_NAMES = {
    "id": "NodeId",
    "active": "Active",
    "mass": "Mass",
    "velocity": "Velocity",
    "distance_levelset": "distance level set",
    "density_levelset": "density levelset",
    "volume": "Volume",
}


def particle_field(solver, key):
    """Return a field of all particles in row order: a key of PARTICLE_FIELDS, or position, mass,
    volume. Shape (n,), (n, 3), or (n, 6) for stress (xx yy zz xy yz xz); SI units.

    Raises KeyError for an unknown key.
    """
    population = solver.population
    count = len(population.position)
    of_set = {"position": "x", "velocity": "v", "mass": "m", "volume": "V", "stress": "stress"}
    if key in of_set:
        return _by_row(solver, of_set[key])
    if key == "displacement":
        return _by_row(solver, "x") - population.position
    if key == "external_force":
        weight = _by_row(solver, "m")[:, None] * np.asarray(solver.gravity)
        return weight if population.force is None else weight + population.force
    if key == "id":
        return np.arange(count, dtype=np.uint64)
    if key == "material":
        return population.material.astype(np.uint32)
    if key == "body":
        return population.body.copy()
    if key == "active":
        active = np.zeros(count, np.uint8)
        for s in solver.sets:
            active[s.row[: s.active]] = 1
        return active
    if key == "particle_contact_flag":
        return np.zeros(count, np.uint8)
    if key in PARTICLE_FIELDS:
        return np.zeros((count, 3) if key.startswith("particle_contact_force") else count)
    raise KeyError(key)


def _by_row(solver, name):
    arrays = [getattr(s, name) for s in solver.sets]
    shape = {"x": (3,), "v": (3,), "stress": (6,)}.get(name, ())
    field = np.zeros((len(solver.population.position), *shape))
    for s, array in zip(solver.sets, arrays, strict=True):
        field[s.row] = array
    return field


def particle_arrays(solver, keys):
    """Return the arrays of a particle file for some keys of PARTICLE_FIELDS, by their names."""
    arrays = {}
    for key in keys:
        field = particle_field(solver, key)
        if key == "stress":
            for name, component in zip(_STRESS_NAMES, _STRESS_ORDER, strict=True):
                arrays[name] = field[:, component]
        else:
            arrays[_PARTICLE_NAMES.get(key, key)] = field
    return arrays


def grid_arrays(solver, node_id, keys):
    """Return the arrays of a grid file at the nodes `node_id` (n,), ascending, by their names."""
    grid, mesh = solver.grid, solver.grid.mesh
    nodes = np.array([mesh.nx, mesh.ny, mesh.nz]) + 5
    mass, velocity = np.zeros(len(node_id)), np.zeros((len(node_id), 3))
    if {"active", "mass", "velocity"} & set(keys):
        index, records = grid.indices().reshape(-1, 3) + 2, grid.records().reshape(-1, 8)
        used = (
            (records[:, 6] > solver.cutoff) & (index >= 0).all(axis=1) & (index < nodes).all(axis=1)
        )
        index, records = index[used], records[used]
        number = index @ np.array([1, nodes[0], nodes[0] * nodes[1]])
        at = np.searchsorted(node_id, number.astype(np.uint64))
        mass[at], velocity[at] = records[:, 6], records[:, :3]
    values = {
        "id": lambda: node_id.astype(np.uint64),
        "active": lambda: (mass > 0).astype(np.uint8),
        "mass": lambda: mass,
        "velocity": lambda: velocity,
        "volume": lambda: _volume(mesh, nodes, node_id),
    }
    absent = lambda: np.zeros(len(node_id))  # noqa: E731
    return {_GRID_NAMES[key]: values.get(key, absent)() for key in keys}


def _volume(mesh, nodes, node_id):
    """Return the nodal volumes: a cell's, halved on every outer face of the ghosted mesh."""
    number = node_id.astype(np.int64)
    volume = np.full(len(number), mesh.hx * mesh.hy * mesh.hz)
    for count in nodes:
        number, index = number // count, number % count
        volume[(index == 0) | (index == count - 1)] *= 0.5
    return volume
