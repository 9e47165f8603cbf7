"""What goes with one phase or with two, and what has no effect in a case."""

from mpmgeo.boundaries.terrain import TerrainContact
from mpmgeo.case.spec import ACTIONS, NOT_WITH_TWO_PHASES
from mpmgeo.materials import saturation
from mpmgeo.output.fields import FLUID_FIELDS, TERRAIN_FIELDS
from mpmgeo.values import shown


def check_phases(draft, report):
    """Report what two phases lack, and what does not go with them."""
    case = draft.whole
    if case.values.get("n_phases") != 2:
        return
    for part in draft.of("materials"):
        for key in saturation.KEYS:
            if key not in part.given:
                report.error(part.at(key), "missing; needed with two phases")
        _check_fluid(part, case, report)
    for path, value, message in NOT_WITH_TWO_PHASES:
        *place, key = path.split(".")
        for part in draft.of(*place):
            if key in part.given and value in (None, part.values.get(key)):
                report.error(part.at(key), message)


def _check_fluid(part, case, report):
    """Report that a saturated material cannot be calculated with."""
    law, gravity = part.made, case.values.get("conductivity_gravity")
    if law and gravity and all(getattr(law, key) is not None for key in saturation.KEYS):
        message = saturation.problem(law, gravity)
        if message:
            report.error(part.path, message)


def note_idle(draft, report):
    """Note what only acts together with parts that the case does not have."""
    case = draft.whole
    two = case.values.get("n_phases") == 2
    for action in ACTIONS:
        is_given = action.key in case.given and case.values.get(action.key) != ()
        if action.needs_two_phases and not two and is_given:
            report.note((action.key,), "has no effect with one phase")
    dry = [("material_point_results", () if two else FLUID_FIELDS, "exists with two phases only")]
    if TerrainContact.key not in case.given:
        dry.append(("stl_contact_mesh", TERRAIN_FIELDS, "exists with a terrain only"))
    for part in draft.of("results"):
        for key, fields, why in dry:
            for index, word in enumerate(part.values.get(key, ())):
                if word in fields:
                    report.note((*part.at(key), index), f"{shown(word)} {why}")
