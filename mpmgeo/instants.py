"""Instants of a run: whether it has come to one, and equal ones on which changing steps land."""

from typing import NamedTuple

SHORT = 0.01
"""Share of a step by which a sum of steps may fall short of the time that it stands for.

The sum of n steps of T/n is off by n²/10¹⁶ steps at most: a hundredth after ten million.
"""

ROUND_OFF = 1e-9  # of the time between two instants


def has_come_to(simulation, time) -> bool:
    """Tell whether a simulation has come to a time [s], but for round-off of the sum of steps."""
    return simulation.time >= time - SHORT * simulation.time_step


class Instants(NamedTuple):
    """The instants k `end`/`count` [s], k = 1, 2, …, also beyond the end."""

    end: float
    count: int

    def at(self, k: int) -> float:
        """Return instant number k [s]; that of `count` is the end to its last bit."""
        return self.end * (k / self.count)

    def nearest(self, t: float) -> float:
        """Return the instant nearest to time t [s]."""
        return self.at(round(t * self.count / self.end))

    def after(self, t: float) -> float:
        """Return the first instant after time t [s], which may be one but for round-off."""
        return self.at(int(t * self.count / self.end + ROUND_OFF) + 1)

    def has(self, t: float) -> bool:
        """Tell whether time t [s] is one of them, to its last bit."""
        return t == self.nearest(t)
