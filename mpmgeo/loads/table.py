"""Read a text file of times and three values each."""

from pathlib import Path
from typing import NamedTuple

import numpy as np

FREE = ("", "null")
"""What stands in a column of components that are not prescribed."""


class Table(NamedTuple):
    """time (m,) [s], increasing; values (m, 3), NaN in free columns; warnings about the file."""

    time: np.ndarray
    values: np.ndarray
    warnings: tuple[str, ...]


def read_table(
    path: Path | str, what: str, header: bool | None = None, may_be_free: bool = False
) -> Table:
    """Read the columns time [s] and x, y, z of a quantity, `what`, from a text file.

    Columns are separated by commas, semicolons, tabs or blanks, further columns are ignored, as
    are empty lines. With `header` the first line is dropped, with None unless it holds numbers.
    With `may_be_free` columns may be empty, or null, in all lines. Raises ValueError naming file
    and line if the file is missing, empty or malformed, or if time does not increase.
    """
    lines = _text(path).split("\n")
    warnings = []
    if header and _is_row(lines[0], may_be_free):
        warnings.append(
            f"{path}: the first line holds numbers but was dropped as heading; "
            'say "header": false to keep it'
        )
    if header or (header is None and not _is_row(lines[0], may_be_free)):
        lines[0] = ""
    numbers = [number for number, line in enumerate(lines) if line.strip()]
    if not numbers:
        raise ValueError(f"{path}: no line with time and three {what}")
    try:
        rows = np.array([_row(lines[number], may_be_free) for number in numbers])
    except ValueError:
        number = next(n for n in numbers if not _is_row(lines[n], may_be_free))
        hint = '; a heading needs "header": true' if number == 0 and header is False else ""
        raise ValueError(
            _at(path, number) + _explain(lines[number], what, may_be_free) + hint
        ) from None
    _check(path, lines, numbers, rows)
    return Table(rows[:, 0].copy(), np.where(rows[:, 4:], np.nan, rows[:, 1:4]), tuple(warnings))


def _check(path, lines, numbers, rows):
    infinite = ~np.isfinite(rows).all(axis=1)
    if infinite.any():
        number = numbers[infinite.argmax()]
        raise ValueError(_at(path, number) + f"not all numbers are finite: {lines[number]!r}")
    free = rows[:, 4:]
    mixed = (free != free[0]).any(axis=1)
    if mixed.any():
        number = numbers[mixed.argmax()]
        raise ValueError(_at(path, number) + "a column is free in all lines or in none")
    time = rows[:, 0]
    late = np.diff(time) > 0
    if not late.all():
        row = late.argmin()
        raise ValueError(
            _at(path, numbers[row + 1])
            + f"time {time[row + 1]:g} s does not exceed the time before it, {time[row]:g} s"
        )


def _text(path):
    try:
        # A heading in an old encoding must not stop the reading of the numbers.
        return Path(path).read_text(encoding="utf-8-sig", errors="replace")
    except OSError as problem:
        raise ValueError(f"{path}: cannot be read ({problem.strerror})") from None


def _columns(line):
    return line.split(";" if ";" in line else "," if "," in line else None)[:4]


def _row(line, may_be_free):
    """Return time and values of a line, 0 for free ones, and 1 for each value that is free."""
    time, *values = _columns(line)
    free = [may_be_free and word.strip() in FREE for word in values]
    x, y, z = (0.0 if idle else float(word) for word, idle in zip(values, free, strict=True))
    return float(time), x, y, z, *free


def _is_row(line, may_be_free):
    try:
        _row(line, may_be_free)
    except ValueError:
        return False
    return True


def _at(path, number):
    return f"{path}, line {number + 1}: "


def _explain(line, what, may_be_free):
    columns = [column.strip() for column in _columns(line)]
    if len(columns) < 4 or not (columns[3] or may_be_free):
        return f"needs time and three {what}, has {line[:60]!r}"
    known = FREE if may_be_free else ()
    word = next(
        column
        for place, column in enumerate(columns)
        if not _is_row(f"{column};0;0;0", False) and not (place and column in known)
    )
    reason = "has a decimal comma; write a point" if "," in word else "is not a number"
    return f"{word[:60]!r} {reason}"
