"""Schemes and shapes that do not go together, and what the compatibility switch lacks of them."""

from mpmgeo.shapes import AS_MPM_GEOMECHANICS, SHAPES
from mpmgeo.values import shown

LINEAR_LAST = (
    '"linear" with the scheme USL diverges in plain cases, such as a block that falls, whatever '
    "the time step: nodes that a particle just reaches are too light; "
    '"stress_scheme_update": "MUSL" mends it'
)


def check_schemes(draft, report):
    """Warn of a shape whose nodes the scheme does not hold; report one that there is not."""
    case = draft.whole.values
    shape = case.get("shape_function")
    if shape == "linear" and case.get("stress_scheme_update") == "USL":
        report.warn(("shape_function",), LINEAR_LAST)
    is_ours = shape in SHAPES and shape not in AS_MPM_GEOMECHANICS
    if is_ours and case.get("compatibility") is not None:
        words = ", ".join(map(shown, AS_MPM_GEOMECHANICS))
        message = f"MPM-Geomechanics has no {shown(shape)}; accepted with compatibility: {words}"
        report.error(("shape_function",), message)
    if case.get("volumetric_locking") == "cells" and case.get("compatibility") is not None:
        message = "MPM-Geomechanics knows no cure of locking; leave it or compatibility out"
        report.error(("volumetric_locking",), message)
