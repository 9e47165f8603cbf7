"""The end of a run at a state of rest, which the user is told of with its figures."""

from math import isfinite

from mpmgeo.instants import has_come_to
from mpmgeo.run.watch import StopRun, Watcher


class Rest(Watcher):
    """Watches a run and ends it as soon as the figures that the case wants are reached."""

    def begin(self, simulation):
        """End a run that is at rest already."""
        self._look(simulation, "at rest already")

    def after_step(self, simulation):
        """End the run at rest."""
        self._look(simulation, "at rest")

    def _look(self, simulation, words):
        goal = goal_of(simulation)
        if goal.is_reached(simulation.time):
            message = (
                f"{words} after {simulation.time:.6g} s, {simulation.steps} steps: "
                f"{_against(goal, goal.figures)}"
            )
            simulation.say(message)
            raise StopRun(message)

    def end(self, simulation, error):
        """Say that there was no rest in the time of the case."""
        goal, cut_short = goal_of(simulation), simulation.interrupted or simulation.stopped
        if error is None and not cut_short and has_come_to(simulation, simulation.case.time):
            ramp = ""
            if simulation.time < goal.since:
                ramp = f"; loads change until {goal.since:.6g} s"
            simulation.say(
                f"not at rest when the time of the case is over, {simulation.time:.6g} s: "
                f"{_against(goal, goal.figures)}{ramp}"
            )


def goal_of(simulation):
    """Return what looks at the figures of a simulation, None if its case wants no rest."""
    return simulation.solver.effect("equilibrium")


def rest_of(simulation) -> list:
    """Return the watchers that end a run at rest, none if its case wants no rest."""
    return [] if goal_of(simulation) is None else [Rest()]


def figures(simulation) -> str:
    """Return the last figures in words, an empty text if there are none."""
    goal = goal_of(simulation)
    if goal is None:
        return ""
    return "".join(f", {name} {x:.1e}" for name, x in goal.latest.items() if isfinite(x))


def _against(goal, found):
    """Return figures beside those that are wanted, in words."""
    shown = {name: f"{x:.2g}" if isfinite(x) else "not known yet" for name, x in found.items()}
    return ", ".join(f"{name} {shown[name]}, wanted {x:g}" for name, x in goal.wanted.items())
