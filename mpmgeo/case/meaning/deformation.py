"""What does not go with laws whose stress follows from the deformation gradient alone."""

from mpmgeo.materials.hyperelastic import is_hyperelastic
from mpmgeo.values import shown


def check_deformation(draft, report):
    """Report stresses that would be lost, and a program that has no such law."""
    case = draft.whole
    for part in draft.of("materials"):
        if part.made is None or not is_hyperelastic(part.made.symbols):
            continue
        name = shown(part.made.type)
        if case.values.get("load_state"):
            message = f"the stress of {name} follows from its deformation; leave load_state out"
            report.error(("load_state",), message)
        if case.values.get("compatibility") is not None:
            report.error(part.at("type"), f"MPM-Geomechanics has no {name}")
