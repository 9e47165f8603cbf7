"""What every shape function provides to the kernels: its 1D weights and slopes.

On a Cartesian grid a shape function is the product of three 1D functions, each `width` nodes wide.
A shape is a NamedTuple with that class attribute and one `stencil` registered for its type; its
class attribute `edge` is the power with which the weight vanishes at the edge of the support. With
the class attribute `cuts = True` it ends at walls, and its stencil is told how it is cut; with
`sized = True` it depends on the size of particles, and has `ends`, too.
"""

from typing import NamedTuple

from numba.core import types
from numba.extending import overload

from mpmgeo.numerics.dispatch import generic
from mpmgeo.numerics.jit import INLINED


@generic
def stencil(shape, s, l, cut):
    """Return the S weights and then the S slopes of the nodes around a particle, one flat tuple.

    Written with + − * / min and max alone, it takes numbers or the vector of all three axes.

    `s` in [−½, ½]: position of the particle relative to the middle of its S nodes, in cells. `l`:
    half of the particle's size, in cells, at most ½. `cut`: how many of the first and of the last
    nodes lie beyond a wall, along each axis, for shapes that end there; None for the others. Nodes
    beyond have the weight zero; those at and before the wall sum to one and are linear up to it.
    Slopes are per cell.
    """


@generic
def ends(shape, s, l):
    """Return the S weights of the mean of a linear field at the ends s ± l of a particle.

    For shapes that depend on the size of particles; s and l as in `stencil`.
    """


class UniformX(NamedTuple):
    """A shape where nothing changes along x: one node carries all that there is across."""

    shape: object
    across = 0


class UniformY(NamedTuple):
    """A shape where nothing changes along y."""

    shape: object
    across = 1


class UniformZ(NamedTuple):
    """A shape where nothing changes along z."""

    shape: object
    across = 2


UNIFORM = (UniformX, UniformY, UniformZ)


def _class_of(shape):
    """Return the class of a shape, or of the one that numba's type of it stands for."""
    return getattr(shape, "instance_class", type(shape))


def across(shape):
    """Return the axis along which nothing changes, None without; also for numba's type of it."""
    return getattr(_class_of(shape), "across", None)


def _kind(shape):
    """Return the class that tells how wide a shape is, and what it needs."""
    if across(shape) is None:
        return _class_of(shape)
    return _class_of(shape.types[0] if hasattr(shape, "types") else shape.shape)


def in_space(shape):
    """Return the shape that changes along all axes."""
    return shape if across(shape) is None else shape.shape


def width(shape):
    """Return S, the number of nodes that the shape reaches along an axis."""
    return _kind(shape).width


@overload(width, jit_options=INLINED)
def _width(shape):
    nodes = _kind(shape).width
    return lambda shape: nodes


def widths(shape):
    """Return how many nodes the shape reaches along x, y, z: S, one where nothing changes."""
    S = _kind(shape).width
    return tuple(1 if axis == across(shape) else S for axis in range(3))


@overload(widths, jit_options=INLINED)
def _widths(shape):
    nodes = widths(shape)
    return lambda shape: nodes


def cuts(shape):
    """Tell whether the shape, or numba's type of it, ends at walls."""
    return getattr(_kind(shape), "cuts", False)


def is_sized(shape):
    """Tell whether the shape depends on the size of particles."""
    return getattr(_kind(shape), "sized", False)


def cut_of(shape, walls, first):
    """Return the `cut` of the stencil that begins at a node, None for shapes that do not end.

    `walls`: where those of the lower and of the upper side are, in cells as the node, infinitely
    far away where there is none; None for no walls at all.
    """
    return _choose(cuts(shape), walls is not None)(shape, walls, first)


@overload(cut_of, jit_options=INLINED)
def _cut_of(shape, walls, first):
    has_walls = not isinstance(walls, types.NoneType)
    return _choose(cuts(shape), has_walls)


def _choose(ends, has_walls):
    if not ends:
        return lambda shape, walls, first: None
    return _beyond if has_walls else lambda shape, walls, first: (0.0, 0.0)


def _beyond(shape, walls, first):
    return max(walls[0] - first, 0.0), max(first + (width(shape) - 1.0) - walls[1], 0.0)


@stencil.register(UniformX)
@stencil.register(UniformY)
@stencil.register(UniformZ)
def stencil_in_the_plane(shape, s, l, cut):
    return stencil(shape.shape, s, l, cut)
