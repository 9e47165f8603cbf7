"""The step of the nodes with two phases: both momenta, with the drag between them.

    m_s a_s = f_s + (1 − n) f_p − f + D,    m_f a_f = n f_p + f + m_f g − D,    f_p = ∫ p ∇S dV
    D = c (v_f' − v_s'),    c = Σ m_f n g₀/k S

f_s: inner force of the effective stress, weight of the solid and loads; f: a force on the fluid
against the solid; g₀/k: unit weight over conductivity; n: porosity of the node. The drag is that
of the velocities v' *after* the step, so it is stable for any conductivity. What one phase gains of
it the other loses: momentum stays to round-off.
"""

from typing import NamedTuple

from mpmgeo.boundaries.planes import constrain
from mpmgeo.damping.damping import damp_all
from mpmgeo.mpm.core.driven import holds, others_velocity
from mpmgeo.mpm.core.loops import at_node
from mpmgeo.mpm.effects.reactions import add_force, at_forces, holder
from mpmgeo.numerics.jit import inlined
from mpmgeo.numerics.simd import LANES, lane, load, pack, splat, store
from mpmgeo.state.layout import NODES

ZERO = (0.0, 0.0, 0.0)


class Momenta(NamedTuple):
    """Integrate the momenta of both phases; leave the records of solid and fluid.

    `planes`, `walls`: those of the solid and of the fluid; the others as in `core.nodes.Momentum`.
    Tiles: solid, flow, pores. Arrays: nodes, flux, those of `driven`.
    """

    planes: object
    walls: object
    start: tuple
    pull: tuple
    drives: bool
    damping: tuple  # of each phase by itself
    gravity: tuple
    driven: object
    h: float
    cutoff: float


@inlined
def _sums(node, field):
    """Return the sum of the tiles of one of the fields at a node."""
    return load(node.sums, node.at + field * NODES * LANES)


@inlined
def _drag(A, B, v, u, w, wf, c, h):
    """Return the force of the fluid on the solid by the velocities that both have after h.

    A, B: accelerations of solid and fluid without it, v, u: velocities, w, wf: inverse masses, 0
    where the velocity is given, c: drag.
    """
    return c * (u - v + h * (B - A)) / (1.0 + h * c * (w + wf))


@inlined
def _damping(models, h, gx, gy, gz, ax, ay, az, vx, vy, vz):
    """Return the acceleration by damping of the components that nothing holds."""
    ax, ay, az, vx, vy, vz = gx * ax, gy * ay, gz * az, gx * vx, gy * vy, gz * vz
    x, y, z = damp_all(models, h, ax, ay, az, vx, vy, vz)
    return x - ax, y - ay, z - az


@inlined
def _driven(model, a, node, axis, r, v, x, g, u, b, f, q, h):
    """Return v, a, g, b, q and the outer force along an axis in which the node may be driven.

    v, x, g: velocity and acceleration of the solid and whether it is free; u, b, f: those of the
    fluid, which is driven where a wall would hold it; q: the step of velocities.
    """
    if model is not None:
        t = holds(model, a, node, axis)
        if t >= 0:
            m, momentum, V = lane(r, 0), lane(r, 1 + axis), a[3][t, axis]
            v = others_velocity(m, lane(r, 7), momentum, a[2][t, axis])
            b = (V - u) / h if f == 0.0 else b
            x = (V - v) / h
            return v, x, 0.0, b, h, (m * V - momentum) / h - m * x
    return v, x, g, b, q, 0.0


@inlined
def both_phases(work, node, driven, r, u, d):
    """Return of a node velocity, acceleration and outer force, of the solid and of the fluid.

    `r`, `u`, `d`: sums of the tiles of solid, flow and pores. Velocities are those after the step,
    forces those of planes and prescribed velocities. One flat tuple of eighteen.
    """
    planes, walls, mesh, h = work.planes, work.walls, node.mesh, work.h
    base, pull, drives = work.start, work.pull, work.drives
    gravity = work.gravity
    i, j, k, at, model = node.i, node.j, node.k, node.number, work.driven
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
    if node.bounded:
        gx, gy, gz = constrain(planes, mesh, i, j, k, gx, gy, gz, ZERO, True)
        fx, fy, fz = constrain(walls, mesh, i, j, k, fx, fy, fz, ZERO, True)
        vx, vy, vz = constrain(planes, mesh, i, j, k, vx, vy, vz, base, drives)
        ux, uy, uz = constrain(walls, mesh, i, j, k, ux, uy, uz, base, drives)
        ax, ay, az = constrain(planes, mesh, i, j, k, ax, ay, az, pull, True)
        bx, by, bz = constrain(walls, mesh, i, j, k, bx, by, bz, pull, True)
    q = h if m > work.cutoff else 0.0
    vx, ax, gx, bx, qx, X = _driven(model, driven, at, 0, r, vx, ax, gx, ux, bx, fx, q, h)
    vy, ay, gy, by, qy, Y = _driven(model, driven, at, 1, r, vy, ay, gy, uy, by, fy, q, h)
    vz, az, gz, bz, qz, Z = _driven(model, driven, at, 2, r, vz, az, gz, uz, bz, fz, q, h)
    Dx = _drag(ax, bx, vx, ux, gx * w, fx * wf, lane(d, 1), h)
    Dy = _drag(ay, by, vy, uy, gy * w, fy * wf, lane(d, 2), h)
    Dz = _drag(az, bz, vz, uz, gz * w, fz * wf, lane(d, 3), h)
    ax, ay, az = ax + gx * w * Dx, ay + gy * w * Dy, az + gz * w * Dz
    bx, by, bz = bx - fx * wf * Dx, by - fy * wf * Dy, bz - fz * wf * Dz
    ex, ey, ez = ex + w * Dx, ey + w * Dy, ez + w * Dz
    cx, cy, cz = cx - wf * Dx, cy - wf * Dy, cz - wf * Dz
    if len(work.damping):
        x, y, z = _damping(work.damping, h, gx, gy, gz, ax, ay, az, vx, vy, vz)
        ax, ay, az, ex, ey, ez = ax + x, ay + y, az + z, ex + x, ey + y, ez + z
        x, y, z = _damping(work.damping, h, fx, fy, fz, bx, by, bz, ux, uy, uz)
        bx, by, bz, cx, cy, cz = bx + x, by + y, bz + z, cx + x, cy + y, cz + z
    return (
        vx + qx * ax, vy + qy * ay, vz + qz * az, ax, ay, az,
        m * (ax - ex) + X, m * (ay - ey) + Y, m * (az - ez) + Z,
        ux + q * bx, uy + q * by, uz + q * bz, bx, by, bz,
        mf * (bx - cx), mf * (by - cy), mf * (bz - cz),
    )  # fmt: skip


@at_node.register(Momenta)
def momenta(work, node, a):
    nodes, flux, driven = a
    at = node.number * LANES
    r, u = _sums(node, 0), _sums(node, 1)
    m = lane(r, 0)
    if not (m > 0.0 and lane(u, 0) > 0.0):
        store(nodes, at, splat(0.0))
        store(flux, at, splat(0.0))
        return
    d = _sums(node, 2)
    vx, vy, vz, ax, ay, az, _, _, _, ux, uy, uz, bx, by, bz, _, _, _ = both_phases(
        work, node, driven, r, u, d
    )
    p = lane(d, 0) / lane(u, 7)
    ux, uy, uz = vx + p * (ux - vx), vy + p * (uy - vy), vz + p * (uz - vz)
    store(nodes, at, pack(vx, vy, vz, ax, ay, az, m, 0.0))
    store(flux, at, pack(ux, uy, uz, bx, by, bz, 0.0, p))


@at_forces.register(Momenta)
def forces(work, node, a, out, b):
    driven = a[2]
    r, u = _sums(node, 0), _sums(node, 1)
    if lane(r, 0) > 0.0 and lane(u, 0) > 0.0:
        _, _, _, _, _, _, X, Y, Z, _, _, _, _, _, _, x, y, z = both_phases(
            work, node, driven, r, u, _sums(node, 2)
        )
        _count(work, node, 0, driven, X, x, out, b)
        _count(work, node, 1, driven, Y, y, out, b)
        _count(work, node, 2, driven, Z, z, out, b)


@inlined
def _count(work, node, axis, driven, of_solid, of_fluid, out, b):
    """Add the forces on both phases of a node to those of the plane or tool that exerts them."""
    i, j, k = node.i, node.j, node.k
    plane = holder(work.planes, node.mesh, i, j, k, axis)
    wall = holder(work.walls, node.mesh, i, j, k, axis)
    t = holds(work.driven, driven, node.number, axis)
    if t >= 0:
        plane = 6 + t
        wall = 6 + t if wall >= 0 else wall
    add_force(of_solid, axis, plane, out, b)
    add_force(of_fluid, axis, wall, out, b)


class Velocities(NamedTuple):
    """Make velocities of both momenta, and the flux; what was the solid's velocity moves to the
    place of its acceleration.

    Tiles: solid, flow. Arrays: nodes, flux, those of `driven`.
    """

    planes: object
    walls: object
    motion: tuple
    drives: bool
    driven: object


@inlined
def _prescribed(model, a, node, axis, v, u, f):
    """Return the velocities of solid and fluid along an axis that may be prescribed."""
    if model is not None:
        t = holds(model, a, node, axis)
        if t >= 0:
            return a[3][t, axis], a[3][t, axis] if f == 0.0 else u
    return v, u


@at_node.register(Velocities)
def velocities(work, node, a):
    nodes, flux, driven = a
    at, mesh = node.number * LANES, node.mesh
    r, u = _sums(node, 0), _sums(node, 1)
    if not (lane(r, 0) > 0.0 and lane(u, 0) > 0.0):
        store(nodes, at, splat(0.0))
        store(flux, at, splat(0.0))
        return
    w, wf = 1.0 / lane(r, 0), 1.0 / lane(u, 0)
    vx, vy, vz = lane(r, 1) * w, lane(r, 2) * w, lane(r, 3) * w
    ux, uy, uz = lane(u, 1) * wf, lane(u, 2) * wf, lane(u, 3) * wf
    i, j, k = node.i, node.j, node.k
    fx = fy = fz = 1.0
    V, drives = work.motion, work.drives
    if node.bounded:
        vx, vy, vz = constrain(work.planes, mesh, i, j, k, vx, vy, vz, V, drives)
        ux, uy, uz = constrain(work.walls, mesh, i, j, k, ux, uy, uz, V, drives)
        fx, fy, fz = constrain(work.walls, mesh, i, j, k, fx, fy, fz, ZERO, True)
    vx, ux = _prescribed(work.driven, driven, node.number, 0, vx, ux, fx)
    vy, uy = _prescribed(work.driven, driven, node.number, 1, vy, uy, fy)
    vz, uz = _prescribed(work.driven, driven, node.number, 2, vz, uz, fz)
    o, p = load(nodes, at), lane(load(flux, at), 7)
    x, y, z = lane(o, 0), lane(o, 1), lane(o, 2)
    store(nodes, at, pack(vx, vy, vz, x, y, z, lane(r, 0), 0.0))
    ux, uy, uz = vx + p * (ux - vx), vy + p * (uy - vy), vz + p * (uz - vz)
    store(flux, at, pack(ux, uy, uz, 0.0, 0.0, 0.0, 0.0, p))
