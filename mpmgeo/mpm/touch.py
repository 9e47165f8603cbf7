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
from mpmgeo.mpm.grid_update import is_bounded, sum_tiles
from mpmgeo.mpm.ground import first_of, level_at, tile_origin
from mpmgeo.mpm.tile import (
    block_bounds,
    block_origin,
    collect_value,
    copy_tile,
    deposit_value,
    half_size,
    in_block,
    locate,
)
from mpmgeo.numerics.jit import blockwise, inlined
from mpmgeo.numerics.simd import (
    LANES,
    along,
    lane,
    load,
    load_row,
    pack,
    pack4,
    store,
    store_row,
    truncate,
    within,
)
from mpmgeo.shapes.shape import stencil, width
from mpmgeo.state.grid import NODES, SIDE

NORMAL, TANGENT, PUSH = 0, 3, 6  # columns of a particle's contact: two forces, one displacement
EVEN = 0.1  # |∇d| below which opposite surfaces are so near that there is no normal
SPARE = 7  # lane of a node's record


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
    corner, above, nodes, scratch, half, x, v, m, touching, forces, tiles, some,
):  # fmt: skip
    """Find the particles that touch, and put their mass into the tiles; `first` empties these.

    `offset`, `motion`: displacement and velocity of the ground. `forces` get the velocities to
    take away along and across the normal and the displacement out of the ground; `some`: whether
    anything in a block touches.
    """
    row = SIDE + width(shape) - 1
    size = row * row * row * LANES
    for c in prange(len(chunk) - 1):
        tile = scratch[c * size : (c + 1) * size]
        for s in range(chunk[c], chunk[c + 1]):
            b = near[s]
            if first:
                tiles[b * size : (b + 1) * size] = 0.0
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
                nx, ny, nz = nx / q, ny / q, nz / q
                gap = gap_of(mesh, half, d, nx, ny, nz, q, p)
                if abs(d) <= contact.D and q > EVEN and gap <= slack / q:
                    if not is_copied:
                        copy_tile(nodes, above, b, row, tile)
                        is_copied = True
                    at, wx, wy, wz = locate(shape, mesh, origin, half, x, p)
                    u = collect_value(tile, at, row, wx, wy, wz)
                    ux, uy, uz = lane(u, 0) - motion[0], lane(u, 1) - motion[1], lane(u, 2) - motion[2]
                    speed = ux * nx + uy * ny + uz * nz
                    wanted = max(-speed - max(gap, 0.0) / dt, 0.0)
                    if wanted > 0.0 or gap < 0.0:
                        touching[p] = some[s] = 1
                        put(forces, p, NORMAL, wanted, nx, ny, nz)
                        ux, uy, uz = ux - speed * nx, uy - speed * ny, uz - speed * nz
                        put(forces, p, TANGENT, 1.0, ux, uy, uz)
                        put(forces, p, PUSH, max(-gap, 0.0), nx, ny, nz)
                    if wanted > 0.0:
                        mass = pack(m[p], 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
                        deposit_value(tiles, b * size + at, row, wx, wy, wz, mass)
                if was != 0 and touching[p] == 0:
                    forces[p] = 0.0


@blockwise
def share(shape, chunk, active, below, tiles, scratch, nodes):
    """Write into the nodes which share of their mass touches, in the spare lane."""
    row = SIDE + width(shape) - 1
    reach = 1 + (width(shape) + SIDE - 2) // SIDE
    for c in prange(len(chunk) - 1):
        first = c * row * row * row * LANES
        for a in range(chunk[c], chunk[c + 1]):
            sum_tiles(tiles, below, a, row, reach, scratch, first)
            for n in range(NODES):
                at = (active[a] * NODES + n) * LANES
                m = nodes[at + 6]
                nodes[at + SPARE] = scratch[first + n * LANES] / m if m > 0.0 else 0.0


@blockwise
def press(
    shape, mesh, contact, h, dt, chunk, near, start, corner, above, nodes, scratch, half, x, m,
    touching, forces, tiles, some,
):  # fmt: skip
    """Put the impulses of the touching particles into the tiles, leave their forces."""
    row = SIDE + width(shape) - 1
    size = row * row * row * LANES
    for c in prange(len(chunk) - 1):
        tile = scratch[c * size : (c + 1) * size]
        for s in range(chunk[c], chunk[c + 1]):
            if some[s] == 0:
                continue
            b = near[s]
            copy_tile(nodes, above, b, row, tile)
            origin = block_origin(mesh, corner, b)
            for p in range(start[b], start[b + 1]):
                if touching[p] == 0:
                    continue
                at, wx, wy, wz = locate(shape, mesh, origin, half, x, p)
                r = lane(collect_value(tile, at, row, wx, wy, wz), SPARE)
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
                J = pack(0.0, 0.0, 0.0, 0.0, jx + q * tx, jy + q * ty, jz + q * tz, 0.0)
                deposit_value(tiles, b * size + at, row, wx, wy, wz, J)


@blockwise
def push(
    shape, mesh, planes, owner, given, h, chunk, active, active_corner, below, tiles, scratch, nodes
):
    """Change velocity and acceleration of the nodes by the impulses, as planes and tools allow."""
    row = SIDE + width(shape) - 1
    reach = 1 + (width(shape) + SIDE - 2) // SIDE
    still = (0.0, 0.0, 0.0)
    for c in prange(len(chunk) - 1):
        first = c * row * row * row * LANES
        for a in range(chunk[c], chunk[c + 1]):
            sum_tiles(tiles, below, a, row, reach, scratch, first)
            b = active[a]
            I, J, K = active_corner[b, 0], active_corner[b, 1], active_corner[b, 2]
            bounded = is_bounded(mesh, I, J, K)
            for n in range(NODES):
                at = (b * NODES + n) * LANES
                r, u = load(scratch, first + n * LANES), load(nodes, at)
                m = lane(u, 6)
                if not m > 0.0:
                    continue
                vx, vy, vz = lane(r, 4) / m, lane(r, 5) / m, lane(r, 6) / m
                if bounded:
                    i, j, k = I * SIDE + n // 16, J * SIDE + n // 4 % 4, K * SIDE + n % 4
                    vx, vy, vz = constrain(planes, mesh, i, j, k, vx, vy, vz, still, True)
                if owner is not None:
                    t = owner[b * NODES + n]
                    if t >= 0:
                        vx, vy, vz = (
                            vx * (1.0 - given[t, 0]),
                            vy * (1.0 - given[t, 1]),
                            vz * (1.0 - given[t, 2]),
                        )
                ax, ay, az = lane(u, 3) + vx / h, lane(u, 4) + vy / h, lane(u, 5) + vz / h
                vx, vy, vz = lane(u, 0) + vx, lane(u, 1) + vy, lane(u, 2) + vz
                store(nodes, at, pack(vx, vy, vz, ax, ay, az, m, 0.0))


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
