"""Shape functions: one file each, one line each in SHAPES."""

from mpmgeo.shapes.cubic_bspline import CubicBSpline
from mpmgeo.shapes.gimp import Gimp
from mpmgeo.shapes.linear import Linear, LinearInside
from mpmgeo.shapes.quadratic_bspline import QuadraticBSpline

SHAPES = {
    "GIMP": Gimp(),
    "linear": LinearInside(),
    "quadratic-bspline": QuadraticBSpline(),
    "cubic-bspline": CubicBSpline(),
}

AS_MPM_GEOMECHANICS = {"GIMP": Gimp(), "linear": Linear()}
"""Shapes of the program MPM-Geomechanics, as there."""
