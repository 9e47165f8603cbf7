"""The step of the nodes: divide by mass, apply the boundaries, damp, integrate.

At the edge of a particle's support round-off leaves nodal masses so small that forces of round-off
would give them absurd velocities. Below a cut-off, the mass of a lightest particle that reaches
over the node by 1e-12 of a cell, a node keeps the velocity of its particles: a mean of theirs is
always safe, while zero would strain them. The forces still reach the particles: momentum stays.
"""

from typing import NamedTuple

from mpmgeo.boundaries.planes import constrain
from mpmgeo.damping.damping import damp, damp_all
from mpmgeo.mpm.core.driven import drive, free_components, prescribe
from mpmgeo.mpm.core.loops import at_node
from mpmgeo.numerics.jit import inlined
from mpmgeo.numerics.simd import LANES, lane, load, pack, splat, store


class Momentum(NamedTuple):
    """Integrate the momentum; leave velocity, acceleration and mass in the nodes.

    Arrays: nodes, those of `driven`.
    """

    planes: object
    start: tuple  # velocity before the step of a plane that moves,
    pull: tuple  # its acceleration,
    drives: bool  # and whether its nodes take the velocity
    early: object  # damping with the last velocity, that counts wall reactions, or None
    damping: tuple  # models of damping
    driven: object  # model of nodes whose velocity is prescribed, None without
    h: float
    cutoff: float  # [kg] mass up to which forces do not move a node


@at_node.register(Momentum)
def momentum(work, node, a):
    nodes, driven = a
    at = node.number * LANES
    r = load(node.sums, node.at)
    m = lane(r, 0)
    if not m > 0.0:
        store(nodes, at, splat(0.0))
        return
    new = integrated(work, node, driven, r, load(nodes, at))
    store(nodes, at, pack(new[0], new[1], new[2], new[3], new[4], new[5], m, 0.0))


@inlined
def integrated(work, node, driven, r, u):
    """Return velocity and acceleration of a node, the force on it of what holds or drives it, and
    the acceleration by the models of damping.

    `r`: its sum of the tiles, `u`: its record before the step, `driven`: the arrays of
    `work.driven`. One flat tuple of twelve.
    """
    planes, mesh, h = work.planes, node.mesh, work.h
    start, pull, drives = work.start, work.pull, work.drives
    i, j, k = node.i, node.j, node.k
    m = lane(r, 0)
    w = 1.0 / m
    vx, vy, vz = lane(r, 1) * w, lane(r, 2) * w, lane(r, 3) * w
    ax, ay, az = lane(r, 4) * w, lane(r, 5) * w, lane(r, 6) * w
    ax, ay, az = _damped_early(work.early, h, ax, ay, az, u)
    ex, ey, ez = ax, ay, az  # the acceleration without planes and prescribed velocities
    if node.bounded:
        vx, vy, vz = constrain(planes, mesh, i, j, k, vx, vy, vz, start, drives)
        ax, ay, az = constrain(planes, mesh, i, j, k, ax, ay, az, pull, True)
    gx, gy, gz = free_components(work.driven, driven, node.number)
    vx, vy, vz, ax, ay, az = vx * gx, vy * gy, vz * gz, ax * gx, ay * gy, az * gz
    x, y, z = ax, ay, az
    ax, ay, az = damp_all(work.damping, h, ax, ay, az, vx, vy, vz)
    dx, dy, dz = ax - x, ay - y, az - z
    if len(work.damping):
        ex, ey, ez = ex + dx, ey + dy, ez + dz
        if node.bounded:
            ax, ay, az = constrain(planes, mesh, i, j, k, ax, ay, az, pull, True)
    fx, fy, fz = m * (ax - ex), m * (ay - ey), m * (az - ez)
    q = h if m > work.cutoff else 0.0
    vx, vy, vz = vx + ax * q, vy + ay * q, vz + az * q
    vx, ax, fx = drive(work.driven, driven, node.number, 0, r, vx, ax, fx, ex, h)
    vy, ay, fy = drive(work.driven, driven, node.number, 1, r, vy, ay, fy, ey, h)
    vz, az, fz = drive(work.driven, driven, node.number, 2, r, vz, az, fz, ez, h)
    return vx, vy, vz, ax, ay, az, fx, fy, fz, dx, dy, dz


@inlined
def _damped_early(early, h, ax, ay, az, u):
    if early is None:
        return ax, ay, az
    return damp(early, h, ax, ay, az, lane(u, 0), lane(u, 1), lane(u, 2))


class Velocity(NamedTuple):
    """Make velocities of momentum; what was the velocity moves to the acceleration's place.

    Arrays: nodes, those of `driven`.
    """

    planes: object
    motion: tuple  # velocity of a plane that moves
    drives: bool  # whether its nodes take it
    driven: object
    after: bool  # whether prescribed velocities are those after the step, or before it


@at_node.register(Velocity)
def velocity(work, node, a):
    nodes, driven = a
    at = node.number * LANES
    r = load(node.sums, node.at)
    m = lane(r, 0)
    if not m > 0.0:
        store(nodes, at, splat(0.0))
        return
    w = 1.0 / m
    vx, vy, vz = lane(r, 1) * w, lane(r, 2) * w, lane(r, 3) * w
    if node.bounded:
        i, j, k, V, drives = node.i, node.j, node.k, work.motion, work.drives
        vx, vy, vz = constrain(work.planes, node.mesh, i, j, k, vx, vy, vz, V, drives)
    vx = prescribe(work.driven, driven, node.number, 0, work.after, vx)
    vy = prescribe(work.driven, driven, node.number, 1, work.after, vy)
    vz = prescribe(work.driven, driven, node.number, 2, work.after, vz)
    u = load(nodes, at)
    store(nodes, at, pack(vx, vy, vz, lane(u, 0), lane(u, 1), lane(u, 2), m, 0.0))
