"""Pore pressures of a file at the particles."""

import numpy as np

from mpmgeo.positions import mean_edge, shown


def bind_pressure(case, position, notes):
    """Return the pore pressures (n,) [Pa] of particles at `position` (n, 3) [m], None without.

    Points and particles that find no partner are counted in `notes`. A water table makes room for
    the pressures of `initial_stress.py`.
    """
    coupling = case.hydro_mechanical_coupling
    if coupling is None or not coupling.enabled:
        start = case.initial_stress
        floods = start is not None and start.water_table is not None and case.n_phases == 1
        return np.zeros(len(position)) if floods else None
    cell = mean_edge(case.mesh.cells_dimension)
    found = coupling.pressures(position, cell, last=case.compatibility is not None)
    idle = np.flatnonzero(~found.matched)
    if len(idle):
        where = shown(coupling.points.position[idle[0]], coupling.zero)
        notes.append(
            f"hydro_mechanical_coupling: {len(idle)} of {len(found.matched)} points are near no "
            f"particle, the first of them entry {idle[0] + 1} at {where}"
        )
    dry = np.flatnonzero(~found.known)
    if len(dry):
        notes.append(
            f"hydro_mechanical_coupling: {len(dry)} of {len(position)} particles are near no point "
            f"and keep the pore pressure 0, the first of them row {dry[0]} at "
            f"{shown(position[dry[0]], coupling.zero)}"
        )
    return found.pressure
