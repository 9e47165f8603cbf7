"""Read a text file of times and one value or more each."""

import re
from pathlib import Path
from typing import NamedTuple

import numpy as np

FREE = ("", "null")
"""What stands in a column of components that are not prescribed."""

MOST_NAMED = 8
"""Columns of a heading that a message shows."""

LONGEST = 1000
"""Letters of a heading that are looked at."""


class Form(NamedTuple):
    """What a file holds: `what`, as in "three velocities", in `count` columns beside the time.

    `may_be_free`: columns may be empty, or null, in all lines; `names`: of the columns, where a
    heading has to have them.
    """

    what: str
    count: int = 3
    may_be_free: bool = False
    names: tuple[str, ...] = ()


ONE = Form("one number", 1)


class Table(NamedTuple):
    """time (m,) [s], increasing; values (m, count), NaN in free columns; warnings on the file."""

    time: np.ndarray
    values: np.ndarray
    warnings: tuple[str, ...]


def read_table(path: Path | str, form: Form, header: bool | None = None) -> Table:
    """Read the columns time [s] and values of a form from a text file.

    Columns are separated by commas, semicolons, tabs or blanks, further columns are ignored, as
    are empty lines. With `header` the first line is dropped, with None unless it holds numbers.
    Raises ValueError naming file and line if the file is missing, empty or malformed, or if time
    does not increase.
    """
    lines = _text(path).split("\n")
    warnings = []
    if header and _is_row(lines[0], form):
        warnings.append(
            f"{path}: the first line holds numbers but was dropped as heading; "
            'say "header": false to keep it'
        )
    if header or (header is None and not _is_row(lines[0], form)):
        _check_heading(path, lines[0], form.names)
        lines[0] = ""
    numbers = [number for number, line in enumerate(lines) if line.strip()]
    if not numbers:
        raise ValueError(f"{path}: no line with time and {form.what}")
    try:
        rows = np.array([_row(lines[number], form) for number in numbers])
    except ValueError:
        number = next(n for n in numbers if not _is_row(lines[n], form))
        hint = '; a heading needs "header": true' if number == 0 and header is False else ""
        raise ValueError(_at(path, number) + _explain(lines[number], form) + hint) from None
    _check(path, lines, numbers, rows)
    values, free = np.split(rows[:, 1:], 2, axis=1)
    return Table(rows[:, 0].copy(), np.where(free, np.nan, values), tuple(warnings))


def _check_heading(path, line, names):
    """Raise ValueError for a heading, units in brackets apart, that names other columns."""
    bare = re.sub(r"\[.*?\]|\(.*?\)", "", line[:LONGEST].lower()).lstrip("# \t")
    found = tuple(word.strip(' \t\r"') for word in _columns(bare, len(names)))
    if line.strip() and found != names:
        given, needed = ", ".join(_columns(line, MOST_NAMED)).strip()[:60], ", ".join(names)
        raise ValueError(_at(path, 0) + f"the columns are {given!r}; needed: {needed}")


def _check(path, lines, numbers, rows):
    infinite = ~np.isfinite(rows).all(axis=1)
    if infinite.any():
        number = numbers[infinite.argmax()]
        raise ValueError(_at(path, number) + f"not all numbers are finite: {lines[number]!r}")
    free = rows[:, 1 + rows.shape[1] // 2 :]
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


def _columns(line, count):
    return line.split(";" if ";" in line else "," if "," in line else None)[:count]


def _row(line, form):
    """Return time and values of a line, 0 for free ones, and 1 for each value that is free."""
    time, *words = _columns(line, 1 + form.count)
    if len(words) < form.count:
        raise ValueError("too few columns")
    free = [form.may_be_free and word.strip() in FREE for word in words]
    values = (0.0 if idle else float(word) for word, idle in zip(words, free, strict=True))
    return float(time), *values, *free


def _is_row(line, form):
    try:
        _row(line, form)
    except ValueError:
        return False
    return True


def _at(path, number):
    return f"{path}, line {number + 1}: "


def _explain(line, form):
    columns = [column.strip() for column in _columns(line, 1 + form.count)]
    if len(columns) <= form.count or not (columns[-1] or form.may_be_free):
        return f"needs time and {form.what}, has {line[:60]!r}"
    known = FREE if form.may_be_free else ()
    word = next(
        column
        for place, column in enumerate(columns)
        if not _is_row(f"{column};0", ONE) and not (place and column in known)
    )
    reason = "has a decimal comma; write a point" if "," in word else "is not a number"
    return f"{word[:60]!r} {reason}"
