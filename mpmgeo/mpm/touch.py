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
"""

import numpy as np
from numba import prange

from mpmgeo.mpm.ground import STARTS, first_of, level_at, tile_origin
from mpmgeo.mpm.tile import block_origin, collect_value, copy_tile, half_size, in_block, locate
from mpmgeo.numerics.jit import blockwise, inlined
from mpmgeo.numerics.simd import LANES, along, lane, load_row, pack4, truncate
from mpmgeo.shapes.shape import stencil, width
from mpmgeo.state.grid import SIDE

NORMAL, TANGENT, PUSH = 0, 3, 6  # columns of a particle's contact: two forces, one displacement
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
def bounds(mesh, contact, half, v, motion, dt, p):
    """Return how far from touching particle p may be, and the distance that goes with it [m].

    From its own velocity, before that of the nodes is gathered.
    """
    lx, ly, lz = extents(mesh, half, p)
    ux, uy, uz = v[p, 0] - motion[0], v[p, 1] - motion[1], v[p, 2] - motion[2]
    slack = 2.0 * dt * (ux * ux + uy * uy + uz * uz) ** 0.5 + 0.01 * (lx + ly + lz)
    return slack, min(contact.D, max(lx, ly, lz) + slack)


@inlined
def first_node(shape, mesh, origin, offset, x, p):
    """Return where particle p is in its tile of distances, in cells, and its first node there."""
    X = load_row(x, p)
    if offset is not None:
        X = X - pack4(offset[0], offset[1], offset[2], 0.0)
    g = in_block(mesh, origin, X)
    return g, min(max(truncate(g - 0.5 * (width(shape) - 2)), 0.0), 1.0 * SIDE)


@inlined
def level_of(shape, mesh, half, level, s, g, first, p):
    """Return the distance of particle p that it gathers and its gradient, in tile s of `level`."""
    S = width(shape)
    row = SIDE + S
    w = stencil(shape, g - first - 0.5 * (S - 1), half_size(half, p))
    n = (lane(first, 0) * row + lane(first, 1)) * row + lane(first, 2)
    d, gx, gy, gz = level_at(
        level, s * row * row * row + int(n), row, along(w, 0), along(w, 1), along(w, 2)
    )
    return d, gx * mesh.ix, gy * mesh.iy, gz * mesh.iz


@inlined
def gap_of(mesh, half, d, nx, ny, nz, q, p):
    """Return the gap of particle p [m] with the normal n, from its distance d of slope q."""
    lx, ly, lz = extents(mesh, half, p)
    ex, ey, ez = nx * lx, ny * ly, nz * lz
    return (d - (ex * ex + ey * ey + ez * ez) ** 0.5) / q


@inlined
def candidates(
    shape, mesh, contact, ground, offset, motion, dt, lowest, s, first, last, half, x, v,
    touching, forces, chosen,
):  # fmt: skip
    """List the particles from `first` to `last` that may touch; return how many they are.

    Two bounds that cost little: nobody moves by more than a cell in a step, or by more than its
    own velocity lets expect.
    """
    count = 0
    nearby = 1.5 * max(mesh.hx, mesh.hy, mesh.hz)
    for p in range(first, last):
        if touching[p] != 0:
            touching[p] = 0
            forces[p] = 0.0
        _, node = first_node(shape, mesh, ground, offset, x, p)
        low = lowest[np.uintp(s * STARTS**3 + first_of(node))]
        if low <= nearby:
            _, bound = bounds(mesh, contact, half, v, motion, dt, p)
            if low <= bound:
                chosen[count] = p
                count += 1
    return count


@blockwise
def detect(
    shape, mesh, contact, first, dt, offset, motion, shift, level, lowest, chunk, near, start,
    corner, above, nodes, scratch, half, x, v, m, touching, forces, mass, some,
):  # fmt: skip
    """Find the particles that touch, and add their mass to the tiles; `first` empties these.

    `offset`, `motion`: displacement, None for none, and velocity of the ground. `forces` get the
    velocities to take away along and across the normal, and the displacement out of the ground;
    `some`: whether anything in a block touches.
    """
    row = SIDE + width(shape) - 1
    size = row * row * row
    for c in prange(len(chunk) - 1):
        tile = scratch[c * size * LANES : (c + 1) * size * LANES]
        most = 0
        for s in range(chunk[c], chunk[c + 1]):
            most = max(most, start[near[s] + 1] - start[near[s]])
            some[s] = 0 if first else some[s]
        chosen = np.empty(most, np.int64)
        for s in range(chunk[c], chunk[c + 1]):
            b = near[s]
            ground = tile_origin(mesh, corner, b, shift)
            count = candidates(
                shape, mesh, contact, ground, offset, motion, dt, lowest, s, start[b],
                start[b + 1], half, x, v, touching, forces, chosen,
            )  # fmt: skip
            if count == 0:
                continue
            copy_tile(nodes, above, b, row, tile)
            if some[s] == 0:
                mass[s * size : (s + 1) * size] = 0.0
            origin = block_origin(mesh, corner, b)
            for i in range(count):
                p = chosen[i]
                slack, _ = bounds(mesh, contact, half, v, motion, dt, p)
                g, node = first_node(shape, mesh, ground, offset, x, p)
                d, nx, ny, nz = level_of(shape, mesh, half, level, s, g, node, p)
                q = (nx * nx + ny * ny + nz * nz) ** 0.5
                nx, ny, nz = nx / q, ny / q, nz / q
                gap = gap_of(mesh, half, d, nx, ny, nz, q, p)
                if abs(d) <= contact.D and q > EVEN and gap <= slack / q:
                    touching[p] = meet(
                        shape, mesh, origin, half, motion, dt, s * size, tile, x, m, gap, nx, ny,
                        nz, forces, mass, p,
                    )  # fmt: skip
                    some[s] |= touching[p]


@inlined
def meet(
    shape, mesh, origin, half, motion, dt, first, tile, x, m, gap, nx, ny, nz, forces, mass, p
):
    """Return 1 if particle p, at the ground, touches it, and leave what it wants; else 0."""
    row = SIDE + width(shape) - 1
    at, wx, wy, wz = locate(shape, mesh, origin, half, x, p)
    u = collect_value(tile, at, row, wx, wy, wz)
    ux, uy, uz = lane(u, 0) - motion[0], lane(u, 1) - motion[1], lane(u, 2) - motion[2]
    speed = ux * nx + uy * ny + uz * nz
    wanted = max(-speed - max(gap, 0.0) / dt, 0.0)
    if not (wanted > 0.0 or gap < 0.0):
        return 0
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
    return 1
