"""The step of the nodes: sum the tiles, divide by mass, damp, apply the boundaries, integrate.

A node takes part when its mass exceeds a cut-off, far below the smallest particle mass: at the edge
of a particle's domain round-off leaves masses so small that their velocities would be absurd.
"""

from numba import prange

from mpmgeo.boundaries.planes import constrain, touches
from mpmgeo.numerics.jit import blockwise, inlined
from mpmgeo.numerics.simd import LANES, add, lane, load, pack, splat, store
from mpmgeo.shapes.shape import width
from mpmgeo.state.grid import NODES, SIDE


@inlined
def _sum_tiles(tiles, below, a, row, reach, out, first):
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
def _damped(α, ax, ay, az, vx, vy, vz):
    """Return the acceleration less a share α of its size, against the velocity."""
    speed = (vx * vx + vy * vy + vz * vz) ** 0.5
    if speed < 1e-300:
        return ax, ay, az
    f = α * (ax * ax + ay * ay + az * az) ** 0.5 / speed
    return ax - f * vx, ay - f * vy, az - f * vz


@blockwise
def update_momentum(
    shape, mesh, planes, base, pull, drives, local, delayed, h, cutoff,
    chunk, corner, below, tiles, scratch, nodes,
):  # fmt: skip
    """Integrate the nodal momentum over h; leave velocity, acceleration and mass in the nodes.

    `base`, `pull`: velocity before the step and acceleration of a moving base; its nodes take the
    velocity only if it `drives`.
    `local`: share of local damping; `delayed`: the same as MPM-Geomechanics does it, with the
    velocity of the last step and counting wall reactions; None without.
    """
    row = SIDE + width(shape) - 1
    reach = 1 + (width(shape) + SIDE - 2) // SIDE
    for c in prange(len(chunk) - 1):
        first = c * row * row * row * LANES
        for b in range(chunk[c], chunk[c + 1]):
            _sum_tiles(tiles, below, b, row, reach, scratch, first)
            I, J, K = corner[b, 0], corner[b, 1], corner[b, 2]
            bounded = (
                touches(I, mesh.nx, SIDE) or touches(J, mesh.ny, SIDE) or touches(K, mesh.nz, SIDE)
            )
            for n in range(NODES):
                at = (b * NODES + n) * LANES
                r = load(scratch, first + n * LANES)
                m = lane(r, 0)
                if not m > cutoff:
                    store(nodes, at, splat(0.0))
                    continue
                w = 1.0 / m
                vx, vy, vz = lane(r, 1) * w, lane(r, 2) * w, lane(r, 3) * w
                ax, ay, az = lane(r, 4) * w, lane(r, 5) * w, lane(r, 6) * w
                i, j, k = I * SIDE + n // 16, J * SIDE + n // 4 % 4, K * SIDE + n % 4
                if delayed is not None:
                    u = load(nodes, at)
                    ax, ay, az = _damped(delayed, ax, ay, az, lane(u, 0), lane(u, 1), lane(u, 2))
                if bounded:
                    vx, vy, vz = constrain(planes, mesh, i, j, k, vx, vy, vz, base, drives)
                    ax, ay, az = constrain(planes, mesh, i, j, k, ax, ay, az, pull, True)
                if local is not None:
                    ax, ay, az = _damped(local, ax, ay, az, vx, vy, vz)
                    if bounded:
                        ax, ay, az = constrain(planes, mesh, i, j, k, ax, ay, az, pull, True)
                store(nodes, at, pack(vx + ax * h, vy + ay * h, vz + az * h, ax, ay, az, m, 0.0))


@blockwise
def update_velocity(
    shape, mesh, planes, base, drives, cutoff, chunk, corner, below, tiles, scratch, nodes
):
    """Make nodal velocities of momentum; what was the velocity moves to the acceleration's place.

    `base`: velocity of a moving base, which its nodes take if it `drives`.
    """
    row = SIDE + width(shape) - 1
    reach = 1 + (width(shape) + SIDE - 2) // SIDE
    for c in prange(len(chunk) - 1):
        first = c * row * row * row * LANES
        for b in range(chunk[c], chunk[c + 1]):
            _sum_tiles(tiles, below, b, row, reach, scratch, first)
            I, J, K = corner[b, 0], corner[b, 1], corner[b, 2]
            bounded = (
                touches(I, mesh.nx, SIDE) or touches(J, mesh.ny, SIDE) or touches(K, mesh.nz, SIDE)
            )
            for n in range(NODES):
                at = (b * NODES + n) * LANES
                r = load(scratch, first + n * LANES)
                m = lane(r, 0)
                if not m > cutoff:
                    store(nodes, at, splat(0.0))
                    continue
                w = 1.0 / m
                vx, vy, vz = lane(r, 1) * w, lane(r, 2) * w, lane(r, 3) * w
                i, j, k = I * SIDE + n // 16, J * SIDE + n // 4 % 4, K * SIDE + n % 4
                if bounded:
                    vx, vy, vz = constrain(planes, mesh, i, j, k, vx, vy, vz, base, drives)
                u = load(nodes, at)
                store(nodes, at, pack(vx, vy, vz, lane(u, 0), lane(u, 1), lane(u, 2), m, 0.0))
