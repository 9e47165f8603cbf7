"""A factor in time that a load takes: listed, from a text file, or a ramp."""

from bisect import bisect_right
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from math import pi, sin
from pathlib import Path
from typing import ClassVar

from mpmgeo.loads.table import Form, read_table
from mpmgeo.parameters import parameter

FORM = Form("one factor", 1, names=("time", "factor"))

FORMS = '"time" with "factor", "factor_file" or "ramp"'


@dataclass(frozen=True)
class Course:
    """Factors at increasing instants [s], linear between them, the first before, the last after."""

    time: tuple[float, ...]
    factor: tuple[float, ...]

    def at(self, t: float) -> float:
        """Return the factor at time t [s]."""
        after = bisect_right(self.time, t)
        if after in (0, len(self.time)):
            return self.factor[0 if after == 0 else -1]
        before = after - 1
        share = (t - self.time[before]) / (self.time[after] - self.time[before])
        return (1 - share) * self.factor[before] + share * self.factor[after]

    @property
    def largest(self) -> float:
        """Return the factor of largest size."""
        return max(self.factor, key=abs)

    @property
    def end(self) -> float:
        """Return the time [s] from which it is constant."""
        return self.time[-1]


@dataclass(frozen=True)
class SineRamp:
    """From 0 to 1 without a jump of the rate: ½ [sin(π t/T − π/2) + 1] up to the duration T."""

    type: ClassVar[str] = "sine"
    largest: ClassVar[float] = 1.0

    duration: float = parameter("Time in which the load reaches its value", unit="s", above=0)

    def at(self, t: float) -> float:
        """Return the factor at time t [s]."""
        return 1.0 if t >= self.duration else sin(pi / 2 * t / self.duration) ** 2

    @property
    def end(self) -> float:
        """Return the time [s] from which it is constant."""
        return self.duration


@dataclass(frozen=True)
class InTime:
    """What may be multiplied by a factor in time."""

    time: tuple[float, ...] | None = parameter(
        "Instants of `factor`, increasing", unit="s", default=None, last=True
    )
    factor: tuple[float, ...] | None = parameter(
        "Factors at these instants; linear between them, held before the first and after the last",
        default=None,
        last=True,
    )
    factor_file: Path | None = parameter(
        "Text file with the columns time [s] and factor, in the place of the two lists",
        file=True,
        default=None,
        last=True,
    )
    ramp: SineRamp | None = parameter(
        "Growth from nothing to the whole, in the place of a list of factors",
        default=None,
        last=True,
    )

    def problems(self) -> Iterator[tuple[str, str]]:
        """Yield (key, message) unless there is one factor that can be used, or none."""
        given = [key for key in ("time", "factor") if getattr(self, key) is not None]
        others = [key for key in ("factor_file", "ramp") if getattr(self, key) is not None]
        if len(others) + bool(given) > 1:
            yield others[-1], f"only one of {FORMS} can be given"
        elif len(given) == 1:
            yield given[0], '"time" and "factor" are given together'
        elif given:
            yield from self._faults_of_lists()
        elif self.factor_file is not None:
            try:
                _ = self.course
            except ValueError as error:
                yield "factor_file", str(error)

    def _faults_of_lists(self):
        if not self.time:
            yield "time", "holds no instant; at least one is needed"
        if len(self.factor) != len(self.time):
            yield "factor", f"has {len(self.factor)} values for {len(self.time)} instants in time"
        for one, other in pairwise(self.time):
            if not other > one:
                yield "time", f"{other:g} s does not exceed the instant before it, {one:g} s"
                return

    @cached_property
    def course(self) -> Course | SineRamp | None:
        """Return the factor, `at` a time; None: always one. ValueError for an unusable file."""
        if self.factor_file is not None:
            table = read_table(self.factor_file, FORM)
            return Course(tuple(table.time.tolist()), tuple(table.values[:, 0].tolist()))
        return self.ramp if self.time is None else Course(self.time, self.factor)
