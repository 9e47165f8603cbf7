"""Transfers of the schemes whose particles keep their accelerations (`mpm.newmark`)."""

from typing import NamedTuple

from mpmgeo.mpm.core.loops import visit
from mpmgeo.mpm.core.stencils import in_block, locate
from mpmgeo.mpm.core.tile import collect_value, deposit_value
from mpmgeo.mpm.core.transfer import loaded
from mpmgeo.numerics.simd import (
    axpy,
    load_row,
    pack,
    quarter,
    scale,
    store_row,
    with_velocity,
    within,
)


class Predict(NamedTuple):
    """Add mass, momentum m (v + `ahead` a) and external force to the tiles.

    Arrays: v, a, m, load beside gravity or None.
    """

    gravity: tuple
    tool: float  # 1 if the velocity of the particles is prescribed, else 0
    ahead: float


@visit.register(Predict)
def predict(work, here, a, p):
    v, A, m, force = a
    g = work.gravity
    weight = pack(1.0, 0.0, 0.0, 0.0, g[0], g[1], g[2], work.tool)
    n, wx, wy, wz = locate(here, p)
    V = axpy(work.ahead, load_row(A, p), load_row(v, p))
    C0 = loaded(scale(m[p], with_velocity(weight, V)), force, p)
    deposit_value(here.tiles[0], here.n0 + n, here.rows, wx, wy, wz, C0)
    return 0


class Correct(NamedTuple):
    """Move the particles and change their velocities; tells who left its block.

    x ← x + dt v + further a',  v ← v + old a + new a',  a ← a', with v in the first and a' those of
    the nodes. Arrays: v, a.
    """

    dt: float
    old: float
    new: float
    further: float


@visit.register(Correct)
def correct(work, here, a, p):
    v, A = a
    n, wx, wy, wz = locate(here, p)
    value = collect_value(here.source, n, here.rows, wx, wy, wz)
    new = quarter(value, 3)
    X = axpy(work.further, new, axpy(work.dt, quarter(value, 0), load_row(here.x, p)))
    store_row(here.x, p, X)
    store_row(v, p, axpy(work.new, new, axpy(work.old, load_row(A, p), load_row(v, p))))
    store_row(A, p, new)
    return 0 if within(in_block(here.mesh, here.origin, X), here.low, here.high) else 1
