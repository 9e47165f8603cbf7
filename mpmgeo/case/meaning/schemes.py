"""Schemes, shapes and sizes of particles that do not go together, or that compatibility lacks."""

from mpmgeo.shapes import AS_MPM_GEOMECHANICS, SHAPES
from mpmgeo.shapes.shape import is_sized
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
    if case.get("particle_domain") == "updated":
        _check_domain(case, report)


def _check_domain(case, report):
    """Report particles whose size is to change where there is none, or where it stays."""
    shape, path = case.get("shape_function"), ("particle_domain",)
    if shape in SHAPES and not is_sized(SHAPES[shape]):
        words = ", ".join(shown(word) for word, kind in SHAPES.items() if is_sized(kind))
        message = f'with {shown(shape)} particles have no size; accepted with "updated": {words}'
        report.error(path, message)
    if case.get("compatibility") is not None:
        report.error(path, 'MPM-Geomechanics keeps the sizes of particles; accepted: "initial"')
