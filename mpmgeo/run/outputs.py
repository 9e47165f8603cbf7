"""When a run writes an output: every so many steps, or at instants."""

from typing import Any, NamedTuple


class EverySteps(NamedTuple):
    """Outputs every so many steps."""

    steps: int

    def are_due(self, simulation) -> bool:
        """Tell whether the state of a simulation is one to write."""
        return simulation.steps % self.steps == 0


class AtInstants(NamedTuple):
    """Outputs at the instants on which the steps land, `instants.Instants`."""

    instants: Any

    def are_due(self, simulation) -> bool:
        """Tell whether the state of a simulation is one to write."""
        return self.instants.has(simulation.time)
