"""A record of accelerations: read from a text file, interpolated in time."""

from bisect import bisect_right
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np


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

    Columns are separated by commas, semicolons, tabs or blanks, further columns are ignored, as
    are empty lines; with `header` the first line is dropped. Raises ValueError naming file and
    line if the file is missing, empty or malformed, or if time does not increase.
    """
    lines = _text(path).split("\n")
    warnings = []
    if header:
        if _is_row(lines[0]):
            warnings.append(
                f"{path}: the first line holds numbers but was dropped as heading; "
                'say "header": false to keep it'
            )
        lines[0] = ""
    numbers = [number for number, line in enumerate(lines) if line.strip()]
    if not numbers:
        raise ValueError(f"{path}: no line with time and three accelerations")
    try:
        table = np.array([_row(lines[number]) for number in numbers])
    except ValueError:
        number = next(number for number in numbers if not _is_row(lines[number]))
        hint = '; a heading needs "header": true' if number == 0 else ""
        raise ValueError(_at(path, number) + _explain(lines[number]) + hint) from None
    infinite = ~np.isfinite(table).all(axis=1)
    if infinite.any():
        number = numbers[infinite.argmax()]
        raise ValueError(_at(path, number) + f"not all numbers are finite: {lines[number]!r}")
    time = table[:, 0].copy()
    late = np.diff(time) > 0
    if not late.all():
        row = late.argmin()
        raise ValueError(
            _at(path, numbers[row + 1])
            + f"time {time[row + 1]:g} s does not exceed the time before it, {time[row]:g} s"
        )
    return Record(time, table[:, 1:].copy(), tuple(warnings))


def _text(path):
    try:
        # A heading in an old encoding must not stop the reading of the numbers.
        return Path(path).read_text(encoding="utf-8-sig", errors="replace")
    except OSError as problem:
        raise ValueError(f"{path}: cannot be read ({problem.strerror})") from None


def _columns(line):
    return line.split(";" if ";" in line else "," if "," in line else None)[:4]


def _row(line):
    time, x, y, z = map(float, _columns(line))
    return time, x, y, z


def _is_row(line):
    try:
        _row(line)
    except ValueError:
        return False
    return True


def _at(path, number):
    return f"{path}, line {number + 1}: "


def _explain(line):
    columns = [column.strip() for column in _columns(line)]
    if len(columns) < 4 or not columns[3]:
        return f"needs time and three accelerations, has {line[:60]!r}"
    word = next(column for column in columns if not _is_row(f"{column};0;0;0"))
    what = "has a decimal comma; write a point" if "," in word else "is not a number"
    return f"{word[:60]!r} {what}"
