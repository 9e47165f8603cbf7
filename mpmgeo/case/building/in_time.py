"""The loads of a case that change in time, of those that act on particles."""

from mpmgeo.loads import Gravity

FORCES = {"force": "particle_force", "pull": "fluid_force"}
"""Array of a set of particles → method of the loads that it is the sum of."""


def in_time(case, position):
    """Return what changes gravity and forces on particles in time, None if they are constant.

    position (n, 3) [m]: where the particles start.
    """
    gravity = case.gravity
    changing = isinstance(gravity, Gravity) and gravity.course is not None
    loads = {array: case.acting(how) for array, how in FORCES.items()}
    arrays = [array for array, acting in loads.items() if any(map(course_of, acting))]
    if not (changing or arrays):
        return None
    from mpmgeo.mpm.effects.in_time import Forces, LoadsInTime, Weight

    parts = [Weight(gravity.value, gravity.course)] if changing else []
    for array in arrays:
        terms = [(course_of(load), getattr(load, FORCES[array])(position)) for load in loads[array]]
        parts.append(Forces(array, terms))
    return LoadsInTime(parts)


def course_of(load):
    """Return the factor in time of a load, None if it is constant."""
    return getattr(load, "course", None)
