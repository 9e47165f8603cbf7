"""Bodies against the mesh, and whether the materials exist that parts of a case name."""

import numpy as np

from mpmgeo.case.meaning.sizes import check_sizes
from mpmgeo.case.spec import ACTIONS
from mpmgeo.values import shown


def check_bodies(draft, report):
    """Report what keeps bodies from being filled; return the parts of the other active ones."""
    bodies = draft.of("body")
    if bodies and all(part.values.get("active") is False for part in bodies):
        report.error(("body",), "no body is active")
    sound = []
    for mesh in draft.made("mesh"):
        for part in bodies:
            if part.made is None or not part.made.active:
                continue
            complaints = list(part.made.complaints(np.array(mesh.cells_dimension)))
            for keys, message in complaints:
                report.error(part.at(*keys), message)
            sound += [] if complaints else [part]
        check_sizes(sound, mesh, report)
    return sound


def check_materials(draft, sound, report):
    """Report materials that are named and do not exist; `sound`: bodies that know theirs."""
    defined = {}
    for part in draft.of("materials"):
        number = part.values.get("id")
        if number is None:
            return
        if number in defined:
            first = report.where(defined[number])
            counts = "counts, but for single particles, which take the last one"
            report.warn(part.at("id"), f"{shown(number)} is taken by {first}, which {counts}")
        defined.setdefault(number, part.path)
    if not defined:
        return
    known = ", ".join(map(shown, sorted(defined)))
    for path, number in _named_materials(draft, sound):
        if number is not None and number not in defined:
            report.error(path, f"{shown(number)} is no id of a material; defined: {known}")


def _named_materials(draft, sound):
    """Yield (path, number) wherever a material is named."""
    for part in draft.of("body"):
        yield part.at("material_id"), part.values.get("material_id")
    for part in sound:
        for number, keys in part.made.materials.items():
            yield part.at(*keys), number
    for action in ACTIONS:
        for part in draft.of(action.key):
            yield part.at("material_id"), part.values.get("material_id")
