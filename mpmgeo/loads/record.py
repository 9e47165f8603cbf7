"""A record of accelerations: read from a text file, interpolated in time."""

from bisect import bisect_right
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np

from mpmgeo.loads.table import Form, read_table

FORM = Form("three accelerations")


@dataclass(frozen=True)
class Record:
    """Accelerations at increasing instants, linear between them.

    time (m,) [s]; acceleration (m, 3) [m/s²]; warnings: what the user should know about the file.
    """

    time: np.ndarray
    acceleration: np.ndarray
    warnings: tuple[str, ...] = ()

    @cached_property
    def _rows(self):
        # plain numbers: a run asks for one instant a step, where arrays cost more than they save
        return self.time.tolist(), [tuple(row) for row in self.acceleration.tolist()]

    def at(self, t: float) -> tuple[float, float, float] | None:
        """Return the acceleration [m/s²] at time t [s]: 0 before the record, None after it."""
        time, rows = self._rows
        if t < time[0]:
            return (0.0, 0.0, 0.0)
        if t > time[-1]:
            return None
        after = bisect_right(time, t)
        if after == len(time):
            return rows[-1]
        before = after - 1
        share = (t - time[before]) / (time[after] - time[before])
        return tuple(
            (1 - share) * a + share * b for a, b in zip(*rows[before : after + 1], strict=True)
        )


def read_record(path: Path | str, header: bool = True) -> Record:
    """Read the columns time [s] and acceleration x, y, z [m/s²] from a text file.

    With `header` the first line is dropped. Raises ValueError as `read_table` does.
    """
    table = read_table(path, FORM, header)
    return Record(*table)
