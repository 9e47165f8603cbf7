"""The time step of a case."""

from math import inf

import numpy as np

from mpmgeo.materials import saturation
from mpmgeo.positions import mean_edge


def critical_time_step(case, velocity):
    """Return the time [s] in which a wave crosses a cell, particles moving at `velocity` (n, 3).

    The shortest of the materials in use, in the smallest cell size; for MPM-Geomechanics the mean
    cell size over the largest wave speed of all materials. With two phases the pore fluid counts.
    """
    cell = case.mesh.cells_dimension
    if case.compatibility is not None:
        return mean_edge(cell) / max(law.sound_speed() for law in case.materials)
    used = {number for body in case.body if body.active for number in body.materials}
    fastest = np.sqrt((velocity**2).sum(axis=1).max(initial=0.0))
    laws = [law for law in case.materials if law.id in used]
    if case.n_phases == 1:
        return min((law.critical_time_step(min(cell), fastest) for law in laws), default=inf)
    steps = (saturation.critical_time_step(law, min(cell), fastest) for law in laws)
    return min(steps, default=inf)


def time_step(case, velocity):
    """Return the time step of a case [s]: as given, or a share of the critical one."""
    if case.time_step:
        return case.time_step
    return case.critical_time_step_multiplier * critical_time_step(case, velocity)
