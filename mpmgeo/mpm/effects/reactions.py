"""The forces of the boundary planes and of prescribed velocities on the material.

    F = Σ m a − f,   summed over the nodes that a plane or prescribed velocity holds

m a: what the node's momentum changes by in a step, f: internal, external and damping forces there.
"""

from typing import NamedTuple

import numpy as np

from mpmgeo.boundaries.planes import BASE, FIXED, FREE
from mpmgeo.effect import Effect
from mpmgeo.mpm.core.driven import holds
from mpmgeo.mpm.core.loops import at_node, is_needless
from mpmgeo.mpm.core.nodes import Momentum, integrated
from mpmgeo.naming import PLANES
from mpmgeo.numerics.dispatch import generic
from mpmgeo.numerics.jit import inlined
from mpmgeo.numerics.simd import LANES, lane, load
from mpmgeo.state.checked import array_from


@inlined
def holder(planes, mesh, i, j, k, axis):
    """Return the number of the plane that holds a node along an axis, −1 without.

    At edges the plane normal to the axis counts, else the first one that is fixed; a moving base
    counts before all others.
    """
    if planes.z0 == BASE and k <= 0 and not planes.upper_wins:
        return 2
    index, last = (i, j, k), (mesh.nx, mesh.ny, mesh.nz)
    lower, upper = (planes.x0, planes.y0, planes.z0), (planes.xn, planes.yn, planes.zn)
    if index[axis] <= 0 and lower[axis] != FREE:
        return axis
    if index[axis] >= last[axis] and upper[axis] != FREE:
        return axis + 3
    for a in range(3):
        if index[a] <= 0 and lower[a] >= FIXED:
            return a
    for a in range(3):
        if index[a] >= last[a] and upper[a] >= FIXED:
            return a + 3
    return -1


@inlined
def add_force(f, axis, number, out, b):
    """Add a force along an axis to those of plane or prescribed velocity `number`, −1 for none."""
    if number >= 0:
        out[b, number, axis] += f


@generic
def at_forces(work, node, a, out, b):
    """Add the outer forces that a work would find at a node to those of its block b in `out`."""


@at_forces.register(Momentum)
def forces(work, node, a, out, b):
    nodes, driven = a
    r = load(node.sums, node.at)
    if lane(r, 0) > 0.0:
        u = load(nodes, node.number * LANES)
        new = integrated(work, node, driven, r, u)
        _count(work, node, driven, 0, new[6], out, b)
        _count(work, node, driven, 1, new[7], out, b)
        _count(work, node, driven, 2, new[8], out, b)


@inlined
def _count(work, node, driven, axis, f, out, b):
    number = holder(work.planes, node.mesh, node.i, node.j, node.k, axis)
    t = holds(work.driven, driven, node.number, axis)
    add_force(f, axis, 6 + t if t >= 0 else number, out, b)


class Forces(NamedTuple):
    """Sum the outer forces that another work would find, for each block by itself.

    Arrays: those of the other work, and the sums (blocks, 6 + prescribed velocities, 3), zero.
    """

    work: object


@at_node.register(Forces)
def at_forces_node(work, node, a):
    others, out = a
    at_forces(work.work, node, others, out, node.block)


@is_needless.register(Forces)
def nothing_holds(work, a, b, bounded):
    return not bounded and not has_driven(work.work.driven, a[0][-1], b, len(a[1]))


@inlined
def has_driven(model, driven, b, blocks):
    """Tell whether nodes of block b, of so many blocks, have a prescribed velocity."""
    if model is None:
        return False
    count = len(driven[0]) // blocks
    return driven[0][b * count : (b + 1) * count].max() >= 0


class Reactions(Effect):
    """Measures the forces of planes and of `tools` prescribed velocities at intervals of steps.

    `solver.reactions` (6 + tools, 3) [N] are those of the last such step, None before.
    """

    name = "reactions"
    does_work = False

    def __init__(self, intervals, tools=0):
        self.intervals = intervals
        self.tools = tools

    def join(self, solver):
        """Know where the forces go."""
        self.solver = solver

    def before_nodes(self, solver, task):
        """Sum the forces if this step is one of those wanted."""
        if not any((solver.steps + 1) % every == 0 for every in self.intervals):
            return
        forces = np.zeros((len(solver.grid.active), len(PLANES) + self.tools, 3))
        solver.over_nodes(task._replace(work=Forces(task.work), arrays=(task.arrays, forces)))
        solver.reactions = forces.sum(axis=0)
        solver.clock.lap(self.name)

    def held(self):
        """Return the forces, once there are any."""
        forces = self.solver.reactions
        return {} if forces is None else {"forces": forces}

    def take(self, state):
        """Go on with what `held` once returned."""
        shape = (len(PLANES) + self.tools, 3)
        given = "forces" in state
        self.solver.reactions = array_from(state, "forces", np.float64, shape) if given else None
