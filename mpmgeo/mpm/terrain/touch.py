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

from typing import NamedTuple

from numba.core.types import NoneType
from numba.extending import overload

from mpmgeo.mpm.core.loops import is_idle, visit
from mpmgeo.mpm.core.stencils import half_size, in_block, locate, stencils
from mpmgeo.mpm.core.tile import collect_value, deposit_value
from mpmgeo.mpm.terrain.ground import level_at, tile_origin
from mpmgeo.numerics.jit import INLINED, inlined
from mpmgeo.numerics.simd import LANES, lane, load_row, pack, pack4
from mpmgeo.state.layout import SIDE, place, volume

NORMAL, TANGENT, PUSH = 0, 3, 6  # columns of a particle's contact: two forces, one displacement
COLUMNS = 9
TOUCHING = -1.0  # what stands for the way of a particle in contact
EVEN = 0.1  # |∇d| below which opposite surfaces are so near that there is no normal


@inlined
def put(a, p, column, factor, x, y, z):
    """Write a multiple of a vector to three columns of row p of a table."""
    a[p, column], a[p, column + 1], a[p, column + 2] = factor * x, factor * y, factor * z


@inlined
def locate_both(here, shift, offset, p):
    """Return where particle p's nodes begin in its tile of distances and in that of the grid, and
    its stencils; the second place and the stencils are the grid's only if `offset` is None.
    """
    X, last = _relative(load_row(here.x, p), offset)
    g = in_block(here.mesh, tile_origin(here.mesh, here.corner, shift), X)
    first, wx, wy, wz = stencils(here.shape, here.half, walls_at(here, offset), g, last, p)
    i, j, k = int(lane(first, 0)), int(lane(first, 1)), int(lane(first, 2))
    return place(longer(here.rows), i, j, k), place(here.rows, i, j, k) * LANES, wx, wy, wz


@inlined
def _relative(X, offset):
    """Return a position relative to the ground, and the last place of the first node there."""
    if offset is None:
        return X, SIDE - 1.0
    return X - pack4(offset[0], offset[1], offset[2], 0.0), 1.0 * SIDE


def walls_at(here, offset):
    """Return where shapes end; ground that has moved has distances beyond the walls, too."""
    return here.walls if offset is None else None


@overload(walls_at, jit_options=INLINED)
def _walls_at(here, offset):
    if isinstance(offset, NoneType):
        return lambda here, offset: here.walls
    return lambda here, offset: None


@inlined
def longer(rows):
    """Return the numbers of nodes along the edges of a tile of distances."""
    return rows[0] + 1, rows[1] + 1, rows[2] + 1


@inlined
def distance_of(here, level, n, wx, wy, wz):
    """Return the distance that a particle gathers and its three slopes per cell."""
    long = longer(here.rows)
    return level_at(level, here.b * volume(long) + n, long, wx, wy, wz)


@inlined
def gap_of(mesh, half, d, nx, ny, nz, w, p):
    """Return the gap of particle p [m] with the normal n, from its distance d of slope 1/w."""
    l = half_size(half, p)
    ex, ey, ez = nx * lane(l, 0) * mesh.hx, ny * lane(l, 1) * mesh.hy, nz * lane(l, 2) * mesh.hz
    return (d - (ex * ex + ey * ey + ez * ez) ** 0.5) * w


class Detect(NamedTuple):
    """Find the particles that touch, and add their mass to the tiles.

    `way`, `step`: how far nodes near the ground have moved at most so far, and will in this step.
    Arrays: distances, m, due, forces, touched. `forces` get the velocities to take away along and
    across the normal, and the displacement out of the ground; `touched`: 1 for blocks in which
    anything touches, whose tiles alone are emptied and filled.
    """

    contact: object  # μ, k, D
    way: float
    step: float
    rate: float  # 1/Δt
    offset: object  # displacement of the ground, None for none
    motion: tuple  # its velocity
    shift: tuple


@is_idle.register(Detect)
def waits(work, a, b, begin, end):
    due = a[2]
    p = begin
    while p < end and due[p] > work.way + work.step:
        p += 1
    return p == end


@visit.register(Detect)
def detect(work, here, a, p):
    level, m, due, forces, touched = a
    if due[p] > work.way + work.step:
        return 0
    mesh, D = here.mesh, work.contact.D
    n, at, wx, wy, wz = locate_both(here, work.shift, work.offset, p)
    d, gx, gy, gz = distance_of(here, level, n, wx, wy, wz)
    gx, gy, gz = gx * mesh.ix, gy * mesh.iy, gz * mesh.iz
    square = gx * gx + gy * gy + gz * gz
    w = 1.0 / square**0.5
    nx, ny, nz = w * gx, w * gy, w * gz
    gap = gap_of(mesh, here.half, d, nx, ny, nz, w, p)
    was_touching, touches = due[p] == TOUCHING, False
    if abs(d) <= D and square > EVEN * EVEN and gap <= work.step:
        at, wx, wy, wz = _in_grid(here, work.offset, p, at, wx, wy, wz)
        u = collect_value(here.source, at, here.rows, wx, wy, wz)
        wanted = want(u, work.motion, gap, work.rate, nx, ny, nz, forces, p)
        touches = wanted > 0.0 or gap < 0.0
        if touches:
            begin_tile(here, touched)
        if wanted > 0.0:
            mass = pack(m[p], 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
            deposit_value(here.tiles[0], here.n0 + at, here.rows, wx, wy, wz, mass)
    due[p] = TOUCHING if touches else work.way + max(gap, -d - D, 0.0)
    if was_touching and not touches:
        put(forces, p, NORMAL, 0.0, 0.0, 0.0, 0.0)
        put(forces, p, TANGENT, 0.0, 0.0, 0.0, 0.0)
        put(forces, p, PUSH, 0.0, 0.0, 0.0, 0.0)
    return 0


@inlined
def begin_tile(here, touched):
    """Empty the tile of a block where the first particle touches."""
    if touched[here.b] == 0:
        touched[here.b] = 1
        here.tiles[0][here.n0 : here.n0 + volume(here.rows) * LANES] = 0.0


@inlined
def _in_grid(here, offset, p, at, wx, wy, wz):
    """Return place and stencils in the grid; those for the distances serve if nothing moved."""
    if offset is None:
        return at, wx, wy, wz
    return locate(here, p)


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
