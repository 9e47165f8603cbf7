"""The time step of a case."""

from dataclasses import replace
from math import inf

import numpy as np

from mpmgeo.materials import saturation
from mpmgeo.mpm import stability
from mpmgeo.mpm.schemes import is_filtered, longest
from mpmgeo.positions import mean_edge
from mpmgeo.shapes.shape import in_space

MARGIN = 0.9
"""Share of the stable time step that is proposed, and up to which steps follow speeds."""


def critical_time_step(case, velocity):
    """Return the time [s] in which a wave crosses a cell, particles moving at `velocity` (n, 3).

    The shortest of the materials in use, in the smallest cell size; for MPM-Geomechanics the mean
    cell size over the largest wave speed of all materials. With two phases the pore fluid counts.
    """
    cell = case.mesh.cells_dimension
    if case.compatibility is not None:
        return mean_edge(cell) / max(law.sound_speed() for law in case.materials)
    used = {number for body in case.body if body.active for number in body.materials}
    fastest = _fastest(velocity)
    laws = [inertial(law, case) for law in case.materials if law.id in used]
    if case.n_phases == 1:
        return min((law.critical_time_step(min(cell), fastest) for law in laws), default=inf)
    steps = (saturation.critical_time_step(law, min(cell), fastest) for law in laws)
    return min(steps, default=inf)


def _fastest(velocity):
    """Return the largest speed [m/s] of particles moving at `velocity` (n, 3)."""
    return np.sqrt((velocity**2).sum(axis=1).max(initial=0.0))


def stable_time_step(case, solver, velocity):
    """Return the longest time step [s] that a solver bears, particles moving at `velocity` (n, 3).

    It knows scheme, shape, sizes of particles, edges of cells, materials and phases; 0 if there is
    no such step, infinite without particles. It shrinks with speed as the critical one does.
    """
    speed = _fastest(velocity)
    steps = (step * wave / (wave + speed) for step, wave in stable_steps_at_rest(case, solver))
    return min(steps, default=inf)


def stable_steps_at_rest(case, solver):
    """Return for each set of particles the longest step [s] at rest, and its wave speed [m/s]."""
    filtered, shape = is_filtered(solver.scheme), in_space(solver.shape)
    averaged = filtered and not case.transfer.is_affine
    found = []
    for s in solver.sets:
        law, half = law_of(case, solver, s), np.atleast_2d(s.half).min(axis=0)
        two = case.n_phases == 2
        wave = saturation.wave_speed(law) if two else law.sound_speed()
        if not stability.has_stable_step(shape, filtered):
            found.append((0.0, wave))
            continue
        slopes = stability.slopes(shape, averaged, half, case.mesh.cells_dimension)
        step = (_of_two_phases if two else _of_one_phase)(case, law, slopes, longest(solver.scheme))
        found.append((step, wave))
    return found


def law_of(case, solver, s):
    """Return the law of the particles of a set, with the inertia that they have in a case."""
    number = solver.population.material[s.row[0]]
    return inertial(next(law for law in case.materials if law.id == number), case)


def inertial(law, case):
    """Return a law with the density that stands for its inertia."""
    return replace(law, density=case.density_scaling * law.density)


def _of_one_phase(case, law, slopes, n):
    stiffness, viscosity = law.resistance(slopes, case.volumetric_locking == "cells")
    return stability.stable_time_step(stiffness / law.density, viscosity / law.density, n)


def _of_two_phases(case, law, slopes, n):
    """Return the step [s] with the drag of a shorter one, the one without drag."""
    decay = law.resistance(slopes)[1] / saturation.densities(law)[0]
    rate, step = saturation.drag_rate(law, case.conductivity_gravity), 0.0
    shares = case.pore_pressure_smoothing, case.volumetric_locking == "cells"
    for _ in range(2):
        ω2 = saturation.frequency(law, slopes, *shares, rate * step)
        step = stability.stable_time_step(ω2, decay, n)
    return step


def time_step(case, velocity):
    """Return the time step of a case [s]: as given, or a share of the critical one."""
    if case.time_step and not case.is_adaptive:
        return case.time_step
    return case.critical_time_step_multiplier * critical_time_step(case, velocity)


def on_scaling(case, velocity):
    """Yield what to tell of the inertia of a case, if it is scaled."""
    if case.density_scaling != 1.0:
        real = replace(case, density_scaling=1.0)
        longer = critical_time_step(case, velocity) / critical_time_step(real, velocity)
        yield (
            f"density_scaling: steps may be {longer:.3g} times as long as with the real inertia; "
            "only the state of rest has a meaning, times and velocities on the way have none"
        )
