"""Shape functions: one file each, one line each in SHAPES."""

from mpmgeo.shapes.cubic_bspline import CubicBSpline
from mpmgeo.shapes.gimp import Gimp
from mpmgeo.shapes.linear import Linear, LinearInside
from mpmgeo.shapes.lme import LocalMaxEnt
from mpmgeo.shapes.quadratic_bspline import QuadraticBSpline

SHAPES = {
    "GIMP": Gimp(),
    "linear": LinearInside(),
    "quadratic-bspline": QuadraticBSpline(),
    "cubic-bspline": CubicBSpline(),
    "LME": LocalMaxEnt(),
}
"""Shapes, or numbers that make one: `key` is where a case has them, `shape` what they make."""

AS_MPM_GEOMECHANICS = {"GIMP": Gimp(), "linear": Linear()}
"""Shapes of the program MPM-Geomechanics, as there."""


def shape_of(name, case=None):
    """Return the shape of a name, with the numbers of a case, or those that it has by itself."""
    found = SHAPES[name]
    if isinstance(found, tuple):
        return found
    return (found if case is None else getattr(case, found.key)).shape
