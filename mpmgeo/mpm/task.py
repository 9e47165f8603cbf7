"""Work at the nodes of the grid, with what it needs."""

from typing import NamedTuple

from mpmgeo.mpm.core.nodes import Momentum, Velocity


class Task(NamedTuple):
    """A work, the tiles that are summed for it, scratch memory for the sums, the work's arrays."""

    work: NamedTuple
    tiles: tuple
    scratch: object
    arrays: tuple


class OnePhase:
    """The tasks at the nodes where the particles are a solid or a fluid alone."""

    def momentum(self, solver, h):
        """Return the task that integrates the momentum over h."""
        grid, (driven, arrays) = solver.grid, solver.driven
        start, _, pull, drives = solver.motion
        early, damping, cutoff = solver.early_damping, solver.damping, solver.cutoff
        planes = solver.planes
        work = Momentum(planes, start, pull, drives, early, damping, driven, h, cutoff)
        return Task(work, (grid.tiles,), grid.scratch, (grid.nodes, arrays))

    def velocity(self, solver, after):
        """Return the task that makes velocities of momenta, `after` the step or before it."""
        grid, (driven, arrays) = solver.grid, solver.driven
        before, behind, _, drives = solver.motion
        motion = behind if after else before
        work = Velocity(solver.planes, motion, drives, driven, after)
        return Task(work, (grid.tiles,), grid.scratch, (grid.nodes, arrays))
