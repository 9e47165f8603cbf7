"""Contact of particles with the ground, put on the nodes: see `touch` for the equations."""

from typing import NamedTuple

from mpmgeo.boundaries.planes import constrain
from mpmgeo.mpm.core.driven import free_components
from mpmgeo.mpm.core.loops import at_node, is_idle, is_needless, visit
from mpmgeo.mpm.core.stencils import in_block, locate
from mpmgeo.mpm.core.tile import collect_value, deposit_value
from mpmgeo.mpm.terrain.touch import NORMAL, PUSH, TANGENT, TOUCHING, put
from mpmgeo.numerics.jit import inlined
from mpmgeo.numerics.simd import (
    LANES,
    add,
    lane,
    load,
    load_row,
    pack,
    pack4,
    store,
    store_row,
    within,
)
from mpmgeo.state.layout import NODES

PART = 7  # lane of a node's record that nothing else uses


@inlined
def record_of(active, n):
    """Return where the grid's record of node n of the blocks near the ground begins."""
    return (active[n // NODES] * NODES + n % NODES) * LANES


class Fastest(NamedTuple):
    """Find the greatest speed of nodes relative to the ground, block by block.

    Nodes of less than the `least` mass do not count: particles hardly notice them. Arrays: nodes of
    the grid, blocks of them near the ground, squares of the speeds, zero.
    """

    least: float
    motion: tuple


@at_node.register(Fastest)
def fastest(work, node, a):
    nodes, active, square = a
    u, motion = load(nodes, record_of(active, node.number)), work.motion
    x, y, z = lane(u, 0) - motion[0], lane(u, 1) - motion[1], lane(u, 2) - motion[2]
    if lane(u, 6) > work.least:
        b = node.block
        square[b] = max(square[b], x * x + y * y + z * z)


@inlined
def nothing_touches(below, b):
    """Tell whether there is no tile over block b."""
    count = 0
    for o in range(below.shape[1]):
        count += below[b, o] >= 0
    return count == 0


class Part(NamedTuple):
    """Write which part of the nodes' mass touches into the spare lane of their records.

    Arrays: nodes of the grid, blocks of them near the ground, the tiles of blocks that are touched
    over these.
    """


@is_needless.register(Part)
def no_part(work, a, b, bounded):
    return nothing_touches(a[2], b)


@at_node.register(Part)
def part(work, node, a):
    nodes, active, _ = a
    m = lane(load(node.sums, node.at), 0)
    if m > 0.0:
        at = record_of(active, node.number)
        nodes[at + PART] = m / nodes[at + 6]


class Press(NamedTuple):
    """Add the impulses of the touching particles to the tiles, leave their forces.

    Reads the parts of the nodes' mass that touch. Arrays: m, due, forces, touched.
    """

    contact: object
    h: float
    rate: float  # 1/Δt


@is_idle.register(Press)
def unpressed(work, a, b, begin, end):
    return a[3][b] == 0


@visit.register(Press)
def press(work, here, a, p):
    m, due, forces, _ = a
    if due[p] != TOUCHING:
        return 0
    contact, w = work.contact, 1.0 / work.h
    at, wx, wy, wz = locate(here, p)
    r = lane(collect_value(here.source, at, here.rows, wx, wy, wz), PART)
    q = m[p] / r if r > 0.0 else 0.0
    # the spring may not throw a particle out faster than to the surface in a step
    k = min(contact.k * work.h, m[p] * work.rate)
    jx = q * forces[p, NORMAL] + k * forces[p, PUSH]
    jy = q * forces[p, NORMAL + 1] + k * forces[p, PUSH + 1]
    jz = q * forces[p, NORMAL + 2] + k * forces[p, PUSH + 2]
    tx, ty, tz = forces[p, TANGENT], forces[p, TANGENT + 1], forces[p, TANGENT + 2]
    most = contact.μ * contact.μ * (jx * jx + jy * jy + jz * jz)
    t = q * q * (tx * tx + ty * ty + tz * tz)
    q = -q * (most / t) ** 0.5 if t > most else -q
    put(forces, p, NORMAL, w, jx, jy, jz)
    put(forces, p, TANGENT, w * q, tx, ty, tz)
    J = pack(0.0, jx + q * tx, jy + q * ty, jz + q * tz, 0.0, 0.0, 0.0, 0.0)
    deposit_value(here.tiles[0], here.n0 + at, here.rows, wx, wy, wz, J)
    return 0


class Push(NamedTuple):
    """Change velocity and acceleration of the nodes by the impulses, as planes and tools allow.

    Arrays: those of `Part`, those of `driven`.
    """

    planes: object
    driven: object
    h: float


@is_needless.register(Push)
def no_push(work, a, b, bounded):
    return nothing_touches(a[2], b)


@at_node.register(Push)
def push(work, node, a):
    nodes, active, _, driven = a
    J = load(node.sums, node.at)
    vx, vy, vz = lane(J, 1), lane(J, 2), lane(J, 3)
    if vx == 0.0 and vy == 0.0 and vz == 0.0:
        return
    at = record_of(active, node.number)
    u = load(nodes, at)
    m = lane(u, 6)
    if not m > 0.0:
        return
    w, q = 1.0 / m, 1.0 / work.h
    vx, vy, vz = w * vx, w * vy, w * vz
    if node.bounded:
        i, j, k, still = node.i, node.j, node.k, (0.0, 0.0, 0.0)
        vx, vy, vz = constrain(work.planes, node.mesh, i, j, k, vx, vy, vz, still, True)
    gx, gy, gz = free_components(work.driven, driven, at // LANES)
    vx, vy, vz = gx * vx, gy * vy, gz * vz
    store(nodes, at, add(u, pack(vx, vy, vz, q * vx, q * vy, q * vz, 0.0, 0.0)))


class MoveOut(NamedTuple):
    """Move overlapping particles out of the ground; tells who is then outside its block.

    Arrays: due, forces, touched.
    """


@is_idle.register(MoveOut)
def unmoved(work, a, b, begin, end):
    return a[2][b] == 0


@visit.register(MoveOut)
def move_out(work, here, a, p):
    due, forces, _ = a
    if due[p] != TOUCHING:
        return 0
    u = pack4(forces[p, PUSH], forces[p, PUSH + 1], forces[p, PUSH + 2], 0.0)
    X = load_row(here.x, p) + u
    store_row(here.x, p, X)
    return 0 if within(in_block(here.mesh, here.origin, X), here.low, here.high) else 1
