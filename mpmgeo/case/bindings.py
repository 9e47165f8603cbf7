"""What loads bind to particles before a run: prescribed velocities, pore pressures of a file."""

import numpy as np

from mpmgeo.mpm.tools import Tools


def bind_tools(case, population, velocity):
    """Return the tools of a case, None without, and each particle's tool (n,), −1 without.

    Particles of tools get their prescribed initial `velocity` (n, 3) [m/s]. Raises ValueError for
    a body that does not exist.
    """
    tool = np.full(len(velocity), -1)
    entries = case.prescribed_velocity
    if not entries:
        return None, tool
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


def bind_pressure(case, position, notes):
    """Return the pore pressures (n,) [Pa] of particles at `position` (n, 3) [m], None without.

    Points and particles that find no partner are counted in `notes`.
    """
    coupling = case.hydro_mechanical_coupling
    if coupling is None or not coupling.enabled:
        return None
    cell = sum(case.mesh.cells_dimension) / 3
    found = coupling.pressures(position, cell, last=case.compatibility is not None)
    idle = np.flatnonzero(~found.matched)
    if len(idle):
        where = _shown(coupling.points.position[idle[0]])
        notes.append(
            f"hydro_mechanical_coupling: {len(idle)} of {len(found.matched)} points are near no "
            f"particle, the first of them entry {idle[0] + 1} at {where}"
        )
    dry = np.flatnonzero(~found.known)
    if len(dry):
        notes.append(
            f"hydro_mechanical_coupling: {len(dry)} of {len(position)} particles are near no point "
            f"and keep the pore pressure 0, the first of them row {dry[0]} at "
            f"{_shown(position[dry[0]])}"
        )
    return found.pressure


def _shown(position):
    return f"({', '.join(f'{x:g}' for x in position)}) m"
