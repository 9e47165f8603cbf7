"""When a case has outputs, and where steps of changing length land."""

from mpmgeo.instants import Instants
from mpmgeo.run.outputs import AtInstants, EverySteps


def outputs_of(case, time_step):
    """Return when there are outputs with steps of about `time_step` [s], see `run.outputs`."""
    if case.is_adaptive and case.results.print > 0:
        return AtInstants(instants_of(case))
    return EverySteps(1 if case.is_adaptive else steps_between_outputs(case, time_step))


def steps_between_outputs(case, time_step) -> int:
    """Return how many steps of `time_step` [s] lie between two outputs."""
    wanted, steps = case.results.print, int(case.time / time_step)
    return max(1, steps // wanted) if wanted > 0 else 1


def instants_of(case) -> Instants:
    """Return the instants on which steps of changing length land."""
    return Instants(case.time, max(case.results.print, 1))
