"""The guard: checks the state from time to time and keeps the last one that was sound."""

EVERY = 50  # steps between checks


class Diverged(Exception):
    """A run whose particles became NaN, infinite or too fast; the message says where and why."""


class Guard:
    """Checks before every output and every `EVERY` steps; goes back to the last sound state.

    `outputs`: steps between outputs.
    """

    def __init__(self, outputs):
        self.outputs = outputs

    def begin(self, simulation):
        """Keep the initial state."""
        simulation.keep()

    def after_step(self, simulation):
        """Check the state and keep it."""
        due = simulation.steps % EVERY == 0 or simulation.steps % self.outputs == 0
        if due or simulation.time >= simulation.case.time:
            simulation.check()
            simulation.keep()

    def end(self, simulation, error):
        """Go back to the last sound state if the run diverged."""
        if isinstance(error, Diverged):
            simulation.restore()
