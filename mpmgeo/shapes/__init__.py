"""Shape functions: one file each, one line each in SHAPES."""

from mpmgeo.shapes.gimp import Gimp
from mpmgeo.shapes.linear import Linear, LinearInside

SHAPES = {"GIMP": Gimp(), "linear": LinearInside()}

AS_MPM_GEOMECHANICS = {"linear": Linear()}
"""Words that the program MPM-Geomechanics means otherwise."""
