"""What looks at how far a case is from rest."""

from mpmgeo.case.building.in_time import course_of
from mpmgeo.case.spec import ACTIONS
from mpmgeo.damping import KineticDamping


def equilibrium(case):
    """Return what looks at the figures of rest that a case wants, None if it wants none."""
    rest = case.until
    if rest is None:
        return None
    from mpmgeo.mpm.effects.equilibrium import KINETIC, UNBALANCED, Equilibrium

    limits = {UNBALANCED: rest.unbalanced_force, KINETIC: rest.kinetic_energy}
    wanted = {name: limit for name, limit in limits.items() if limit is not None}
    stops = any(isinstance(kind, KineticDamping) for kind in case.dampings)
    return Equilibrium(wanted, rest.every, _constant_from(case), stops)


def _constant_from(case):
    """Return the time [s] from which the loads of a case are constant."""
    loads = (case.gravity, *(load for action in ACTIONS for load in case.entries(action)))
    courses = filter(None, map(course_of, loads))
    return max((course.end for course in courses), default=0.0)
