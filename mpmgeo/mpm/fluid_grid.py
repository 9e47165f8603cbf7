"""The step of the nodes with two phases: both momenta, with the drag between them.

    m_s a_s = f_s + (1 − n) f_p − f + D,    m_f a_f = n f_p + f + m_f g − D,    f_p = ∫ p ∇S dV
    D = c (v_f' − v_s'),    c = Σ m_f n g₀/k S

f_s: inner force of the effective stress, weight of the solid and loads; f: a force on the fluid
against the solid; g₀/k: unit weight over conductivity; n: porosity of the node. The drag is that
of the velocities v' *after* the step, so it is stable for any conductivity. What one phase gains of
it the other loses: momentum stays to round-off.
"""

from numba import prange

from mpmgeo.boundaries.planes import constrain
from mpmgeo.mpm.grid_update import ROUND_OFF, damped, is_bounded, sum_tiles
from mpmgeo.mpm.reactions import holder
from mpmgeo.numerics.jit import blockwise, inlined
from mpmgeo.numerics.simd import LANES, lane, load, pack, splat, store
from mpmgeo.shapes.shape import width
from mpmgeo.state.grid import NODES, SIDE

ZERO = (0.0, 0.0, 0.0)
SUMS = 3  # sums of tiles that a chunk has room for in the scratch memory


@inlined
def _drag(A, B, v, u, w, wf, c, h):
    """Return the force of the fluid on the solid by the velocities that both have after h.

    A, B: accelerations of solid and fluid without it, v, u: velocities, w, wf: inverse masses, 0
    where the velocity is given, c: drag.
    """
    return c * (u - v + h * (B - A)) / (1.0 + h * c * (w + wf))


@inlined
def _damping(α, gx, gy, gz, ax, ay, az, vx, vy, vz):
    """Return the acceleration by local damping of the components that nothing holds."""
    ax, ay, az, vx, vy, vz = gx * ax, gy * ay, gz * az, gx * vx, gy * vy, gz * vz
    x, y, z = damped(α, ax, ay, az, vx, vy, vz)
    return x - ax, y - ay, z - az


@inlined
def _tooled(given, before, after, t, axis, r, v, a, g, u, b, f, q, h):
    """Return v, a, g, b, q and the tool's force along an axis in which tool t may drive the node.

    v, a, g: velocity and acceleration of the solid and whether it is free; u, b, f: those of the
    fluid, which moves with a tool where a wall would hold it; q: the step of velocities.
    """
    if given is not None and t >= 0 and given[t, axis] > 0.0:
        m, momentum, tool = lane(r, 0), lane(r, 1 + axis), lane(r, 7)
        V, others = after[t, axis], m - tool
        v = before[t, axis]
        if others > ROUND_OFF * m:
            v = (momentum - tool * v) / others
        b = (V - u) / h if f == 0.0 else b
        a = (V - v) / h
        return v, a, 0.0, b, h, (m * V - momentum) / h - m * a
    return v, a, g, b, q, 0.0


@inlined
def both_phases(
    planes, walls, mesh, base, pull, drives, local, gravity, owner, given, before, after, h, cutoff,
    bounded, node, i, j, k, r, u, d,
):  # fmt: skip
    """Return of a node velocity, acceleration and outer force, of the solid and of the fluid.

    `r`, `u`, `d`: sums of the tiles of solid, flow and pores. Velocities are those after the step,
    forces those of planes and tools. The other arguments are those of `update_momentum` and
    `grid_update.integrated`. One flat tuple of eighteen.
    """
    m, mf, n = lane(r, 0), lane(u, 0), lane(d, 0) / lane(u, 7)
    w, wf, s = 1.0 / m, 1.0 / mf, 1.0 - n
    vx, vy, vz = lane(r, 1) * w, lane(r, 2) * w, lane(r, 3) * w
    ux, uy, uz = lane(u, 1) * wf, lane(u, 2) * wf, lane(u, 3) * wf
    ax = ex = w * (lane(r, 4) + s * lane(u, 4) - lane(d, 4))
    ay = ey = w * (lane(r, 5) + s * lane(u, 5) - lane(d, 5))
    az = ez = w * (lane(r, 6) + s * lane(u, 6) - lane(d, 6))
    bx = cx = wf * (n * lane(u, 4) + lane(d, 4)) + gravity[0]
    by = cy = wf * (n * lane(u, 5) + lane(d, 5)) + gravity[1]
    bz = cz = wf * (n * lane(u, 6) + lane(d, 6)) + gravity[2]
    gx = gy = gz = fx = fy = fz = 1.0  # whether a component of solid and fluid is free
    if bounded:
        gx, gy, gz = constrain(planes, mesh, i, j, k, gx, gy, gz, ZERO, True)
        fx, fy, fz = constrain(walls, mesh, i, j, k, fx, fy, fz, ZERO, True)
        vx, vy, vz = constrain(planes, mesh, i, j, k, vx, vy, vz, base, drives)
        ux, uy, uz = constrain(walls, mesh, i, j, k, ux, uy, uz, base, drives)
        ax, ay, az = constrain(planes, mesh, i, j, k, ax, ay, az, pull, True)
        bx, by, bz = constrain(walls, mesh, i, j, k, bx, by, bz, pull, True)
    q = h if m > cutoff else 0.0
    t = owner[node] if owner is not None else -1
    vx, ax, gx, bx, qx, X = _tooled(given, before, after, t, 0, r, vx, ax, gx, ux, bx, fx, q, h)
    vy, ay, gy, by, qy, Y = _tooled(given, before, after, t, 1, r, vy, ay, gy, uy, by, fy, q, h)
    vz, az, gz, bz, qz, Z = _tooled(given, before, after, t, 2, r, vz, az, gz, uz, bz, fz, q, h)
    Dx = _drag(ax, bx, vx, ux, gx * w, fx * wf, lane(d, 1), h)
    Dy = _drag(ay, by, vy, uy, gy * w, fy * wf, lane(d, 2), h)
    Dz = _drag(az, bz, vz, uz, gz * w, fz * wf, lane(d, 3), h)
    ax, ay, az = ax + gx * w * Dx, ay + gy * w * Dy, az + gz * w * Dz
    bx, by, bz = bx - fx * wf * Dx, by - fy * wf * Dy, bz - fz * wf * Dz
    ex, ey, ez = ex + w * Dx, ey + w * Dy, ez + w * Dz
    cx, cy, cz = cx - wf * Dx, cy - wf * Dy, cz - wf * Dz
    if local is not None:
        x, y, z = _damping(local, gx, gy, gz, ax, ay, az, vx, vy, vz)
        ax, ay, az, ex, ey, ez = ax + x, ay + y, az + z, ex + x, ey + y, ez + z
        x, y, z = _damping(local, fx, fy, fz, bx, by, bz, ux, uy, uz)
        bx, by, bz, cx, cy, cz = bx + x, by + y, bz + z, cx + x, cy + y, cz + z
    return (
        vx + qx * ax, vy + qy * ay, vz + qz * az, ax, ay, az,
        m * (ax - ex) + X, m * (ay - ey) + Y, m * (az - ez) + Z,
        ux + q * bx, uy + q * by, uz + q * bz, bx, by, bz,
        mf * (bx - cx), mf * (by - cy), mf * (bz - cz),
    )  # fmt: skip


@blockwise
def update_momentum(
    shape, mesh, planes, walls, base, pull, drives, local, gravity, owner, given, before, after, h,
    cutoff, chunk, corner, below, tiles, flow, pores, scratch, nodes, flux,
):  # fmt: skip
    """Integrate the momenta of both phases over h; leave the records of solid and fluid.

    `planes`, `walls`: those of the solid and of the fluid; `local`: share of local damping, of each
    phase by itself, None without; the others: see `grid_update.update_momentum`.
    """
    row = SIDE + width(shape) - 1
    reach = 1 + (width(shape) + SIDE - 2) // SIDE
    for c in prange(len(chunk) - 1):
        s0 = c * SUMS * NODES * LANES
        s1, s2 = s0 + NODES * LANES, s0 + 2 * NODES * LANES
        for b in range(chunk[c], chunk[c + 1]):
            sum_tiles(tiles, below, b, row, reach, scratch, s0)
            sum_tiles(flow, below, b, row, reach, scratch, s1)
            sum_tiles(pores, below, b, row, reach, scratch, s2)
            I, J, K = corner[b, 0], corner[b, 1], corner[b, 2]
            bounded = is_bounded(mesh, I, J, K)
            for n in range(NODES):
                node = b * NODES + n
                r, u = load(scratch, s0 + n * LANES), load(scratch, s1 + n * LANES)
                m = lane(r, 0)
                if not (m > 0.0 and lane(u, 0) > 0.0):
                    store(nodes, node * LANES, splat(0.0))
                    store(flux, node * LANES, splat(0.0))
                    continue
                d = load(scratch, s2 + n * LANES)
                i, j, k = I * SIDE + n // 16, J * SIDE + n // 4 % 4, K * SIDE + n % 4
                vx, vy, vz, ax, ay, az, _, _, _, ux, uy, uz, bx, by, bz, _, _, _ = both_phases(
                    planes, walls, mesh, base, pull, drives, local, gravity, owner, given, before,
                    after, h, cutoff, bounded, node, i, j, k, r, u, d,
                )  # fmt: skip
                p = lane(d, 0) / lane(u, 7)
                ux, uy, uz = vx + p * (ux - vx), vy + p * (uy - vy), vz + p * (uz - vz)
                store(nodes, node * LANES, pack(vx, vy, vz, ax, ay, az, m, 0.0))
                store(flux, node * LANES, pack(ux, uy, uz, bx, by, bz, 0.0, p))


@blockwise
def add_forces(
    shape, mesh, planes, walls, base, pull, drives, local, gravity, owner, given, before, after, h,
    cutoff, chunk, corner, below, tiles, flow, pores, scratch, nodes, flux, out,
):  # fmt: skip
    """Sum the forces of planes and tools on both phases, as `reactions.add_forces` does for one."""
    row = SIDE + width(shape) - 1
    reach = 1 + (width(shape) + SIDE - 2) // SIDE
    for c in prange(len(chunk) - 1):
        s0 = c * SUMS * NODES * LANES
        s1, s2 = s0 + NODES * LANES, s0 + 2 * NODES * LANES
        for b in range(chunk[c], chunk[c + 1]):
            sum_tiles(tiles, below, b, row, reach, scratch, s0)
            sum_tiles(flow, below, b, row, reach, scratch, s1)
            sum_tiles(pores, below, b, row, reach, scratch, s2)
            I, J, K = corner[b, 0], corner[b, 1], corner[b, 2]
            bounded = is_bounded(mesh, I, J, K)
            for n in range(NODES):
                node = b * NODES + n
                r, u = load(scratch, s0 + n * LANES), load(scratch, s1 + n * LANES)
                if not (lane(r, 0) > 0.0 and lane(u, 0) > 0.0):
                    continue
                i, j, k = I * SIDE + n // 16, J * SIDE + n // 4 % 4, K * SIDE + n % 4
                _, _, _, _, _, _, X, Y, Z, _, _, _, _, _, _, x, y, z = both_phases(
                    planes, walls, mesh, base, pull, drives, local, gravity, owner, given, before,
                    after, h, cutoff, bounded, node, i, j, k, r, u,
                    load(scratch, s2 + n * LANES),
                )  # fmt: skip
                t = owner[node] if owner is not None else -1
                _count(planes, walls, mesh, i, j, k, 0, given, t, X, x, out, b)
                _count(planes, walls, mesh, i, j, k, 1, given, t, Y, y, out, b)
                _count(planes, walls, mesh, i, j, k, 2, given, t, Z, z, out, b)


@inlined
def _count(planes, walls, mesh, i, j, k, axis, given, t, of_solid, of_fluid, out, b):
    """Add the forces on both phases of a node to those of the planes or tool that exert them."""
    plane, wall = holder(planes, mesh, i, j, k, axis), holder(walls, mesh, i, j, k, axis)
    if given is not None and t >= 0 and given[t, axis] > 0.0:
        plane = 6 + t
        wall = 6 + t if wall >= 0 else wall
    if plane >= 0:
        out[b, plane, axis] += of_solid
    if wall >= 0:
        out[b, wall, axis] += of_fluid


@inlined
def _prescribed(given, after, t, axis, v, u, f):
    """Return the velocities of solid and fluid along an axis that tool t may prescribe."""
    if given is not None and t >= 0 and given[t, axis] > 0.0:
        return after[t, axis], after[t, axis] if f == 0.0 else u
    return v, u


@blockwise
def update_velocity(
    shape, mesh, planes, walls, base, drives, owner, given, after,
    chunk, corner, below, tiles, flow, scratch, nodes, flux,
):  # fmt: skip
    """Make velocities of both momenta, and the flux; what was the solid's velocity moves to the
    place of its acceleration."""
    row = SIDE + width(shape) - 1
    reach = 1 + (width(shape) + SIDE - 2) // SIDE
    for c in prange(len(chunk) - 1):
        s0 = c * SUMS * NODES * LANES
        s1 = s0 + NODES * LANES
        for b in range(chunk[c], chunk[c + 1]):
            sum_tiles(tiles, below, b, row, reach, scratch, s0)
            sum_tiles(flow, below, b, row, reach, scratch, s1)
            I, J, K = corner[b, 0], corner[b, 1], corner[b, 2]
            bounded = is_bounded(mesh, I, J, K)
            for n in range(NODES):
                at = (b * NODES + n) * LANES
                r, u = load(scratch, s0 + n * LANES), load(scratch, s1 + n * LANES)
                if not (lane(r, 0) > 0.0 and lane(u, 0) > 0.0):
                    store(nodes, at, splat(0.0))
                    store(flux, at, splat(0.0))
                    continue
                w, wf = 1.0 / lane(r, 0), 1.0 / lane(u, 0)
                vx, vy, vz = lane(r, 1) * w, lane(r, 2) * w, lane(r, 3) * w
                ux, uy, uz = lane(u, 1) * wf, lane(u, 2) * wf, lane(u, 3) * wf
                i, j, k = I * SIDE + n // 16, J * SIDE + n // 4 % 4, K * SIDE + n % 4
                fx = fy = fz = 1.0
                if bounded:
                    vx, vy, vz = constrain(planes, mesh, i, j, k, vx, vy, vz, base, drives)
                    ux, uy, uz = constrain(walls, mesh, i, j, k, ux, uy, uz, base, drives)
                    fx, fy, fz = constrain(walls, mesh, i, j, k, fx, fy, fz, ZERO, True)
                t = owner[b * NODES + n] if owner is not None else -1
                vx, ux = _prescribed(given, after, t, 0, vx, ux, fx)
                vy, uy = _prescribed(given, after, t, 1, vy, uy, fy)
                vz, uz = _prescribed(given, after, t, 2, vz, uz, fz)
                o, p = load(nodes, at), lane(load(flux, at), 7)
                x, y, z = lane(o, 0), lane(o, 1), lane(o, 2)
                store(nodes, at, pack(vx, vy, vz, x, y, z, lane(r, 0), 0.0))
                ux, uy, uz = vx + p * (ux - vx), vy + p * (uy - vy), vz + p * (uz - vz)
                store(flux, at, pack(ux, uy, uz, 0.0, 0.0, 0.0, 0.0, p))


@blockwise
def average(shape, mesh, chunk, below, tiles, scratch, flux):
    """Give every cell the mean of what `sum_cells` put into the tiles, in its record's lane 6."""
    row = SIDE + width(shape) - 1
    reach = 1 + (width(shape) + SIDE - 2) // SIDE
    for c in prange(len(chunk) - 1):
        first = c * SUMS * NODES * LANES
        for b in range(chunk[c], chunk[c + 1]):
            sum_tiles(tiles, below, b, row, reach, scratch, first)
            for n in range(NODES):
                at = (b * NODES + n) * LANES
                r = load(scratch, first + n * LANES)
                if lane(r, 0) > 0.0:
                    flux[at + 6] = lane(r, 1) / lane(r, 0)
