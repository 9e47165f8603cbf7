"""What every transfer of velocity between particles and nodes provides.

A transfer has `symbols`, a NamedTuple for whose type `carried` is registered, or None for plain
FLIP. For one that is affine `gradient_stencil` is, too: particles then keep a velocity gradient C
and bring m S (v + C (x_n − x_p)) to the nodes.
"""

from dataclasses import dataclass
from typing import ClassVar

from numba.cpython.unsafe.tuple import tuple_setitem

from mpmgeo.numerics.dispatch import generic
from mpmgeo.numerics.jit import inlined


@dataclass(frozen=True)
class Transfer:
    """A transfer; `is_affine`: whether particles keep a velocity gradient."""

    is_affine: ClassVar[bool] = False

    @property
    def symbols(self):
        """Return what kernels take for it, None for plain FLIP."""
        return None


@generic
def carried(transfer, h, v, u, a):
    """Return the new velocity of a particle with the velocity v.

    u, a: nodal velocity after the step and acceleration at the particle; h: step of velocities.
    """


@generic
def gradient_stencil(transfer, w):
    """Return the stencil w with slopes that make of nodal velocities the gradient to keep.

    `w`: S weights, then S slopes, numbers or vectors of the three axes. None: its own slopes do.
    """


@inlined
def with_moments(w):
    """Return a stencil with the moments of the weights, S (x_n − x_p), in the place of slopes.

    In cells; the particle is where its weights are in balance.
    """
    S = len(w) // 2
    centre = w[1]
    for i in range(2, S):
        centre = centre + w[i] * (1.0 * i)
    for i in range(S):
        w = tuple_setitem(w, S + i, w[i] * (1.0 * i - centre))
    return w
