"""A record of accelerations: read from a text file, interpolated in time."""

from dataclasses import dataclass
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

    def at(self, t: float) -> np.ndarray | None:
        """Return the acceleration (3,) [m/s²] at time t [s]: 0 before, None after the record."""
        if t < self.time[0]:
            return np.zeros(3)
        if t > self.time[-1]:
            return None
        after = int(self.time.searchsorted(t, side="right"))
        before = after - 1
        if after == len(self.time):
            return self.acceleration[before]
        share = (t - self.time[before]) / (self.time[after] - self.time[before])
        return (1 - share) * self.acceleration[before] + share * self.acceleration[after]


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
