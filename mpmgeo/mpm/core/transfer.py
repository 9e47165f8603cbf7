"""Transfers between particles and nodes: scatter (P2G), gather (G2P) and both in one pass.

Record of a tile: m, m v (3), f (3), m of tools. Record of a node: v (3), a (3), m, and the
part of m that touches the ground.
"""

from typing import NamedTuple

from mpmgeo.mpm.core.affine import deposit_affine, keep_gradient
from mpmgeo.mpm.core.domain import deform, moved_with_corners
from mpmgeo.mpm.core.locking import beside_effective_stress, with_mean_divergence
from mpmgeo.mpm.core.loops import visit
from mpmgeo.mpm.core.opening import confine
from mpmgeo.mpm.core.point import (
    advance,
    internal_force,
    momentum_and_weight,
    spin_increment,
    strain_increment,
)
from mpmgeo.mpm.core.stencils import find, in_block, locate, of_axis
from mpmgeo.mpm.core.tile import collect, collect_value, deposit, deposit_value
from mpmgeo.numerics.jit import inlined
from mpmgeo.numerics.simd import (
    add,
    axpy,
    lane,
    load_row,
    pack,
    quarter,
    splat,
    store_row,
    within,
)
from mpmgeo.transfers.transfer import carried


class Scatter(NamedTuple):
    """Add mass, momentum and force to the tiles.

    Arrays: v, velocity gradients or None, m, V, stress, or None to leave out the internal force,
    pressure of a pore fluid or None, load beside gravity or None, mean stresses of cells or None.
    """

    gravity: tuple
    tool: float  # 1 if the velocity of the particles is prescribed, else 0


@visit.register(Scatter)
def scatter(work, here, a, p):
    v, C, m, V, stress, pressure, force, means = a
    g = work.gravity
    weight = pack(1.0, 0.0, 0.0, 0.0, g[0], g[1], g[2], work.tool)
    C0 = loaded(momentum_and_weight(m, v, weight, p), force, p)
    _deposit_all(here, C0, C, m, V, stress, pressure, means, p)
    return 0


@inlined
def loaded(C0, force, p):
    """Return a particle's record with its load beside gravity."""
    if force is None:
        return C0
    return add(C0, pack(0.0, 0.0, 0.0, 0.0, force[p, 0], force[p, 1], force[p, 2], 0.0))


@inlined
def _deposit_all(here, C0, C, m, V, stress, pressure, means, p):
    if C is not None:
        C1, C2, C3 = _stressed(here, V, stress, pressure, means, p)
        deposit_affine(here, m, C, C0, C1, C2, C3, p)
    elif stress is None:
        n, wx, wy, wz = locate(here, p)
        deposit_value(here.tiles[0], here.n0 + n, here.rows, wx, wy, wz, C0)
    else:
        n, wx, wy, wz = locate(here, p)
        _deposit_force(here, n, wx, wy, wz, C0, V, stress, pressure, means, p)


@inlined
def _deposit_force(here, n, wx, wy, wz, C0, V, stress, pressure, means, p):
    C1, C2, C3 = _stressed(here, V, stress, pressure, means, p)
    deposit(here.tiles[0], here.n0 + n, here.rows, wx, wy, wz, C0, C1, C2, C3)


@inlined
def _stressed(here, V, stress, pressure, means, p):
    if stress is None:
        return splat(0.0), splat(0.0), splat(0.0)
    added = beside_effective_stress(here, stress, pressure, means, p)
    return internal_force(here.mesh, V, stress, added, p)


class Gather(NamedTuple):
    """Move the particles with the nodes and update their stress; tells who left its block.

    Velocities change by h times the acceleration, or as another `transfer` says. With v None they
    stay, and positions follow the velocity that `Velocity` kept. With `law` None volume and stress
    stay. Domains follow the nodes as they are, and positions with them. Arrays: v, velocity
    gradients or None, those of `ParticleSet.material` and of its `follower`, mean divergences of
    cells or None.
    """

    law: object
    rotation: object
    dt: float
    h: float
    transfer: object = None


@visit.register(Gather)
def gather(work, here, a, p):
    v, C, material, follower, means = a
    n, w = find(here, p)
    wx, wy, wz = of_axis(here.shape, w, 0), of_axis(here.shape, w, 1), of_axis(here.shape, w, 2)
    value, sx, sy, sz = collect(here.source, n, here.rows, wx, wy, wz)
    _strained(work, work.law, here, value, sx, sy, sz, means, material, p)
    keep_gradient(work.transfer, here, C, n, w, sx, sy, sz, p)
    X = _moved(work, here.x, v, value, p)
    X = moved_with_corners(follower, work.dt, here, n, X, p)
    deform(follower, here, sx, sy, sz, work.dt, p)
    store_row(here.x, p, X)
    return 0 if within(in_block(here.mesh, here.origin, X), here.low, here.high) else 1


@inlined
def _moved(work, x, v, value, p):
    """Return the new position, with the velocity changed."""
    if v is None:
        return axpy(work.dt, quarter(value, 3), load_row(x, p))
    X = axpy(work.dt, quarter(value, 0), load_row(x, p))
    _accelerate(work.transfer, work.h, v, value, p)
    return X


@inlined
def _accelerate(transfer, h, v, value, p):
    """Give particle p its new velocity, from the sums Σ S r of the node records r."""
    if transfer is None:
        store_row(v, p, axpy(h, quarter(value, 3), load_row(v, p)))
    else:
        u, a = quarter(value, 0), quarter(value, 3)
        store_row(v, p, carried(transfer, h, load_row(v, p), u, a))


@inlined
def _strained(work, law, here, value, sx, sy, sz, means, material, p):
    if law is not None:
        V, stress, m, state, total, account, pressure, F = material
        sx, sy, sz = with_mean_divergence(here, sx, sy, sz, means, p)
        confine(law, here.mesh, here.x, lane(value, 6), m, V, state, p)
        strain = strain_increment(here.mesh, sx, sy, sz, work.dt)
        spin = spin_increment(here.mesh, sx, sy, sz, work.dt)
        turn, dt = work.rotation, work.dt
        advance(law, turn, strain, spin, V, stress, state, total, account, pressure, F, p, dt)


class Remap(NamedTuple):
    """Change velocities as in `Gather` and put the new momentum into the tiles.

    Arrays: v, velocity gradients or None, m.
    """

    h: float
    transfer: object = None


@visit.register(Remap)
def remap(work, here, a, p):
    v, C, m = a
    _remap(work, work.transfer, here, v, C, m, p)
    return 0


@inlined
def _remap(work, transfer, here, v, C, m, p):
    one = pack(1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    if C is None:
        n, wx, wy, wz = locate(here, p)
        value = collect_value(here.source, n, here.rows, wx, wy, wz)
        _accelerate(transfer, work.h, v, value, p)
        C0 = momentum_and_weight(m, v, one, p)
        deposit_value(here.tiles[0], here.n0 + n, here.rows, wx, wy, wz, C0)
    else:
        n, w = find(here, p)
        shape = here.shape
        wx, wy, wz = of_axis(shape, w, 0), of_axis(shape, w, 1), of_axis(shape, w, 2)
        value, sx, sy, sz = collect(here.source, n, here.rows, wx, wy, wz)
        _accelerate(transfer, work.h, v, value, p)
        keep_gradient(transfer, here, C, n, w, sx, sy, sz, p)
        zero = splat(0.0)
        deposit_affine(here, m, C, momentum_and_weight(m, v, one, p), zero, zero, zero, p)


class StrainAndForce(NamedTuple):
    """Update stress with the nodal velocity, add the internal force of the new one to the tiles.

    Arrays: pressure of a pore fluid or None, those of `ParticleSet.material`.
    """

    law: object
    rotation: object
    dt: float


@visit.register(StrainAndForce)
def strain_and_force(work, here, a, p):
    pressure, material = a
    V, stress = material[0], material[1]
    n, wx, wy, wz = locate(here, p)
    value, sx, sy, sz = collect(here.source, n, here.rows, wx, wy, wz)
    _strained(work, work.law, here, value, sx, sy, sz, None, material, p)
    _deposit_force(here, n, wx, wy, wz, splat(0.0), V, stress, pressure, None, p)
    return 0


class Strain(NamedTuple):
    """Update stress with the nodal velocity.

    Arrays: those of `ParticleSet.material`, mean divergences of cells or None.
    """

    law: object
    rotation: object
    dt: float


@visit.register(Strain)
def strain(work, here, a, p):
    material, means = a
    n, wx, wy, wz = locate(here, p)
    value, sx, sy, sz = collect(here.source, n, here.rows, wx, wy, wz)
    _strained(work, work.law, here, value, sx, sy, sz, means, material, p)
    return 0


class Force(NamedTuple):
    """Add the internal force to the tiles.

    Arrays: V, stress, pressure of a pore fluid or None, mean stresses of cells or None.
    """


@visit.register(Force)
def force(work, here, a, p):
    V, stress, pressure, means = a
    n, wx, wy, wz = locate(here, p)
    _deposit_force(here, n, wx, wy, wz, splat(0.0), V, stress, pressure, means, p)
    return 0
