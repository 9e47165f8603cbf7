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
def extents(mesh, half, p):
    """Return the half-sizes of particle p [m]."""
    l = half_size(half, p)
    return lane(l, 0) * mesh.hx, lane(l, 1) * mesh.hy, lane(l, 2) * mesh.hz


@inlined
def put(a, p, column, factor, x, y, z):
    """Write a multiple of a vector to three columns of row p of a table."""
    a[p, column], a[p, column + 1], a[p, column + 2] = factor * x, factor * y, factor * z


@inlined
def level_of(shape, mesh, origin, offset, half, level, s, x, p):
    """Return the distance of particle p that it gathers and its gradient, in tile s of `level`."""
    S = width(shape)
    row = SIDE + S
    X = load_row(x, p)
    if offset is not None:
        X = X - pack4(offset[0], offset[1], offset[2], 0.0)
    g = in_block(mesh, origin, X)
    first = min(max(truncate(g - 0.5 * (S - 2)), 0.0), 1.0 * SIDE)
    w = stencil(shape, g - first - 0.5 * (S - 1), half_size(half, p))
    n = (lane(first, 0) * row + lane(first, 1)) * row + lane(first, 2)
    d, gx, gy, gz = level_at(
        level, s * row * row * row + int(n), row, along(w, 0), along(w, 1), along(w, 2)
    )
    return d, gx * mesh.ix, gy * mesh.iy, gz * mesh.iz


@inlined
def gap_of(mesh, half, d, nx, ny, nz, q, p):
    """Return the gap of particle p [m] with the normal n, from its distance d of slope q."""
    l = half_size(half, p)
    ex, ey, ez = nx * lane(l, 0) * mesh.hx, ny * lane(l, 1) * mesh.hy, nz * lane(l, 2) * mesh.hz
    return (d - (ex * ex + ey * ey + ez * ez) ** 0.5) / q


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
    size = row * row * row
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
                if due[p] == TOUCHING:
                    forces[p] = 0.0
                d, nx, ny, nz = level_of(shape, mesh, ground, offset, half, level, s, x, p)
                q = (nx * nx + ny * ny + nz * nz) ** 0.5
                nx, ny, nz = nx / q, ny / q, nz / q
                gap = gap_of(mesh, half, d, nx, ny, nz, q, p)
                due[p] = way + max(gap, -d - contact.D, 0.0)
                if abs(d) <= contact.D and q > EVEN and gap <= step:
                    if not is_copied:
                        copy_tile(nodes, above, b, row, tile)
                        is_copied = True
                        if some[s] == 0:
                            mass[s * size : (s + 1) * size] = 0.0
                    if meet(
                        shape, mesh, origin, half, motion, dt, s * size, tile, x, m, gap, nx, ny,
                        nz, forces, mass, p,
                    ):  # fmt: skip
                        due[p] = TOUCHING
                        some[s] = 1


@inlined
def meet(
    shape, mesh, origin, half, motion, dt, first, tile, x, m, gap, nx, ny, nz, forces, mass, p
):
    """Tell whether particle p, at the ground, touches it; if so, leave what it wants."""
    row = SIDE + width(shape) - 1
    at, wx, wy, wz = locate(shape, mesh, origin, half, x, p)
    u = collect_value(tile, at, row, wx, wy, wz)
    ux, uy, uz = lane(u, 0) - motion[0], lane(u, 1) - motion[1], lane(u, 2) - motion[2]
    speed = ux * nx + uy * ny + uz * nz
    wanted = max(-speed - max(gap, 0.0) / dt, 0.0)
    if not (wanted > 0.0 or gap < 0.0):
        return False
    put(forces, p, NORMAL, wanted, nx, ny, nz)
    put(forces, p, TANGENT, 1.0, ux - speed * nx, uy - speed * ny, uz - speed * nz)
    put(forces, p, PUSH, max(-gap, 0.0), nx, ny, nz)
    if wanted > 0.0:
        n0 = first + at // LANES
        for i in range(len(wx) // 2):
            for j in range(len(wx) // 2):
                w = wx[i] * wy[j] * m[p]
                n = n0 + (i * row + j) * row
                for k in range(len(wx) // 2):
                    mass[np.uintp(n + k)] += w * wz[k]  # spares the test for a negative index
    return True
