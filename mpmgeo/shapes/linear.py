"""Linear hat functions: the shape of the first material point method.

At the face of a cell the slope of the node ahead is 1/h already while its weight is still zero. A
particle there, with nobody beyond, would be strained by a node that has neither mass nor velocity,
and would lose the force that it puts there. `LinearInside` keeps particles a hair inside their
cells, so that every node with a slope has mass, the velocity of the particles that give it, and
returns to them what they put into it; plain hats remain for results as of MPM-Geomechanics.

Source: Sulsky, Chen and Schreyer (1994), CMAME 118, 179–196, eq. (14) on a Cartesian grid.
"""

from typing import NamedTuple

from mpmgeo.shapes.shape import stencil

HAIR = 2.0**-50
"""Cells that particles keep from the faces: far below the overlap that counts as round-off."""


class Linear(NamedTuple):
    width = 2
    edge = 1


class LinearInside(NamedTuple):
    width = 2
    edge = 1


@stencil.register(Linear)
def linear(shape, s, l, cut):
    return 0.5 - s, 0.5 + s, -1.0, 1.0


@stencil.register(LinearInside)
def linear_inside(shape, s, l, cut):
    inside = min(max(s, HAIR - 0.5), 0.5 - HAIR)
    return 0.5 - inside, 0.5 + inside, -1.0, 1.0
