"""What scaled inertia does not go with: all in which the motion itself matters."""

from mpmgeo.boundaries.terrain import TerrainContact
from mpmgeo.loads import BaseAcceleration
from mpmgeo.mpm import schemes
from mpmgeo.values import shown

SLOWING = ("local", "kinetic")
"""Kinds of damping that do not ask for how much inertia there is."""


def check_scaling(draft, report):
    """Report that a case in which the inertia is scaled would be wrong."""
    if draft.whole.values.get("density_scaling", 1.0) == 1.0:
        return
    for message in _obstacles(draft):
        report.error(("density_scaling",), message)


def _obstacles(draft):
    case, kinds = draft.whole.values, draft.of("damping")
    words = [part.made.type for part in kinds if part.made is not None]
    if len(words) == len(kinds) and not (words and set(words) <= {*SLOWING}):
        accepted = " or ".join(map(shown, SLOWING))
        yield f'motions are not what they were; accepted with "damping" of type {accepted}'
    if case.get("compatibility") is not None:
        yield "MPM-Geomechanics knows the real inertia only; leave it or compatibility out"
    if case.get("n_phases") == 2:
        yield "the times of two phases are real ones; leave it out"
    scheme = case.get("stress_scheme_update")
    if isinstance(schemes.SCHEMES.get(scheme), schemes.Newmark):
        yield f'is not for {shown(scheme)}; accepted: "USL", "MUSL", "USF"'
    if draft.of(TerrainContact.key):
        yield f"what slides on a {TerrainContact.key} has its real inertia; leave one of them out"
    if any(base.active for base in draft.made(BaseAcceleration.key)):
        yield f"an {BaseAcceleration.key} shakes the real inertia; leave one of them out"
    if any("energy" in results.given for results in draft.of("results")):
        yield "there is no balance of energy of scaled inertia; leave results.energy out"
