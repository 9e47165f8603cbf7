"""Quadratic B-spline: three nodes, slopes without jumps, no particle size; it ends at walls.

    (½ − s)²/2,   ¾ − s²,   (½ + s)²/2

In the half cell next to a wall what remains is linear: 1 − ξ and ξ, ξ the distance from the wall.

Source: Steffen, Kirby and Berzins (2008), Int. J. Numer. Meth. Engng 76, 922–948.
"""

from typing import NamedTuple

from mpmgeo.shapes.shape import stencil
from mpmgeo.shapes.wall import before_walls, fold


class QuadraticBSpline(NamedTuple):
    width = 3
    edge = 2
    cuts = True


@stencil.register(QuadraticBSpline)
def quadratic_bspline(shape, s, l, cut):
    s = before_walls(s, cut, 1.0)
    below, above = cut
    a, b = 0.5 - s, 0.5 + s
    N0, N1, N2 = fold(below, 0.5 * a * a, 0.75 - s * s, 0.5 * b * b)
    N2, N1, N0 = fold(above, N2, N1, N0)
    G0, G1, G2 = fold(below, -a, -2.0 * s, b)
    G2, G1, G0 = fold(above, G2, G1, G0)
    return N0, N1, N2, G0, G1, G2
