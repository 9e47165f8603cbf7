"""The explicit schemes: in which order a step moves mass, momentum, force and stress.

Each takes the solver and the step that changes velocities (half a step at first, so that velocities
live between the positions). The stages' names are those of the timing table.
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
    s.update_velocity(base="after")
    s.gather(None)


def usf(s, h):
    """Update stress first (Bardenhagen 2002)."""
    s.scatter(internal=False)
    s.update_velocity(base="before")
    s.strain_and_force()
    s.update_momentum(h)
    s.gather(h, stress=False)


def usl_of_two_phases(s, h):
    """Update stress last; the pores are pressed while the particles are where they were."""
    s.scatter()
    s.fluid.scatter(s)
    s.fluid.update_momentum(s, h)
    s.fluid.gather(s, h)
    s.gather(h)


def musl_of_two_phases(s, h):
    """Modified update stress last: strain and pressure from both phases' new momentum."""
    s.scatter()
    s.fluid.scatter(s)
    s.fluid.update_momentum(s, h)
    s.remap(h)
    s.fluid.remap(s, h)
    s.fluid.update_velocity(s)
    s.fluid.gather(s, None)
    s.gather(None)


SCHEMES = {"USL": usl, "MUSL": musl, "USF": usf}
SCHEMES_OF_TWO_PHASES = {"USL": usl_of_two_phases, "MUSL": musl_of_two_phases}
