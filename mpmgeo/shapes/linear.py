"""Linear hat functions: the shape of the first material point method.

Source: Sulsky, Chen and Schreyer (1994), CMAME 118, 179–196, eq. (14) on a Cartesian grid.
"""

from typing import NamedTuple

from mpmgeo.shapes.shape import stencil


class Linear(NamedTuple):
    width = 2
    edge = 1


@stencil.register(Linear)
def linear(shape, s, l, cut):
    return 0.5 - s, 0.5 + s, -1.0, 1.0
