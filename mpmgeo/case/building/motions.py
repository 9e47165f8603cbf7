"""Prescribed motions: velocities of particles and planes, the base."""

import numpy as np

from mpmgeo.boundaries.base_motion import BaseMotion, BaseMotionAsMPMGeomechanics
from mpmgeo.mpm.effects.base import Base


def bind_tools(case, population, velocity):
    """Return the tools of a case, None without, and each particle's tool (n,), −1 without.

    Particles of tools get their prescribed initial `velocity` (n, 3) [m/s]. Raises ValueError for
    a body that does not exist.
    """
    tool = np.full(len(velocity), -1)
    entries = case.prescribed_velocity
    if not entries:
        return None, tool
    from mpmgeo.mpm.effects.tools import Tools

    tools = Tools([entry.motion for entry in entries], [entry.side for entry in entries])
    last = int(population.body.max(initial=0))
    for number, entry in enumerate(entries):
        if entry.body is not None and entry.body > last:
            raise ValueError(
                f"prescribed_velocity, {entry.name}: there is no body {entry.body}; "
                f"bodies are numbered from 1 to {last}"
            )
        tool[entry.chooses(population.position, population.body) & (tool < 0)] = number
        rows = np.flatnonzero(tool == number)
        for axis in np.flatnonzero(tools.given[number]):
            velocity[rows, axis] = tools.before[number, axis]
    return tools, tool


def base(case, notes):
    """Return what moves the base of a case, None without."""
    earthquake = case.earthquake
    if earthquake is None or not earthquake.active:
        return None
    record = earthquake.record()
    notes += record.warnings
    is_plane = case.terrain_contact is None
    if case.compatibility is not None:
        remaps = case.stress_scheme_update == "MUSL"
        return Base(BaseMotionAsMPMGeomechanics(record, remaps, is_plane))
    if is_plane and case.mesh.boundary_conditions.plane_Z0 is not None:
        notes.append("mesh.boundary_conditions.plane_Z0 gives way to the moving base")
    return Base(BaseMotion(record, is_plane))
