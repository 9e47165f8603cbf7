"""Shape functions: one file each, one line each in SHAPES."""

from mpmgeo.shapes.gimp import Gimp
from mpmgeo.shapes.linear import Linear

SHAPES = {"GIMP": Gimp(), "linear": Linear()}
