"""Whether a run can come to the state of rest that its case wants."""

from mpmgeo.boundaries.terrain import TerrainContact
from mpmgeo.loads import BaseAcceleration, PrescribedVelocity

SLOWING = {"kinetic": None, "local": "value", "mass": "alpha"}
"""Kinds of damping that lead to rest, each with the key that must not be zero."""


def check_rest(draft, report):
    """Report a state of rest that never comes, or that nobody can tell."""
    for rest in draft.of("until"):
        for message in _obstacles(draft):
            report.error(rest.path, message)
        if "unbalanced_force" in rest.given and draft.of(TerrainContact.key):
            message = (
                "forces of a terrain are not among those at the nodes; accepted with "
                f'{TerrainContact.key}: "kinetic_energy"'
            )
            report.error(rest.at("unbalanced_force"), message)


def _obstacles(draft):
    """Yield what keeps a case from coming to rest."""
    kinds = draft.of("damping")
    slows = [_slows(part.made) for part in kinds if part.made is not None]
    if len(slows) == len(kinds) and not any(slows):
        yield 'nothing leads to rest; "damping" of type "kinetic", "local" or "mass" is needed'
    if draft.whole.values.get("compatibility") is not None:
        yield "MPM-Geomechanics runs until its time; leave it or compatibility out"
    if draft.of(PrescribedVelocity.key):
        yield f"what {PrescribedVelocity.key} moves does not rest; leave one of them out"
    for base in draft.made(BaseAcceleration.key):
        if base.active:
            yield f"what {BaseAcceleration.key} shakes does not rest; leave one of them out"


def _slows(kind):
    if kind.type not in SLOWING:
        return False
    return SLOWING[kind.type] is None or getattr(kind, SLOWING[kind.type]) > 0
