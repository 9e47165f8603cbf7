"""Contact of particles with the ground, put on the nodes: see `touch` for the equations."""

import numpy as np
from numba import prange

from mpmgeo.boundaries.planes import constrain
from mpmgeo.mpm.grid_update import is_bounded
from mpmgeo.mpm.tile import block_bounds, block_origin, in_block, locate
from mpmgeo.mpm.touch import NORMAL, PUSH, TANGENT, TOUCHING, put
from mpmgeo.numerics.jit import blockwise, inlined
from mpmgeo.numerics.simd import (
    LANES,
    add,
    axpy,
    lane,
    load,
    load_row,
    pack,
    pack4,
    scale,
    store,
    store_row,
    within,
)
from mpmgeo.shapes.shape import width
from mpmgeo.state.grid import NODES, SIDE


@blockwise
def fastest(chunk, active, nodes, least, motion, speed):
    """Write the greatest speed of nodes relative to the ground, for every chunk of blocks.

    Nodes of less than the `least` mass do not count: particles hardly notice them.
    """
    for c in prange(len(chunk) - 1):
        most = 0.0
        for a in range(chunk[c], chunk[c + 1]):
            for n in range(active[a] * NODES, (active[a] + 1) * NODES):
                u = load(nodes, n * LANES)
                x, y, z = lane(u, 0) - motion[0], lane(u, 1) - motion[1], lane(u, 2) - motion[2]
                if lane(u, 6) > least:
                    most = max(most, x * x + y * y + z * z)
        speed[c] = most**0.5


@blockwise
def share(shape, chunk, active, below, some, mass, nodes, part):
    """Write which part of the nodes' mass touches, for blocks of nodes under tiles that touch."""
    row = SIDE + width(shape) - 1
    reach = 1 + (width(shape) + SIDE - 2) // SIDE
    for c in prange(len(chunk) - 1):
        for a in range(chunk[c], chunk[c + 1]):
            found = False
            for o in range(reach * reach * reach):
                s = below[a, o]
                if s < 0 or some[s] == 0:
                    continue
                if not found:
                    part[a * NODES : (a + 1) * NODES] = 0.0
                    found = True
                i0, j0, k0 = (
                    o // (reach * reach) * SIDE,
                    o // reach % reach * SIDE,
                    o % reach * SIDE,
                )
                for i in range(min(SIDE, row - i0)):
                    for j in range(min(SIDE, row - j0)):
                        n = ((s * row + i + i0) * row + j + j0) * row + k0
                        for k in range(min(SIDE, row - k0)):
                            at = a * NODES + (i * SIDE + j) * SIDE + k
                            part[np.uintp(at)] += mass[np.uintp(n + k)]
            for n in range(NODES if found else 0):
                if part[a * NODES + n] > 0.0:
                    part[a * NODES + n] /= nodes[(active[a] * NODES + n) * LANES + 6]


@inlined
def copy_part(part, around, s, row, tile):
    """Copy the parts of mass that touch, at the nodes under tile s, into a tile."""
    reach = (row + SIDE - 1) // SIDE
    for di in range(reach):
        for dj in range(reach):
            for dk in range(reach):
                block = around[s, (di * reach + dj) * reach + dk] * NODES
                i0, j0, k0 = SIDE * di, SIDE * dj, SIDE * dk
                for i in range(min(SIDE, row - i0)):
                    for j in range(min(SIDE, row - j0)):
                        source = block + (i * SIDE + j) * SIDE
                        at = ((i + i0) * row + j + j0) * row + k0
                        for k in range(min(SIDE, row - k0)):
                            tile[np.uintp(at + k)] = part[np.uintp(source + k)]


@inlined
def collect_part(tile, n0, row, wx, wy, wz):
    """Return Σ S of numbers at the nodes from n0 on."""
    S = len(wx) // 2
    r = 0.0
    for i in range(S):
        for j in range(S):
            n = n0 + (i * row + j) * row
            q = 0.0
            for k in range(S):
                q += wz[k] * tile[np.uintp(n + k)]
            r += wx[i] * wy[j] * q
    return r


@blockwise
def press(
    shape, mesh, contact, first, h, dt, chunk, near, around, start, corner, half, x, m, due,
    forces, some, part, scratch, impulse,
):  # fmt: skip
    """Add the impulses of the touching particles to the tiles, leave their forces."""
    row = SIDE + width(shape) - 1
    size, w, rate = row * row * row, 1.0 / h, 1.0 / dt
    for c in prange(len(chunk) - 1):
        tile = scratch[c * size * LANES : (c + 1) * size * LANES]
        for s in range(chunk[c], chunk[c + 1]):
            if some[s] == 0:
                continue
            b = near[s]
            copy_part(part, around, s, row, tile)
            if first:
                impulse[s * size : (s + 1) * size] = 0.0
            origin = block_origin(mesh, corner, b)
            for p in range(start[b], start[b + 1]):
                if due[p] != TOUCHING:
                    continue
                at, wx, wy, wz = locate(shape, mesh, origin, half, x, p)
                at //= LANES
                r = collect_part(tile, at, row, wx, wy, wz)
                q = m[p] / r if r > 0.0 else 0.0
                # the spring may not throw a particle out faster than to the surface in a step
                k = min(contact.k * h, m[p] * rate)
                jx = q * forces[p, NORMAL] + k * forces[p, PUSH]
                jy = q * forces[p, NORMAL + 1] + k * forces[p, PUSH + 1]
                jz = q * forces[p, NORMAL + 2] + k * forces[p, PUSH + 2]
                tx, ty, tz = forces[p, TANGENT], forces[p, TANGENT + 1], forces[p, TANGENT + 2]
                most = contact.μ * contact.μ * (jx * jx + jy * jy + jz * jz)
                t = q * q * (tx * tx + ty * ty + tz * tz)
                q = -q * (most / t) ** 0.5 if t > most else -q
                put(forces, p, NORMAL, w, jx, jy, jz)
                put(forces, p, TANGENT, w * q, tx, ty, tz)
                J = pack4(jx + q * tx, jy + q * ty, jz + q * tz, 0.0)
                add_impulse(impulse, s * size + at, row, wx, wy, wz, J)


@inlined
def add_impulse(impulse, n0, row, wx, wy, wz, J):
    """Add S J to the rows of the nodes from n0 on."""
    S = len(wx) // 2
    for i in range(S):
        for j in range(S):
            A = scale(wx[i] * wy[j], J)
            n = n0 + (i * row + j) * row
            for k in range(S):
                store_row(impulse, n + k, axpy(wz[k], A, load_row(impulse, n + k)))


@blockwise
def push(
    shape, mesh, planes, owner, given, h, chunk, active, active_corner, below, some, impulse,
    scratch, nodes,
):  # fmt: skip
    """Change velocity and acceleration of the nodes by the impulses, as planes and tools allow."""
    row = SIDE + width(shape) - 1
    reach = 1 + (width(shape) + SIDE - 2) // SIDE
    for c in prange(len(chunk) - 1):
        sums = scratch[c * row * row * row * LANES :][: NODES * 3].reshape(NODES, 3)
        q = 1.0 / h
        for a in range(chunk[c], chunk[c + 1]):
            if not sum_impulses(impulse, below, some, a, row, reach, sums):
                continue
            b = active[a]
            I, J, K = active_corner[b, 0], active_corner[b, 1], active_corner[b, 2]
            bounded = is_bounded(mesh, I, J, K)
            for n in range(NODES):
                vx, vy, vz = sums[n, 0], sums[n, 1], sums[n, 2]
                if vx == 0.0 and vy == 0.0 and vz == 0.0:
                    continue
                at = (b * NODES + n) * LANES
                u = load(nodes, at)
                m = lane(u, 6)
                if not m > 0.0:
                    continue
                w = 1.0 / m
                vx, vy, vz = w * vx, w * vy, w * vz
                if bounded:
                    i, j, k = I * SIDE + n // 16, J * SIDE + n // 4 % 4, K * SIDE + n % 4
                    vx, vy, vz = constrain(planes, mesh, i, j, k, vx, vy, vz, (0.0, 0.0, 0.0), True)
                if owner is not None:
                    t = owner[b * NODES + n]
                    if t >= 0:
                        vx = 0.0 if given[t, 0] > 0.0 else vx
                        vy = 0.0 if given[t, 1] > 0.0 else vy
                        vz = 0.0 if given[t, 2] > 0.0 else vz
                change = pack(vx, vy, vz, q * vx, q * vy, q * vz, 0.0, 0.0)
                store(nodes, at, add(u, change))


@inlined
def sum_impulses(impulse, below, some, a, row, reach, sums):
    """Sum the impulses of the tiles over a block of nodes; tell whether there are any."""
    found = False
    for o in range(reach * reach * reach):
        s = below[a, o]
        if s < 0 or some[s] == 0:
            continue
        if not found:
            sums[:] = 0.0
            found = True
        i0, j0, k0 = o // (reach * reach) * SIDE, o // reach % reach * SIDE, o % reach * SIDE
        for i in range(min(SIDE, row - i0)):
            for j in range(min(SIDE, row - j0)):
                n = ((s * row + i + i0) * row + j + j0) * row + k0
                for k in range(min(SIDE, row - k0)):
                    at = (i * SIDE + j) * SIDE + k
                    store_row(sums, at, load_row(sums, at) + load_row(impulse, n + k))
    return found


@blockwise
def move_out(shape, mesh, chunk, near, start, corner, x, due, forces, some):
    """Move overlapping particles out of the ground; return how many are outside their block."""
    gone = 0
    for c in prange(len(chunk) - 1):
        for s in range(chunk[c], chunk[c + 1]):
            if some[s] == 0:
                continue
            b = near[s]
            origin = block_origin(mesh, corner, b)
            low, high = block_bounds(shape, mesh, corner, b)
            for p in range(start[b], start[b + 1]):
                if due[p] != TOUCHING:
                    continue
                ux, uy, uz = forces[p, PUSH], forces[p, PUSH + 1], forces[p, PUSH + 2]
                X = load_row(x, p) + pack4(ux, uy, uz, 0.0)
                store_row(x, p, X)
                if not within(in_block(mesh, origin, X), low, high):
                    gone += 1
    return gone
