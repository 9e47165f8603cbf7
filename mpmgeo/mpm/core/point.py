"""One particle by itself: its internal force, its strain, its new stress."""

from numba.extending import overload
from numba.np.unsafe.ndarray import to_fixed_tuple

from mpmgeo.materials.hyperelastic import energy_of, is_hyperelastic, stress_of
from mpmgeo.materials.law import update_stress
from mpmgeo.materials.rotation import gradient, increments, rotate_stress
from mpmgeo.numerics.jit import INLINED, inlined
from mpmgeo.numerics.matrices import determinant, product, row_of
from mpmgeo.numerics.simd import add, lane, load_column, load_row, pack, scale, with_velocity
from mpmgeo.state.particles import column_of_opening


@inlined
def momentum_and_weight(m, v, weight, p):
    """Return mass, momentum, weight of particle p as a record; `weight` has 1 and g as lanes."""
    return scale(m[p], with_velocity(weight, load_row(v, p)))


@inlined
def internal_force(mesh, V, stress, added, p):
    """Return −V σ by columns, in the force lanes of three records, for slopes per cell.

    `added` None, or what σ has in its normal components [Pa] beside the effective stress.
    """
    q = -V[p]
    X, Y, Z = load_column(stress, p, 0), load_column(stress, p, 1), load_column(stress, p, 2)
    if added is not None:
        X = add(X, pack(0.0, 0.0, 0.0, 0.0, added, 0.0, 0.0, 0.0))
        Y = add(Y, pack(0.0, 0.0, 0.0, 0.0, 0.0, added, 0.0, 0.0))
        Z = add(Z, pack(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, added, 0.0))
    return scale(q * mesh.ix, X), scale(q * mesh.iy, Y), scale(q * mesh.iz, Z)


@inlined
def strain_increment(mesh, sx, sy, sz, dt):
    """Return ½(L + Lᵀ) dt as six components, from the slopes per cell of the node records."""
    tx, ty, tz = mesh.ix * dt, mesh.iy * dt, mesh.iz * dt
    return (
        lane(sx, 0) * tx,
        lane(sy, 1) * ty,
        lane(sz, 2) * tz,
        0.5 * (lane(sx, 1) * tx + lane(sy, 0) * ty),
        0.5 * (lane(sy, 2) * ty + lane(sz, 1) * tz),
        0.5 * (lane(sx, 2) * tx + lane(sz, 0) * tz),
    )


@inlined
def divergence(mesh, sx, sy, sz):
    """Return the divergence [1/s] of a velocity, from the slopes per cell of the node records."""
    return mesh.ix * lane(sx, 0) + mesh.iy * lane(sy, 1) + mesh.iz * lane(sz, 2)


@inlined
def spin_increment(mesh, sx, sy, sz, dt):
    """Return ½(L − Lᵀ) dt as its components xy, yz, xz, from the slopes per cell of the records."""
    tx, ty, tz = 0.5 * mesh.ix * dt, 0.5 * mesh.iy * dt, 0.5 * mesh.iz * dt
    return (
        lane(sy, 0) * ty - lane(sx, 1) * tx,
        lane(sz, 1) * tz - lane(sy, 2) * ty,
        lane(sz, 0) * tz - lane(sx, 2) * tx,
    )


def _state_of(law, state, p):
    """Return the law's variables of particle p as a tuple as long as the law says."""
    return tuple(state[p]) if state is not None else ()


@overload(_state_of, jit_options=INLINED)
def _compiled_state_of(law, state, p):
    count = len(law.instance_class.STATE)
    if count == 0:
        return lambda law, state, p: ()
    return lambda law, state, p: to_fixed_tuple(state[p], count)


def _keep_state(law, state, old, new, p):
    """Put the law's variables, which follow the six stresses in `new`, back to particle p.

    `old`: those before. Return by how much tension has opened it, 0 for a law that never opens.
    """
    if state is not None:
        state[p] = new[6:]
    column = column_of_opening(law)
    return 0.0 if column is None else new[6 + column] - old[column]


@overload(_keep_state, jit_options=INLINED)
def _compiled_keep_state(law, state, old, new, p):
    # number by number: after a loop the compiler would count references, for every particle
    opening, opened = column_of_opening(law.instance_class), "0.0"
    lines = ["def keep(law, state, old, new, p):"]
    for n in range(len(law.instance_class.STATE)):
        if n == opening:  # seldom changes, and what is not written costs nothing
            opened = f"new[{6 + n}] - old[{n}]"
            lines.append(f" if {opened} != 0.0:")
        lines.append(f" {' ' * (n == opening)}state[p, {n}] = new[{6 + n}]")
    scope = {}
    exec("\n".join([*lines, f" return {opened}"]), scope)
    return scope["keep"]


def advance(law, rotation, strain, spin, V, stress, state, total, work, pressure, F, p, dt):
    """Update volume, stress and the law's variables of particle p for a strain increment.

    `rotation` None, or the objective rate by which the old stress follows the spin increment;
    the arrays are those of `ParticleSet.material`, the last four None where they are not kept.
    """
    update = _deform if is_hyperelastic(law) else _strain
    update(law, rotation, strain, spin, V, stress, state, total, work, pressure, F, p, dt)


@overload(advance, jit_options=INLINED)
def _compiled_advance(
    law, rotation, strain, spin, V, stress, state, total, work, pressure, F, p, dt
):
    return _deform if is_hyperelastic(law.instance_class) else _strain


def _strain(law, rotation, strain, spin, V, stress, state, total, work, pressure, F, p, dt):
    """Add what a strain increment makes to stress and volume."""
    strain, spin = increments(rotation, strain, spin)
    _sum_up(total, strain, p)
    stretch = 1.0 + (strain[0] + strain[1] + strain[2])
    V[p] *= stretch
    old = (stress[p, 0], stress[p, 1], stress[p, 2], stress[p, 3], stress[p, 4], stress[p, 5])
    old = rotate_stress(rotation, old, spin)
    variables = _state_of(law, state, p)
    new = update_stress(law, old, strain, variables, dt)
    for a in range(6):
        stress[p, a] = new[a]
    opened = _keep_state(law, state, variables, new, p)
    if opened != 0.0:
        V[p] *= 1.0 - opened / stretch
    if work is not None:
        _account(old, new, strain, V[p], work, p)
        _press(pressure, V, opened, work, p)


def _deform(law, rotation, strain, spin, V, stress, state, total, work, pressure, F, p, dt):
    """Update the deformation gradient, F ← (I + L dt) F; volume and stress follow from it."""
    _sum_up(total, strain, p)
    xx, xy, xz, yx, yy, yz, zx, zy, zz = gradient(strain, spin)
    step = (1.0 + xx, xy, xz, yx, 1.0 + yy, yz, zx, zy, 1.0 + zz)
    old = row_of(F, p)
    new = product(step, old)
    for n in range(9):
        F[p, n] = new[n]
    before = V[p]
    V[p] *= determinant(step)
    σ = stress_of(law, new)
    for n in range(6):
        stress[p, n] = σ[n]
    if work is not None:
        work[p, 0] += V[p] * energy_of(law, new) - before * energy_of(law, old)


@inlined
def _sum_up(total, strain, p):
    if total is not None:
        for a in range(6):
            total[p, a] += strain[a]


@inlined
def _account(old, new, strain, V, work, p):
    """Add the work that the mean stress does on particle p."""
    xx, yy, zz = old[0] + new[0], old[1] + new[1], old[2] + new[2]
    xy, yz, xz = old[3] + new[3], old[4] + new[4], old[5] + new[5]
    done = xx * strain[0] + yy * strain[1] + zz * strain[2]
    work[p, 0] += V * (0.5 * done + xy * strain[3] + yz * strain[4] + xz * strain[5])


@inlined
def _press(pressure, V, opened, work, p):
    """Add the work that a given pore pressure does by opening particle p."""
    if pressure is not None:
        work[p, 1] += pressure[p] * V[p] * opened
