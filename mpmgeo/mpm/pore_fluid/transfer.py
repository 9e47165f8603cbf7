"""Transfers of the pore fluid between particles and nodes, beside those of the solid.

The particles move with the solid and carry the fluid in their pores: its mass, velocity and
pressure. Two records of a tile belong to the fluid:

    flow:  m, m v (3), ∫ p ∇S dV (3), V           pores:  pore volume, drag (3), force (3), spare

Record of a node: flux q (3), a (3), mean pressure of the cell above, porosity. q is the
velocity of fluid and solid together as a volume, v_s + n (v_f − v_s); its divergence presses the
fluid.
"""

from typing import NamedTuple

from mpmgeo.mpm.core.loops import visit
from mpmgeo.mpm.core.tile import collect, deposit, deposit_value, in_block, locate
from mpmgeo.numerics.jit import inlined
from mpmgeo.numerics.simd import (
    LANES,
    axpy,
    lane,
    load_row,
    pack,
    pack4,
    quarter,
    scale,
    store_row,
    truncate,
    with_velocity,
)
from mpmgeo.state.layout import node_under, place

LEAST = 0.01  # porosity below which the pores count as no smaller: they cannot close


@inlined
def _cell(here, p):
    """Return the place in its tile, along x, y, z, of the lowest node of particle p's cell."""
    x, y, z = here.rows
    last = pack4(x - 2.0, y - 2.0, z - 2.0, 0.0)
    g = in_block(here.mesh, here.origin, load_row(here.x, p))
    g = min(max(truncate(g), 0.0), last)
    return int(lane(g, 0)), int(lane(g, 1)), int(lane(g, 2))


@inlined
def _freedom(free, p):
    """Return 0 if particle p keeps its pressure, else 1; `free` None: none does."""
    if free is None:
        return 1.0
    return free[p]


class SumCells(NamedTuple):
    """Sum volume and volume times pressure of the particles of each cell.

    Particles that keep their pressure do not count. The record of a cell is that of its lowest
    node. Arrays: V, u, free or None.
    """


@visit.register(SumCells)
def sum_cells(work, here, a, p):
    V, u, free = a
    I, J, K = _cell(here, p)
    tiles, at = here.tiles[0], here.n0 + place(here.rows, I, J, K) * LANES
    volume = V[p] * _freedom(free, p)
    tiles[at] += volume
    tiles[at + 1] += volume * u[p]
    return 0


class Share(NamedTuple):
    """Give the particles the mean pressure of their cell, which `Average` put into the nodes.

    Arrays: blocks under the tiles, flux, u, free or None.
    """


@visit.register(Share)
def share(work, here, a, p):
    above, flux, u, free = a
    if _freedom(free, p) != 0.0:
        I, J, K = _cell(here, p)
        u[p] = flux[node_under(above, here.b, here.rows, I, J, K) * LANES + 6]
    return 0


class ScatterFluid(NamedTuple):
    """Add mass, momentum, pressure force and drag of the fluid to the tiles of flow and pores.

    Arrays: mass, velocity, pressure of the fluid, V, force on it against the solid or None.
    """

    fluid: object  # symbols of the pore fluid


@visit.register(ScatterFluid)
def scatter(work, here, a, p):
    m, v, u, V, force = a
    fluid, mesh = work.fluid, here.mesh
    n, wx, wy, wz = locate(here, p)
    one = pack(1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    volume = pack(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0)
    X = pack(0.0, 0.0, 0.0, 0.0, mesh.ix, 0.0, 0.0, 0.0)
    Y = pack(0.0, 0.0, 0.0, 0.0, 0.0, mesh.iy, 0.0, 0.0)
    Z = pack(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, mesh.iz, 0.0)
    C0 = axpy(m[p], with_velocity(one, load_row(v, p)), scale(V[p], volume))
    q = V[p] * u[p]
    C1, C2, C3 = scale(q, X), scale(q, Y), scale(q, Z)
    flow, pores = here.tiles
    deposit(flow, here.n0 + n, here.rows, wx, wy, wz, C0, C1, C2, C3)
    d = m[p] * m[p] / V[p]
    fx, fy, fz = _force(force, p)
    C0 = pack(m[p] / fluid.ρ, d * fluid.dx, d * fluid.dy, d * fluid.dz, fx, fy, fz, 0.0)
    deposit_value(pores, here.n0 + n, here.rows, wx, wy, wz, C0)
    return 0


@inlined
def _force(force, p):
    if force is None:
        return 0.0, 0.0, 0.0
    return force[p, 0], force[p, 1], force[p, 2]


class GatherFluid(NamedTuple):
    """Change the fluid's velocities by h times the acceleration, unless v is None, and pressures.

    Arrays: velocity of the fluid or None, mass of the solid, V, u, free or None.
    """

    fluid: object
    dt: float
    h: float


@visit.register(GatherFluid)
def gather(work, here, a, p):
    v, solid, V, u, free = a
    n, wx, wy, wz = locate(here, p)
    value, sx, sy, sz = collect(here.source, n, here.rows, wx, wy, wz)
    _accelerate(v, work.h, value, p)
    strain = work.dt * _divergence(here.mesh, sx, sy, sz)
    _compress(work.fluid, solid, V, u, free, p, strain)
    return 0


@inlined
def _accelerate(v, h, value, p):
    if v is not None:
        store_row(v, p, axpy(h, quarter(value, 3), load_row(v, p)))


@inlined
def _divergence(mesh, sx, sy, sz):
    """Return the divergence [1/s] of a velocity, from the slopes per cell of node records."""
    return mesh.ix * lane(sx, 0) + mesh.iy * lane(sy, 1) + mesh.iz * lane(sz, 2)


@inlined
def _compress(fluid, solid, V, u, free, p, strain):
    """Change the pressure of particle p by the volume strain of its solid and fluid together.

    `solid`: mass of the solid; `free` None, or 0 for particles that keep their pressure.
    """
    n = max(1.0 - solid[p] / (fluid.ρs * V[p]), LEAST)
    change = fluid.K / n * strain
    if free is not None:
        change *= free[p]
    u[p] -= change
