"""What does not go with particles whose size follows their deformation."""

from mpmgeo.boundaries.terrain import TerrainContact
from mpmgeo.shapes import SHAPES
from mpmgeo.shapes.shape import is_sized
from mpmgeo.values import shown

OTHER_MOVES = (
    "strains with other velocities than those that particles move by, so that what is in "
    'tension falls apart whatever their size; accepted with "updated": "USL", "MUSL"'
)


def check_domains(draft, report):
    """Report particles whose size is to change where there is none, or where it stays."""
    case, path = draft.whole.values, ("particle_domain",)
    if case.get("particle_domain") != "updated":
        return
    shape, scheme = case.get("shape_function"), case.get("stress_scheme_update")
    if shape in SHAPES and not is_sized(SHAPES[shape]):
        words = ", ".join(shown(word) for word, kind in SHAPES.items() if is_sized(kind))
        message = f'with {shown(shape)} particles have no size; accepted with "updated": {words}'
        report.error(path, message)
    if scheme not in ("USL", "MUSL", None):
        report.error(path, f"{shown(scheme)} {OTHER_MOVES}")
    if TerrainContact.key in draft.whole.given:
        report.error(
            path, 'contact with a terrain is for particles that keep their size: "initial"'
        )
    if case.get("compatibility") is not None:
        report.error(path, 'MPM-Geomechanics keeps the sizes of particles; accepted: "initial"')
