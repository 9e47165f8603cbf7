"""The forces of the boundary planes and of the tools on the material.

    F = Σ m a − f,   summed over the nodes that a plane or tool holds

m a: what the node's momentum changes by in a step, f: internal, external and damping forces there.
"""

from numba import prange

from mpmgeo.boundaries.planes import BASE, FIXED, FREE
from mpmgeo.mpm.grid_update import integrated, is_bounded, sum_tiles
from mpmgeo.numerics.jit import blockwise, inlined
from mpmgeo.numerics.simd import LANES, lane, load
from mpmgeo.shapes.shape import width
from mpmgeo.state.grid import NODES, SIDE


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
def _count(f, axis, holder, out, b):
    if holder >= 0:
        out[b, holder, axis] += f


@blockwise
def add_forces(
    shape, mesh, planes, base, pull, drives, local, delayed, owner, given, before, after, h, cutoff,
    chunk, corner, below, tiles, scratch, nodes, out,
):  # fmt: skip
    """Sum the forces of the six planes and then of the tools, for each block by itself, into `out`.

    The arguments are those of `update_momentum`, before which this is called; out (blocks, 6 +
    tools, 3) must be zero.
    """
    row = SIDE + width(shape) - 1
    reach = 1 + (width(shape) + SIDE - 2) // SIDE
    for c in prange(len(chunk) - 1):
        first = c * row * row * row * LANES
        for b in range(chunk[c], chunk[c + 1]):
            I, J, K = corner[b, 0], corner[b, 1], corner[b, 2]
            bounded = is_bounded(mesh, I, J, K)
            if owner is None:
                if not bounded:
                    continue
            elif not bounded and owner[b * NODES : (b + 1) * NODES].max() < 0:
                continue
            sum_tiles(tiles, below, b, row, reach, scratch, first)
            for n in range(NODES):
                r = load(scratch, first + n * LANES)
                if not lane(r, 0) > 0.0:
                    continue
                i, j, k = I * SIDE + n // 16, J * SIDE + n // 4 % 4, K * SIDE + n % 4
                _, _, _, _, _, _, fx, fy, fz = integrated(
                    planes, mesh, base, pull, drives, local, delayed, owner, given, before, after,
                    h, cutoff, bounded, b * NODES + n, i, j, k, r,
                    load(nodes, (b * NODES + n) * LANES),
                )  # fmt: skip
                hx = holder(planes, mesh, i, j, k, 0)
                hy = holder(planes, mesh, i, j, k, 1)
                hz = holder(planes, mesh, i, j, k, 2)
                if owner is not None:
                    t = owner[b * NODES + n]
                    hx = 6 + t if t >= 0 and given[t, 0] > 0.0 else hx
                    hy = 6 + t if t >= 0 and given[t, 1] > 0.0 else hy
                    hz = 6 + t if t >= 0 and given[t, 2] > 0.0 else hz
                _count(fx, 0, hx, out, b)
                _count(fy, 1, hy, out, b)
                _count(fz, 2, hz, out, b)
