"""The particles of all bodies of a case, in row order."""

import numpy as np

from mpmgeo.positions import shown
from mpmgeo.region import within
from mpmgeo.state.particles import Population


def populate(case, notes):
    """Return the population of a case, its velocities (n, 3) [m/s] and its laws (n,).

    The case is in coordinates of the mesh; the laws are positions in `case.materials`. Notes on the
    bodies are added to `notes`. Raises ValueError for a file or geometry that cannot be used.
    """
    cell = np.array(case.mesh.cells_dimension)
    made = [(body, cloud) for body in case.body if body.active for cloud in body.clouds(cell)]
    bodies, clouds = zip(*made, strict=True)
    for number, cloud in enumerate(clouds, 1):
        notes += [f"body {number}: {note}" for note in cloud.notes]
    counts = [len(cloud.position) for cloud in clouds]
    listed = np.repeat([body.is_listed for body in bodies], counts)
    material = [np.broadcast_to(cloud.material, len(cloud.position)) for cloud in clouds]
    position = np.concatenate([cloud.position for cloud in clouds])
    _refuse_outside(case.mesh, position)
    loads = case.acting("particle_force")
    force = sum(load.particle_force(position) for load in loads) if loads else None
    population = Population(
        position=position,
        size=np.concatenate([cloud.size for cloud in clouds]),
        body=np.repeat(np.arange(1, len(bodies) + 1, dtype=np.uint32), counts),
        material=np.concatenate(material).astype(np.int64),
        force=force,
        id=_creation(listed),
        zero=case.mesh.zero,
    )
    velocity = np.repeat([body.initial_velocity for body in bodies], counts, axis=0)
    return population, velocity, _laws(case.materials, population.material, listed)


def _refuse_outside(mesh, position):
    """Raise ValueError if there are particles and none of them lies in the mesh."""
    if len(position) and not within(mesh.origin, mesh.upper, position, mesh.zero).any():
        low, high, upper = position.min(axis=0), position.max(axis=0), mesh.upper
        raise ValueError(
            f"body: none of the {len(position)} particles lies in the mesh; they reach from "
            f"{shown(low, mesh.zero)} to {shown(high, mesh.zero)}, the mesh from "
            f"{shown(mesh.origin, mesh.zero)} to {shown(upper, mesh.zero)}"
        )


def _creation(listed):
    """Return the numbers (n,) of the particles by creation: listed ones come before all others."""
    id = np.empty(len(listed), np.uint64)
    id[np.argsort(~listed, kind="stable")] = np.arange(len(listed))
    return id


def _laws(laws, material, listed):
    """Return the position in `laws` of each particle's law.

    Where several have the same id the first counts, for listed particles the last, as in
    MPM-Geomechanics.
    """
    last = {law.id: index for index, law in enumerate(laws)}
    first = {law.id: index for index, law in reversed(list(enumerate(laws)))}
    result = np.empty(len(material), np.int64)
    for id in np.unique(material):
        rows = material == id
        result[rows] = np.where(listed[rows], last[id], first[id])
    return result
