"""One particle by itself: its internal force, its strain, its new stress."""

from numba.extending import overload
from numba.np.unsafe.ndarray import to_fixed_tuple

from mpmgeo.materials.law import update_stress
from mpmgeo.numerics.jit import inlined
from mpmgeo.numerics.simd import lane, load_column, load_row, scale, with_velocity


@inlined
def momentum_and_weight(m, v, weight, p):
    """Return mass, momentum, weight of particle p as a record; `weight` has 1 and g as lanes."""
    return scale(m[p], with_velocity(weight, load_row(v, p)))


@inlined
def internal_force(mesh, V, stress, p):
    """Return −V σ by columns, in the force lanes of three records, for slopes per cell."""
    q = -V[p]
    return (
        scale(q * mesh.ix, load_column(stress, p, 0)),
        scale(q * mesh.iy, load_column(stress, p, 1)),
        scale(q * mesh.iz, load_column(stress, p, 2)),
    )


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


def _state_of(law, state, p):
    """Return the law's variables of particle p as a tuple as long as the law says."""
    return tuple(state[p]) if state is not None else ()


@overload(_state_of, jit_options={"forceinline": True})
def _compiled_state_of(law, state, p):
    count = len(law.instance_class.STATE)
    if count == 0:
        return lambda law, state, p: ()
    return lambda law, state, p: to_fixed_tuple(state[p], count)


@inlined
def advance(law, strain, V, stress, state, p, dt):
    """Update volume, stress and the law's variables of particle p for a strain increment."""
    V[p] *= 1.0 + (strain[0] + strain[1] + strain[2])
    old = (stress[p, 0], stress[p, 1], stress[p, 2], stress[p, 3], stress[p, 4], stress[p, 5])
    new = update_stress(law, old, strain, _state_of(law, state, p), dt)
    for a in range(6):
        stress[p, a] = new[a]
    if state is not None:
        for a in range(state.shape[1]):
            state[p, a] = new[6 + a]
