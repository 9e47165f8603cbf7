"""Who watches a run: what watchers are told, how they stop it, and the guard, which is one."""

from mpmgeo.instants import has_come_to

EVERY = 50  # steps between checks


class Watcher:
    """What is told of a run, and does nothing; an object of another class may lack methods.

    `begin` and `after_step` may raise StopRun.
    """

    def begin(self, simulation):
        """Hear that a run begins, before its first step."""

    def after_step(self, simulation):
        """Hear that a step is done."""

    def end(self, simulation, error):
        """Hear that the run is over, in any case; `error`: what ended it, or None."""


class StopRun(Exception):
    """Ends a run as if its time were over, once all watchers know the step; the text says why."""


class Diverged(Exception):
    """A run whose particles became NaN, infinite or too fast; the message says where and why."""


def is_due(simulation, outputs) -> bool:
    """Tell whether the state is to be checked, which is before all `outputs`, too."""
    due = simulation.steps % EVERY == 0 or outputs.are_due(simulation)
    return due or has_come_to(simulation, simulation.case.time)


class Guard(Watcher):
    """Checks before every output and every `EVERY` steps; goes back to the last sound state.

    `outputs`: when they are, see `run.outputs`.
    """

    def __init__(self, outputs):
        self.outputs = outputs

    def begin(self, simulation):
        """Keep the initial state."""
        simulation.keep()

    def after_step(self, simulation):
        """Check the state and keep it."""
        if is_due(simulation, self.outputs):
            simulation.check()
            simulation.keep()

    def end(self, simulation, error):
        """Go back to the last sound state if the run diverged."""
        if isinstance(error, Diverged):
            simulation.restore()
