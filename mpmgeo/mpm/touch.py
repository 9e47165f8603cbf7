"""Contact of particles with the ground: found at the particles, put on the nodes.

With d = Σ S d_I the distance that a particle gathers, n = ∇d/|∇d| and ℓ its half-size along n, the
particle's gap is g = (d − ℓ)/|∇d|. It touches if its velocity v = Σ S v_I, relative to the ground,
would close the gap within the step; then the impulses

    J_n = m/r (−v·n − max(g, 0)/Δt) n,    J_t = −m/r v_t  limited to  |J_t| ≤ μ |J_n|

take from the nodes what closes it: v_I += Σ S J/m_I. r = Σ S (Σ_t S m_t)/m_I, the sum over all
touching particles t, is what a particle would notice of a unit impulse m on every one of them, so
a layer that touches evenly ends exactly at the ground, and no other layer goes too far. Since the
nodes know the force, as they know any other, particles get it as acceleration, strains see it, and
momentum is balanced. What still overlaps is moved out along n.

The impulses stand for the force J/h on the particle, h the step of velocities.

A particle with a gap need not be looked at until the nodes near the ground have moved so far.
"""

import numpy as np
from numba import prange

from mpmgeo.mpm.ground import level_at, tile_origin
from mpmgeo.mpm.tile import block_origin, collect_value, copy_tile, half_size, in_block, locate
from mpmgeo.numerics.jit import blockwise, inlined
from mpmgeo.numerics.simd import LANES, along, lane, load_row, pack4, truncate
from mpmgeo.shapes.shape import stencil, width
from mpmgeo.state.grid import SIDE

NORMAL, TANGENT, PUSH = 0, 3, 6  # columns of a particle's contact: two forces, one displacement
TOUCHING = -1.0  # what stands for the way of a particle in contact
EVEN = 0.1  # |∇d| below which opposite surfaces are so near that there is no normal


@inlined
def put(a, p, column, factor, x, y, z):
    """Write a multiple of a vector to three columns of row p of a table."""
    a[p, column], a[p, column + 1], a[p, column + 2] = factor * x, factor * y, factor * z


@inlined
def locate_both(shape, mesh, origin, offset, half, x, p):
    """Return where particle p's nodes begin in its tile of distances and in that of the grid, and
    its stencils; the second place and the stencils are the grid's only if `offset` is None.
    """
    S = width(shape)
    X, last = load_row(x, p), SIDE - 1.0
    if offset is not None:
        X, last = X - pack4(offset[0], offset[1], offset[2], 0.0), 1.0 * SIDE
    g = in_block(mesh, origin, X)
    first = min(max(truncate(g - 0.5 * (S - 2)), 0.0), last)
    w = stencil(shape, g - first - 0.5 * (S - 1), half_size(half, p))
    i, j, k = int(lane(first, 0)), int(lane(first, 1)), int(lane(first, 2))
    long, row = SIDE + S, SIDE + S - 1
    at = ((i * row + j) * row + k) * LANES
    return (i * long + j) * long + k, at, along(w, 0), along(w, 1), along(w, 2)


@inlined
def gap_of(mesh, half, d, nx, ny, nz, w, p):
    """Return the gap of particle p [m] with the normal n, from its distance d of slope 1/w."""
    l = half_size(half, p)
    ex, ey, ez = nx * lane(l, 0) * mesh.hx, ny * lane(l, 1) * mesh.hy, nz * lane(l, 2) * mesh.hz
    return (d - (ex * ex + ey * ey + ez * ez) ** 0.5) * w


@blockwise
def detect(
    shape, mesh, contact, first, way, step, dt, offset, motion, shift, level, chunk, near, start,
    corner, above, nodes, scratch, half, x, m, due, forces, mass, some,
):  # fmt: skip
    """Find the particles that touch, and add their mass to the tiles; `first` empties these.

    `way`, `step`: how far nodes near the ground have moved at most so far, and will in this step;
    `offset`, `motion`: displacement, None for none, and velocity of the ground. `forces` get the
    velocities to take away along and across the normal, and the displacement out of the ground;
    `some`: whether anything in a block touches.
    """
    row = SIDE + width(shape) - 1
    size, long, rate = row**3, (row + 1) ** 3, 1.0 / dt
    for c in prange(len(chunk) - 1):
        tile = scratch[c * size * LANES : (c + 1) * size * LANES]
        for s in range(chunk[c], chunk[c + 1]):
            if first:
                some[s] = 0
            b = near[s]
            is_copied = False
            origin, ground = block_origin(mesh, corner, b), tile_origin(mesh, corner, b, shift)
            for p in range(start[b], start[b + 1]):
                if due[p] > way + step:
                    continue
                n, at, wx, wy, wz = locate_both(shape, mesh, ground, offset, half, x, p)
                d, gx, gy, gz = level_at(level, s * long + n, row + 1, wx, wy, wz)
                gx, gy, gz = gx * mesh.ix, gy * mesh.iy, gz * mesh.iz
                square = gx * gx + gy * gy + gz * gz
                w = 1.0 / square**0.5
                nx, ny, nz = w * gx, w * gy, w * gz
                gap = gap_of(mesh, half, d, nx, ny, nz, w, p)
                was_touching, touches = due[p] == TOUCHING, False
                if abs(d) <= contact.D and square > EVEN * EVEN and gap <= step:
                    if not is_copied:
                        copy_tile(nodes, above, b, row, tile)
                        is_copied = True
                        if some[s] == 0:
                            mass[s * size : (s + 1) * size] = 0.0
                    if offset is not None:
                        at, wx, wy, wz = locate(shape, mesh, origin, half, x, p)
                    u = collect_value(tile, at, row, wx, wy, wz)
                    wanted = want(u, motion, gap, rate, nx, ny, nz, forces, p)
                    touches = wanted > 0.0 or gap < 0.0
                    if wanted > 0.0:
                        add_mass(mass, s * size + at // LANES, row, wx, wy, wz, m[p])
                due[p] = TOUCHING if touches else way + max(gap, -d - contact.D, 0.0)
                if touches:
                    some[s] = 1
                elif was_touching:
                    put(forces, p, NORMAL, 0.0, 0.0, 0.0, 0.0)
                    put(forces, p, TANGENT, 0.0, 0.0, 0.0, 0.0)
                    put(forces, p, PUSH, 0.0, 0.0, 0.0, 0.0)


@inlined
def want(u, motion, gap, rate, nx, ny, nz, forces, p):
    """Return the speed that closes the gap too fast; if particle p touches, leave what it wants.

    `u`: gathered record of nodes, `rate`: 1/Δt.
    """
    ux, uy, uz = lane(u, 0) - motion[0], lane(u, 1) - motion[1], lane(u, 2) - motion[2]
    speed = ux * nx + uy * ny + uz * nz
    wanted = max(-speed - max(gap, 0.0) * rate, 0.0)
    if wanted > 0.0 or gap < 0.0:
        put(forces, p, NORMAL, wanted, nx, ny, nz)
        put(forces, p, TANGENT, 1.0, ux - speed * nx, uy - speed * ny, uz - speed * nz)
        put(forces, p, PUSH, max(-gap, 0.0), nx, ny, nz)
    return wanted


@inlined
def add_mass(mass, n0, row, wx, wy, wz, m):
    """Add S m to the nodes from n0 on."""
    S = len(wx) // 2
    for i in range(S):
        for j in range(S):
            w = wx[i] * wy[j] * m
            n = n0 + (i * row + j) * row
            for k in range(S):
                mass[np.uintp(n + k)] += w * wz[k]  # an index that cannot be negative costs less
