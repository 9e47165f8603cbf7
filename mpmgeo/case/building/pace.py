"""Steps that follow from the speeds: what limits them in a case."""

from functools import partial
from math import inf

from mpmgeo.case.building.time_step import MARGIN, law_of, stable_steps_at_rest
from mpmgeo.materials import saturation


def pace(case, instants):
    """Return what chooses the steps, None if they are all the same."""
    if not case.is_adaptive:
        return None
    from mpmgeo.mpm.effects.pace import Pace

    return Pace(partial(_bind, case), instants)


def _bind(case, solver):
    """Return for each set of particles its longest step and its stiffening, see `Pace`."""
    stable, bound = stable_steps_at_rest(case, solver), []
    for s, (step, wave) in zip(solver.sets, stable, strict=True):
        law = law_of(case, solver, s)
        density = float(s.m[0] / s.V[0])
        bound.append((partial(_limit, case, law, step, wave), partial(_stiffening, law, density)))
    return bound


def _limit(case, law, stable, wave, speed, r):
    """Return the longest step [s] at a speed [m/s], of a law stiffer than at the start by r."""
    cell, faster = min(case.mesh.cells_dimension), r**0.5
    critical = saturation.critical_time_step if case.n_phases == 2 else type(law).critical_time_step
    share = case.critical_time_step_multiplier * critical(law, cell, speed / faster) / faster
    return min(share, MARGIN * stable * wave / (wave * faster + speed) if stable else inf)


def _stiffening(law, density, s):
    """Return by how much the stiffest of the particles of a set is stiffer than at the start."""
    at = slice(0, s.active)
    return law.stiffening(density * s.V[at] / s.m[at], None if s.F is None else s.F[at])
