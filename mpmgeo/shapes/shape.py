"""What every shape function provides to the kernels: its 1D weights and slopes.

On a Cartesian grid a shape function is the product of three 1D functions, each `width` nodes wide.
A shape is a NamedTuple with that class attribute and one `stencil` registered for its type; its
class attribute `edge` is the power with which the weight vanishes at the edge of the support.
"""

from numba.extending import overload

from mpmgeo.numerics.dispatch import generic
from mpmgeo.numerics.jit import INLINED


@generic
def stencil(shape, s, l, cut):
    """Return the S weights and then the S slopes of the nodes around a particle, one flat tuple.

    Written with + − * / min and max alone, it takes numbers or the vector of all three axes.

    `s` in [−½, ½]: position of the particle relative to the middle of its S nodes, in cells. `l`:
    half of the particle's size, in cells, at most ½. `cut`: how many of the first and of the last
    nodes lie beyond a wall, along each axis, for shapes that end there; None for the others, which
    get nothing else. Slopes are per cell.
    """


def width(shape):
    """Return S, the number of nodes that the shape reaches along an axis."""
    return type(shape).width


@overload(width, jit_options=INLINED)
def _width(shape):
    nodes = shape.instance_class.width
    return lambda shape: nodes
