"""Quadratic B-spline: three nodes, slopes without jumps, no particle size; it ends at walls.

    (½ − s)²/2,   ¾ − s²,   (½ + s)²/2

In the half cell next to a wall what remains is linear: 1 − ξ and ξ, ξ the distance from the wall.

Source: Steffen, Kirby and Berzins (2008), Int. J. Numer. Meth. Engng 76, 922–948.
"""

from typing import NamedTuple

from mpmgeo.numerics.jit import inlined
from mpmgeo.shapes.shape import stencil
from mpmgeo.shapes.wall import before_walls, fold, is_cut


class QuadraticBSpline(NamedTuple):
    width = 3
    edge = 2
    cuts = True


@stencil.register(QuadraticBSpline)
def quadratic_bspline(shape, s, l, cut):
    return ended(s, cut) if is_cut(cut) else whole(s)


@inlined
def whole(s):
    """Return weights and slopes without walls."""
    a, b = 0.5 - s, 0.5 + s
    return 0.5 * a * a, 0.75 - s * s, 0.5 * b * b, -a, -2.0 * s, b


@inlined
def ended(s, cut):
    """Return weights and slopes as walls leave them."""
    below, above = cut
    N0, N1, N2, G0, G1, G2 = whole(before_walls(s, cut, 1.0))
    N0, N1, N2 = fold(below, N0, N1, N2)
    N2, N1, N0 = fold(above, N2, N1, N0)
    G0, G1, G2 = fold(below, G0, G1, G2)
    G2, G1, G0 = fold(above, G2, G1, G0)
    return N0, N1, N2, G0, G1, G2
