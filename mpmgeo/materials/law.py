"""What every material law provides to the kernels: the update of one point."""

from mpmgeo.numerics.dispatch import generic


@generic
def update_stress(law, stress, strain, state, dt):
    """Return the new effective stress and state of one point, one flat tuple.

    `law`: NamedTuple of the law's symbols. `stress`, `strain`: old stress [Pa] and strain increment
    [-], six components xx yy zz xy yz xz, shear as tensor components, tension positive. `state`:
    the law's own variables in the order of its `STATE`, an empty tuple without any. `dt`: time
    step [s].
    """
