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
from mpmgeo.mpm.grid_update import damped, is_bounded, sum_tiles
from mpmgeo.numerics.jit import blockwise, inlined
from mpmgeo.numerics.simd import LANES, lane, load, pack, splat, store
from mpmgeo.shapes.shape import width
from mpmgeo.state.grid import NODES, SIDE

ZERO = (0.0, 0.0, 0.0)
SUMS = 3  # sums of tiles that a chunk has room for in the scratch memory


@inlined
def _dragged(As, Af, vs, vf, ws, wf, c, h):
    """Return the accelerations of solid and fluid with the drag of their velocities after h.

    As, Af: without drag; ws, wf: inverse masses, 0 where the velocity is given; c: drag.
    """
    D = c * (vf - vs + h * (Af - As)) / (1.0 + h * c * (ws + wf))
    return As + ws * D, Af - wf * D


@inlined
def _damping(α, gx, gy, gz, ax, ay, az, vx, vy, vz):
    """Return the acceleration by local damping of the components that nothing holds."""
    ax, ay, az, vx, vy, vz = gx * ax, gy * ay, gz * az, gx * vx, gy * vy, gz * vz
    x, y, z = damped(α, ax, ay, az, vx, vy, vz)
    return x - ax, y - ay, z - az


@inlined
def both_phases(
    planes, walls, mesh, base, pull, drives, local, gravity, h, bounded, i, j, k, r, u, d
):
    """Return velocity and acceleration of the solid and of the fluid at a node, twelve numbers.

    `r`, `u`, `d`: sums of the tiles of solid, flow and pores; the velocity is that before the step.
    The other arguments are those of `update_momentum`.
    """
    m, mf, n = lane(r, 0), lane(u, 0), lane(d, 0) / lane(u, 7)
    w, wf = 1.0 / m, 1.0 / mf
    s = 1.0 - n
    vx, vy, vz = lane(r, 1) * w, lane(r, 2) * w, lane(r, 3) * w
    ux, uy, uz = lane(u, 1) * wf, lane(u, 2) * wf, lane(u, 3) * wf
    px, py, pz = lane(u, 4), lane(u, 5), lane(u, 6)
    fx, fy, fz = lane(d, 4), lane(d, 5), lane(d, 6)
    ax = w * (lane(r, 4) + s * px - fx)
    ay = w * (lane(r, 5) + s * py - fy)
    az = w * (lane(r, 6) + s * pz - fz)
    bx = wf * (n * px + fx) + gravity[0]
    by = wf * (n * py + fy) + gravity[1]
    bz = wf * (n * pz + fz) + gravity[2]
    gx = gy = gz = hx = hy = hz = 1.0
    if bounded:
        gx, gy, gz = constrain(planes, mesh, i, j, k, gx, gy, gz, ZERO, True)
        hx, hy, hz = constrain(walls, mesh, i, j, k, hx, hy, hz, ZERO, True)
        vx, vy, vz = constrain(planes, mesh, i, j, k, vx, vy, vz, base, drives)
        ux, uy, uz = constrain(walls, mesh, i, j, k, ux, uy, uz, base, drives)
        ax, ay, az = constrain(planes, mesh, i, j, k, ax, ay, az, pull, True)
        bx, by, bz = constrain(walls, mesh, i, j, k, bx, by, bz, pull, True)
    ax, bx = _dragged(ax, bx, vx, ux, gx * w, hx * wf, lane(d, 1), h)
    ay, by = _dragged(ay, by, vy, uy, gy * w, hy * wf, lane(d, 2), h)
    az, bz = _dragged(az, bz, vz, uz, gz * w, hz * wf, lane(d, 3), h)
    if local is not None:
        x, y, z = _damping(local, gx, gy, gz, ax, ay, az, vx, vy, vz)
        ax, ay, az = ax + x, ay + y, az + z
        x, y, z = _damping(local, hx, hy, hz, bx, by, bz, ux, uy, uz)
        bx, by, bz = bx + x, by + y, bz + z
    return vx, vy, vz, ax, ay, az, ux, uy, uz, bx, by, bz


@blockwise
def update_momentum(
    shape, mesh, planes, walls, base, pull, drives, local, gravity, h, cutoff,
    chunk, corner, below, tiles, flow, pores, scratch, nodes, flux,
):  # fmt: skip
    """Integrate the momenta of both phases over h; leave the records of solid and fluid.

    `planes`, `walls`: those of the solid and of the fluid; `base`, `pull`, `drives`: see
    `grid_update.update_momentum`; `local`: share of local damping, for each phase by itself, None
    without.
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
                at = (b * NODES + n) * LANES
                r, u = load(scratch, s0 + n * LANES), load(scratch, s1 + n * LANES)
                m = lane(r, 0)
                if not (m > 0.0 and lane(u, 0) > 0.0):
                    store(nodes, at, splat(0.0))
                    store(flux, at, splat(0.0))
                    continue
                d = load(scratch, s2 + n * LANES)
                i, j, k = I * SIDE + n // 16, J * SIDE + n // 4 % 4, K * SIDE + n % 4
                vx, vy, vz, ax, ay, az, ux, uy, uz, bx, by, bz = both_phases(
                    planes, walls, mesh, base, pull, drives, local, gravity, h, bounded,
                    i, j, k, r, u, d,
                )  # fmt: skip
                q = h if m > cutoff else 0.0
                vx, vy, vz = vx + ax * q, vy + ay * q, vz + az * q
                ux, uy, uz = ux + bx * q, uy + by * q, uz + bz * q
                p = lane(d, 0) / lane(u, 7)
                store(nodes, at, pack(vx, vy, vz, ax, ay, az, m, 0.0))
                ux, uy, uz = vx + p * (ux - vx), vy + p * (uy - vy), vz + p * (uz - vz)
                store(flux, at, pack(ux, uy, uz, bx, by, bz, 0.0, p))


@blockwise
def update_velocity(
    shape, mesh, planes, walls, base, drives, chunk, corner, below, tiles, flow, scratch, nodes,
    flux,
):  # fmt: skip
    """Make velocities of both momenta, and the flux; the solid's last velocity takes the place of
    its acceleration."""
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
                m = lane(r, 0)
                if not (m > 0.0 and lane(u, 0) > 0.0):
                    store(nodes, at, splat(0.0))
                    store(flux, at, splat(0.0))
                    continue
                w, wf = 1.0 / m, 1.0 / lane(u, 0)
                vx, vy, vz = lane(r, 1) * w, lane(r, 2) * w, lane(r, 3) * w
                ux, uy, uz = lane(u, 1) * wf, lane(u, 2) * wf, lane(u, 3) * wf
                i, j, k = I * SIDE + n // 16, J * SIDE + n // 4 % 4, K * SIDE + n % 4
                if bounded:
                    vx, vy, vz = constrain(planes, mesh, i, j, k, vx, vy, vz, base, drives)
                    ux, uy, uz = constrain(walls, mesh, i, j, k, ux, uy, uz, base, drives)
                o = load(nodes, at)
                store(nodes, at, pack(vx, vy, vz, lane(o, 0), lane(o, 1), lane(o, 2), m, 0.0))
                p = lane(load(flux, at), 7)
                ux, uy, uz = vx + p * (ux - vx), vy + p * (uy - vy), vz + p * (uz - vz)
                store(flux, at, pack(ux, uy, uz, 0.0, 0.0, 0.0, 0.0, p))


@blockwise
def average(shape, chunk, below, tiles, scratch, flux):
    """Give every cell the mean divergence of its particles, which `spread` put into the tiles."""
    row = SIDE + width(shape) - 1
    reach = 1 + (width(shape) + SIDE - 2) // SIDE
    for c in prange(len(chunk) - 1):
        first = c * SUMS * NODES * LANES
        for b in range(chunk[c], chunk[c + 1]):
            sum_tiles(tiles, below, b, row, reach, scratch, first)
            for n in range(NODES):
                at = (b * NODES + n) * LANES
                r, u = load(scratch, first + n * LANES), load(flux, at)
                d = lane(r, 1) / lane(r, 0) if lane(r, 0) > 0.0 else 0.0
                store(
                    flux, at,
                    pack(
                        lane(u, 0), lane(u, 1), lane(u, 2), lane(u, 3), lane(u, 4), lane(u, 5),
                        d, lane(u, 7),
                    ),
                )  # fmt: skip
