"""The explicit schemes: in which order a step moves mass, momentum, force and stress.

Each takes the solver and the step that changes velocities (half a step at first, so that velocities
live between the positions). The stages' names are those of the timing table; effects join them.
"""


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


SCHEMES = {"USL": usl, "MUSL": musl, "USF": usf}

FILTERED = (musl, usf)
"""Schemes that strain with velocities which particles brought to the nodes, not with those of nodes
that forces have moved: they bear longer steps (`mpm.stability`)."""
