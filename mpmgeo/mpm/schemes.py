"""The explicit schemes: in which order a step moves mass, momentum, force and stress.

Each takes the solver and the step that changes velocities (half a step at first, so that velocities
live between the positions). The stages' names are those of the timing table; effects join them.
"""

from mpmgeo.mpm.newmark import CentralDifferences, Newmark, NewmarkNumbers, PredictorCorrector

__all__ = [
    "AS_MPM_GEOMECHANICS",
    "SCHEMES",
    "Newmark",
    "NewmarkNumbers",
    "first_step",
    "is_filtered",
    "longest",
    "scheme_of",
]


def usl(s, h):
    """Update stress last (Sulsky, Zhou and Schreyer 1995)."""
    s.scatter()
    s.update_momentum(h)
    s.gather(h)


def musl(s, h):
    """Modified update stress last: strain from the particles' new momentum (Sulsky et al. 1995)."""
    s.scatter()
    s.update_momentum(h)
    s.remap(h)
    s.update_velocity(after=True)
    s.gather(None)


def usf(s, h):
    """Update stress first (Bardenhagen 2002)."""
    s.scatter(internal=False)
    s.update_velocity(after=False)
    s.strain_and_force()
    s.update_momentum(h)
    s.gather(h, stress=False)


SCHEMES = {
    "USL": usl,
    "MUSL": musl,
    "USF": usf,
    "NPC": PredictorCorrector(),
    "NPC-CD": CentralDifferences(),
}

AS_MPM_GEOMECHANICS = ("USL", "MUSL", "USF")
"""Words for schemes that the program MPM-Geomechanics has."""


def scheme_of(name, case=None):
    """Return the scheme of a name, with the numbers of a case, or those that it has by itself."""
    scheme = SCHEMES[name]
    return scheme.with_numbers(case.npc) if case and isinstance(scheme, Newmark) else scheme


def first_step(scheme):
    """Return by which share of a step the first one changes velocities."""
    return 1.0 if isinstance(scheme, Newmark) else 0.5


def is_filtered(scheme):
    """Tell whether strains come from velocities which particles brought to the nodes.

    In USL they come from nodes that forces have moved: it bears shorter steps (`mpm.stability`).
    """
    return scheme is not usl


def longest(scheme):
    """Return the largest (ω Δt)² of a vibration that a scheme bears."""
    if isinstance(scheme, Newmark):
        return scheme.longest
    return 4.0 if is_filtered(scheme) else 2.0
