"""Equal instants of a run, on which steps of changing length land."""

from typing import NamedTuple

ROUND_OFF = 1e-9  # of the time between two instants


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
