"""Schemes, shapes and sizes of particles that do not go together, or that compatibility lacks."""

from mpmgeo.boundaries.terrain import TerrainContact
from mpmgeo.shapes import AS_MPM_GEOMECHANICS, SHAPES
from mpmgeo.shapes.shape import is_sized
from mpmgeo.values import shown

LINEAR_LAST = (
    '"linear" with the scheme USL diverges in plain cases, such as a block that falls, whatever '
    "the time step: nodes that a particle just reaches are too light; "
    '"stress_scheme_update": "MUSL" mends it'
)

FIRST_MOVES = (
    '"USF" strains with other velocities than those that particles move by, so that what is in '
    'tension falls apart whatever their size; accepted with "updated": "USL", "MUSL"'
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
        _check_domain(draft, report)


def _check_domain(draft, report):
    """Report particles whose size is to change where there is none, or where it stays."""
    case, path = draft.whole.values, ("particle_domain",)
    shape = case.get("shape_function")
    if shape in SHAPES and not is_sized(SHAPES[shape]):
        words = ", ".join(shown(word) for word, kind in SHAPES.items() if is_sized(kind))
        message = f'with {shown(shape)} particles have no size; accepted with "updated": {words}'
        report.error(path, message)
    if case.get("stress_scheme_update") == "USF":
        report.error(path, FIRST_MOVES)
    if TerrainContact.key in draft.whole.given:
        report.error(
            path, 'contact with a terrain is for particles that keep their size: "initial"'
        )
    if case.get("compatibility") is not None:
        report.error(path, 'MPM-Geomechanics keeps the sizes of particles; accepted: "initial"')
