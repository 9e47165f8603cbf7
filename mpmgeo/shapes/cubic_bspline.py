"""Cubic B-spline: four nodes, curvature without jumps, no particle size; it ends at walls.

    (1 − u)³/6,   ⅔ − u²(2 − u)/2,   the same of 1 − u and u,      u = s + ½

In the cell next to a wall what remains is 1 − ξ + ξ³/6, ξ − ξ³/3 and ξ³/6, ξ the distance from the
wall; in a mesh of a single cell between two walls, 1 − ξ and ξ.

Source: Steffen, Kirby and Berzins (2008), Int. J. Numer. Meth. Engng 76, 922–948.
"""

from typing import NamedTuple

from mpmgeo.numerics.jit import inlined
from mpmgeo.shapes.shape import stencil
from mpmgeo.shapes.wall import before_walls, fold, is_cut


class CubicBSpline(NamedTuple):
    width = 4
    edge = 3
    cuts = True


@stencil.register(CubicBSpline)
def cubic_bspline(shape, s, l, cut):
    return ended(s, cut) if is_cut(cut) else whole(s)


@inlined
def whole(s):
    """Return weights and slopes without walls."""
    a, b = 0.5 - s, 0.5 + s
    aa, bb = 0.5 * a * a, 0.5 * b * b
    third, most = 1.0 / 3.0, 2.0 / 3.0
    N1, N2 = most - bb * (2.0 - b), most - aa * (2.0 - a)
    G1, G2 = b * (1.5 * b - 2.0), a * (2.0 - 1.5 * a)
    return third * a * aa, N1, N2, third * b * bb, -aa, G1, G2, bb


@inlined
def ended(s, cut):
    """Return weights and slopes as walls leave them."""
    N0, N1, N2, N3, G0, G1, G2, G3 = whole(before_walls(s, cut, 1.5))
    N0, N1, N2, N3 = folded(cut, N0, N1, N2, N3)
    G0, G1, G2, G3 = folded(cut, G0, G1, G2, G3)
    return N0, N1, N2, N3, G0, G1, G2, G3


@inlined
def folded(cut, N0, N1, N2, N3):
    """Return values of the four nodes as walls leave them.

    A particle on the upper wall to the last bit has two nodes beyond; the outer one goes first.
    """
    below, above = cut
    N3, N2, N1 = fold(min(above, 1.0), N3, N2, N1)
    N2, N1, N0 = fold(max(above - 1.0, 0.0), N2, N1, N0)
    N0, N1, N2 = fold(below, N0, N1, N2)
    return N0, N1, N2, N3
