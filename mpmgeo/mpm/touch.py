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

from numba import prange

from mpmgeo.boundaries.planes import constrain
from mpmgeo.mpm.grid_update import is_bounded
from mpmgeo.mpm.ground import first_of, level_at, tile_origin
from mpmgeo.mpm.tile import (
    block_bounds,
    block_origin,
    collect_value,
    copy_tile,
    half_size,
    in_block,
    locate,
)
from mpmgeo.numerics.jit import blockwise, inlined
from mpmgeo.numerics.simd import (
    LANES,
    add,
    along,
    axpy,
    lane,
    load,
    load_row,
    pack,
    pack4,
    scale,
    store,
    store_row,
    truncate,
    within,
)
from mpmgeo.shapes.shape import stencil, width
from mpmgeo.state.grid import NODES, SIDE

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
def level_of(shape, mesh, origin, half, level, lowest, s, bound, offset, x, p):
    """Return the distance of particle p that it gathers and its gradient, in tile s of `level`.

    FAR instead if all distances under its stencil are above `bound` [m].
    """
    S = width(shape)
    row = SIDE + S
    g = in_block(mesh, origin, load_row(x, p) - pack4(offset[0], offset[1], offset[2], 0.0))
    first = min(max(truncate(g - 0.5 * (S - 2)), 0.0), 1.0 * SIDE)
    if not lowest[s * (SIDE + 1) ** 3 + first_of(first)] <= bound:
        return 1e30, 0.0, 0.0, 0.0
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


@blockwise
def detect(
    shape, mesh, contact, first, dt, offset, motion, shift, level, lowest, chunk, near, start,
    corner, above, nodes, scratch, half, x, v, m, touching, forces, mass, some,
):  # fmt: skip
    """Find the particles that touch, and add their mass to the tiles; `first` empties these.

    `offset`, `motion`: displacement and velocity of the ground. `forces` get the velocities to
    take away along and across the normal and the displacement out of the ground; `some`: whether
    anything in a block touches.
    """
    row = SIDE + width(shape) - 1
    size = row * row * row
    for c in prange(len(chunk) - 1):
        tile = scratch[c * size * LANES : (c + 1) * size * LANES]
        for s in range(chunk[c], chunk[c + 1]):
            b = near[s]
            if first:
                some[s] = 0
            is_copied = False
            origin, ground = block_origin(mesh, corner, b), tile_origin(mesh, corner, b, shift)
            for p in range(start[b], start[b + 1]):
                was, touching[p] = touching[p], 0
                slack, bound = bounds(mesh, contact, half, v, motion, dt, p)
                d, nx, ny, nz = level_of(
                    shape, mesh, ground, half, level, lowest, s, bound, offset, x, p
                )
                q = (nx * nx + ny * ny + nz * nz) ** 0.5
                if abs(d) <= contact.D and q > EVEN:
                    nx, ny, nz = nx / q, ny / q, nz / q
                    gap = gap_of(mesh, half, d, nx, ny, nz, q, p)
                    if gap <= slack / q:
                        if not is_copied:
                            copy_tile(nodes, above, b, row, tile)
                            is_copied = True
                        if some[s] == 0:
                            mass[s * size : (s + 1) * size] = 0.0
                            some[s] = 1
                        touching[p] = meet(
                            shape, mesh, origin, half, motion, dt, s * size, tile, x, m,
                            gap, nx, ny, nz, forces, mass, p,
                        )  # fmt: skip
                if was != 0 and touching[p] == 0:
                    forces[p] = 0.0


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
                    mass[n + k] += w * wz[k]
    return 1


@blockwise
def share(shape, chunk, active, below, some, mass, nodes, part):
    """Write which part of the nodes' mass touches, for the blocks of nodes `active`."""
    row = SIDE + width(shape) - 1
    reach = 1 + (width(shape) + SIDE - 2) // SIDE
    for c in prange(len(chunk) - 1):
        for a in range(chunk[c], chunk[c + 1]):
            part[a * NODES : (a + 1) * NODES] = 0.0
            for o in range(reach * reach * reach):
                s = below[a, o]
                if s < 0 or some[s] == 0:
                    continue
                i0, j0, k0 = o // (reach * reach) * SIDE, o // reach % reach * SIDE, o % reach * SIDE
                for i in range(min(SIDE, row - i0)):
                    for j in range(min(SIDE, row - j0)):
                        n = ((s * row + i + i0) * row + j + j0) * row + k0
                        for k in range(min(SIDE, row - k0)):
                            part[a * NODES + (i * SIDE + j) * SIDE + k] += mass[n + k]
            for n in range(NODES):
                m = nodes[(active[a] * NODES + n) * LANES + 6]
                part[a * NODES + n] = part[a * NODES + n] / m if m > 0.0 else 0.0


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
                            tile[at + k] = part[source + k]


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
                q += wz[k] * tile[n + k]
            r += wx[i] * wy[j] * q
    return r


@blockwise
def press(
    shape, mesh, contact, first, h, dt, chunk, near, around, start, corner, half, x, m, touching,
    forces, some, part, scratch, impulse,
):  # fmt: skip
    """Add the impulses of the touching particles to the tiles, leave their forces."""
    row = SIDE + width(shape) - 1
    size = row * row * row
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
                if touching[p] == 0:
                    continue
                at, wx, wy, wz = locate(shape, mesh, origin, half, x, p)
                at //= LANES
                r = collect_part(tile, at, row, wx, wy, wz)
                q = m[p] / r if r > 0.0 else 0.0
                # the spring may not throw a particle out faster than to the surface in a step
                k = min(contact.k * h, m[p] / dt)
                jx = q * forces[p, NORMAL] + k * forces[p, PUSH]
                jy = q * forces[p, NORMAL + 1] + k * forces[p, PUSH + 1]
                jz = q * forces[p, NORMAL + 2] + k * forces[p, PUSH + 2]
                tx, ty, tz = forces[p, TANGENT], forces[p, TANGENT + 1], forces[p, TANGENT + 2]
                most = contact.μ * (jx * jx + jy * jy + jz * jz) ** 0.5
                t = q * (tx * tx + ty * ty + tz * tz) ** 0.5
                q = -q * most / t if t > most else -q
                put(forces, p, NORMAL, 1.0 / h, jx, jy, jz)
                put(forces, p, TANGENT, q / h, tx, ty, tz)
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
        for a in range(chunk[c], chunk[c + 1]):
            if not sum_impulses(impulse, below, some, a, row, reach, sums):
                continue
            b = active[a]
            I, J, K = active_corner[b, 0], active_corner[b, 1], active_corner[b, 2]
            bounded = is_bounded(mesh, I, J, K)
            for n in range(NODES):
                at = (b * NODES + n) * LANES
                u = load(nodes, at)
                m = lane(u, 6)
                if not m > 0.0:
                    continue
                vx, vy, vz = sums[n, 0] / m, sums[n, 1] / m, sums[n, 2] / m
                if bounded:
                    i, j, k = I * SIDE + n // 16, J * SIDE + n // 4 % 4, K * SIDE + n % 4
                    vx, vy, vz = constrain(
                        planes, mesh, i, j, k, vx, vy, vz, (0.0, 0.0, 0.0), True
                    )
                if owner is not None:
                    t = owner[b * NODES + n]
                    if t >= 0:
                        vx = 0.0 if given[t, 0] > 0.0 else vx
                        vy = 0.0 if given[t, 1] > 0.0 else vy
                        vz = 0.0 if given[t, 2] > 0.0 else vz
                q = 1.0 / h
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
def move_out(shape, mesh, chunk, near, start, corner, x, touching, forces, some):
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
                if touching[p] == 0:
                    continue
                ux, uy, uz = forces[p, PUSH], forces[p, PUSH + 1], forces[p, PUSH + 2]
                X = load_row(x, p) + pack4(ux, uy, uz, 0.0)
                store_row(x, p, X)
                if not within(in_block(mesh, origin, X), low, high):
                    gone += 1
    return gone
