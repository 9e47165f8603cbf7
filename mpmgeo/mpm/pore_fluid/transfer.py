"""Transfers of the pore fluid between particles and nodes, beside those of the solid.

The particles move with the solid and carry the fluid in their pores: its mass, velocity and
pressure. Two records of a tile belong to the fluid:

    flow:  m, m v (3), ∫ p ∇S dV (3), V           pores:  pore volume, drag (3), force (3), spare

Record of a node: flux q (3), a (3), mean pressure of the cell above, porosity. q is the
velocity of fluid and solid together as a volume, v_s + n (v_f − v_s); its divergence presses the
fluid.
"""

from typing import NamedTuple

from mpmgeo.mpm.core.cells import add_to_cell, mean_of_cell
from mpmgeo.mpm.core.loops import visit
from mpmgeo.mpm.core.point import divergence
from mpmgeo.mpm.core.stencils import locate
from mpmgeo.mpm.core.tile import collect, deposit, deposit_value
from mpmgeo.numerics.jit import inlined
from mpmgeo.numerics.simd import (
    axpy,
    load_row,
    pack,
    quarter,
    scale,
    store_row,
    with_velocity,
)

MEAN = 6  # lane of the mean pressure of a cell in its record
LEAST = 0.01  # porosity below which the pores count as no smaller: they cannot close


@inlined
def _freedom(free, p):
    """Return 0 if particle p keeps its pressure, else 1; `free` None: none does."""
    if free is None:
        return 1.0
    return free[p]


class SumCells(NamedTuple):
    """Sum volume and volume times pressure of the particles of each cell.

    Particles that keep their pressure do not count. Arrays: V, u, free or None.
    """


@visit.register(SumCells)
def sum_cells(work, here, a, p):
    V, u, free = a
    add_to_cell(here, p, V[p] * _freedom(free, p), u[p])
    return 0


class Share(NamedTuple):
    """Give the particles the mean pressure of their cell, which `Average` put into its record.

    Arrays: blocks under the tiles, flux, u, free or None.
    """


@visit.register(Share)
def share(work, here, a, p):
    above, flux, u, free = a
    if _freedom(free, p) != 0.0:
        u[p] = mean_of_cell(here, p, above, flux, MEAN)
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
    strain = work.dt * divergence(here.mesh, sx, sy, sz)
    _compress(work.fluid, solid, V, u, free, p, strain)
    return 0


@inlined
def _accelerate(v, h, value, p):
    if v is not None:
        store_row(v, p, axpy(h, quarter(value, 3), load_row(v, p)))


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
