"""The step of the nodes: sum the tiles, divide by mass, damp, apply the boundaries, integrate.

At the edge of a particle's support round-off leaves nodal masses so small that forces of round-off
would give them absurd velocities. Below a cut-off, the mass of a lightest particle that reaches
over the node by 1e-12 of a cell, a node keeps the velocity of its particles: a mean of theirs is
always safe, while zero would strain them. The forces still reach the particles: momentum stays.
"""

from numba import prange

from mpmgeo.boundaries.planes import constrain, touches
from mpmgeo.numerics.jit import blockwise, inlined
from mpmgeo.numerics.simd import LANES, add, lane, load, pack, splat, store
from mpmgeo.shapes.shape import width
from mpmgeo.state.grid import NODES, SIDE

ROUND_OFF = 1e-14  # share of a node's mass below which what is not the tool's is round-off


@inlined
def is_bounded(mesh, I, J, K):
    """Tell whether a block of corner (I, J, K) may have nodes on a plane."""
    return touches(I, mesh.nx, SIDE) or touches(J, mesh.ny, SIDE) or touches(K, mesh.nz, SIDE)


@inlined
def sum_tiles(tiles, below, a, row, reach, out, first):
    """Sum the tiles over active block a, in fixed order, into 64 records of `out` from `first`."""
    for n in range(NODES):
        store(out, first + n * LANES, splat(0.0))
    size = row * row * row * LANES
    for di in range(reach):
        for dj in range(reach):
            for dk in range(reach):
                t = below[a, (di * reach + dj) * reach + dk]
                if t < 0:
                    continue
                i0, j0, k0 = SIDE * di, SIDE * dj, SIDE * dk
                for i in range(min(SIDE, row - i0)):
                    for j in range(min(SIDE, row - j0)):
                        n = first + (i * SIDE + j) * SIDE * LANES
                        s = t * size + (((i + i0) * row + j + j0) * row + k0) * LANES
                        for k in range(min(SIDE, row - k0)):
                            at = n + k * LANES
                            store(out, at, add(load(out, at), load(tiles, s + k * LANES)))


@inlined
def damped(α, ax, ay, az, vx, vy, vz):
    """Return the acceleration less a share α of its size, against the velocity."""
    speed = (vx * vx + vy * vy + vz * vz) ** 0.5
    if speed < 1e-300:
        return ax, ay, az
    f = α * (ax * ax + ay * ay + az * az) ** 0.5 / speed
    return ax - f * vx, ay - f * vy, az - f * vz


@inlined
def _driven(m, tool, momentum, a, before, after, h):
    """Return velocity, acceleration and outer force of a node in a component that is prescribed.

    The acceleration brings what is there without the tool's own mass to the velocity `after`; the
    force is what all the momentum needs beyond the acceleration `a`.
    """
    others = m - tool
    v = (momentum - tool * before) / others if others > ROUND_OFF * m else before
    return after, (after - v) / h, (m * after - momentum) / h - m * a


@inlined
def integrated(
    planes, mesh, base, pull, drives, local, delayed, owner, given, before, after, h, cutoff,
    bounded, n, i, j, k, r, u,
):  # fmt: skip
    """Return velocity and acceleration of node n, and the force on it of the planes or its tool.

    `r`: its sum of the tiles, `u`: its record before the step, i j k its index, `bounded`: whether
    it may lie on a plane; the others are those of `update_momentum`. One flat tuple of nine.
    """
    m = lane(r, 0)
    w = 1.0 / m
    vx, vy, vz = lane(r, 1) * w, lane(r, 2) * w, lane(r, 3) * w
    ax, ay, az = lane(r, 4) * w, lane(r, 5) * w, lane(r, 6) * w
    if delayed is not None:
        ax, ay, az = damped(delayed, ax, ay, az, lane(u, 0), lane(u, 1), lane(u, 2))
    ex, ey, ez = ax, ay, az  # the acceleration without planes and tools
    if bounded:
        vx, vy, vz = constrain(planes, mesh, i, j, k, vx, vy, vz, base, drives)
        ax, ay, az = constrain(planes, mesh, i, j, k, ax, ay, az, pull, True)
    if owner is not None:
        t = owner[n]
        if t >= 0:
            gx, gy, gz = 1.0 - given[t, 0], 1.0 - given[t, 1], 1.0 - given[t, 2]
            vx, vy, vz = vx * gx, vy * gy, vz * gz
            ax, ay, az = ax * gx, ay * gy, az * gz
    if local is not None:
        x, y, z = ax, ay, az
        ax, ay, az = damped(local, ax, ay, az, vx, vy, vz)
        ex, ey, ez = ex + ax - x, ey + ay - y, ez + az - z
        if bounded:
            ax, ay, az = constrain(planes, mesh, i, j, k, ax, ay, az, pull, True)
    fx, fy, fz = m * (ax - ex), m * (ay - ey), m * (az - ez)
    q = h if m > cutoff else 0.0
    vx, vy, vz = vx + ax * q, vy + ay * q, vz + az * q
    if owner is not None:
        t, s = owner[n], lane(r, 7)
        if t >= 0 and given[t, 0] > 0.0:
            vx, ax, fx = _driven(m, s, lane(r, 1), ex, before[t, 0], after[t, 0], h)
        if t >= 0 and given[t, 1] > 0.0:
            vy, ay, fy = _driven(m, s, lane(r, 2), ey, before[t, 1], after[t, 1], h)
        if t >= 0 and given[t, 2] > 0.0:
            vz, az, fz = _driven(m, s, lane(r, 3), ez, before[t, 2], after[t, 2], h)
    return vx, vy, vz, ax, ay, az, fx, fy, fz


@blockwise
def update_momentum(
    shape, mesh, planes, base, pull, drives, local, delayed, owner, given, before, after, h, cutoff,
    chunk, corner, below, tiles, scratch, nodes,
):  # fmt: skip
    """Integrate the nodal momentum over h; leave velocity, acceleration and mass in the nodes.

    `base`, `pull`: velocity before the step and acceleration of a moving base; its nodes take the
    velocity only if it `drives`.
    `local`: share of local damping; `delayed`: the same as MPM-Geomechanics does it, with the
    velocity of the last step and counting wall reactions; None without.
    `owner`: number of the tool that prescribes a node's velocity, or −1; `given`: 1 for the
    components that a tool prescribes, `before` and `after`: its velocity; None without tools.
    """
    row = SIDE + width(shape) - 1
    reach = 1 + (width(shape) + SIDE - 2) // SIDE
    for c in prange(len(chunk) - 1):
        first = c * row * row * row * LANES
        for b in range(chunk[c], chunk[c + 1]):
            sum_tiles(tiles, below, b, row, reach, scratch, first)
            I, J, K = corner[b, 0], corner[b, 1], corner[b, 2]
            bounded = is_bounded(mesh, I, J, K)
            for n in range(NODES):
                at = (b * NODES + n) * LANES
                r = load(scratch, first + n * LANES)
                m = lane(r, 0)
                if not m > 0.0:
                    store(nodes, at, splat(0.0))
                    continue
                i, j, k = I * SIDE + n // 16, J * SIDE + n // 4 % 4, K * SIDE + n % 4
                vx, vy, vz, ax, ay, az, _, _, _ = integrated(
                    planes, mesh, base, pull, drives, local, delayed, owner, given, before, after,
                    h, cutoff, bounded, b * NODES + n, i, j, k, r, load(nodes, at),
                )  # fmt: skip
                store(nodes, at, pack(vx, vy, vz, ax, ay, az, m, 0.0))


@blockwise
def update_velocity(
    shape, mesh, planes, base, drives, owner, given, prescribed,
    chunk, corner, below, tiles, scratch, nodes,
):  # fmt: skip
    """Make nodal velocities of momentum; what was the velocity moves to the acceleration's place.

    `base`: velocity of a moving base, which its nodes take if it `drives`; `prescribed`: velocity
    of the tools, see `update_momentum`.
    """
    row = SIDE + width(shape) - 1
    reach = 1 + (width(shape) + SIDE - 2) // SIDE
    for c in prange(len(chunk) - 1):
        first = c * row * row * row * LANES
        for b in range(chunk[c], chunk[c + 1]):
            sum_tiles(tiles, below, b, row, reach, scratch, first)
            I, J, K = corner[b, 0], corner[b, 1], corner[b, 2]
            bounded = is_bounded(mesh, I, J, K)
            for n in range(NODES):
                at = (b * NODES + n) * LANES
                r = load(scratch, first + n * LANES)
                m = lane(r, 0)
                if not m > 0.0:
                    store(nodes, at, splat(0.0))
                    continue
                w = 1.0 / m
                vx, vy, vz = lane(r, 1) * w, lane(r, 2) * w, lane(r, 3) * w
                i, j, k = I * SIDE + n // 16, J * SIDE + n // 4 % 4, K * SIDE + n % 4
                if bounded:
                    vx, vy, vz = constrain(planes, mesh, i, j, k, vx, vy, vz, base, drives)
                if owner is not None:
                    t = owner[b * NODES + n]
                    if t >= 0:
                        vx = prescribed[t, 0] if given[t, 0] > 0.0 else vx
                        vy = prescribed[t, 1] if given[t, 1] > 0.0 else vy
                        vz = prescribed[t, 2] if given[t, 2] > 0.0 else vz
                u = load(nodes, at)
                store(nodes, at, pack(vx, vy, vz, lane(u, 0), lane(u, 1), lane(u, 2), m, 0.0))
