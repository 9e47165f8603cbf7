"""Read a JSON file that lists objects, as points with a value or particles are listed."""

import json
from collections.abc import Callable
from pathlib import Path

from mpmgeo.values import is_number, shown


def read_entries(path: Path | str, needs: str, problem: Callable) -> list[dict]:
    """Return the objects that a JSON file lists.

    `needs`: what the list holds, for messages; `problem(entry)`: what is wrong with an entry, or
    None. Raises ValueError naming the file and the first entry that is wrong.
    """
    try:
        entries = json.loads(Path(path).read_bytes())
    except OSError as error:
        raise ValueError(f"{path}: cannot be read ({error.strerror})") from None
    except json.JSONDecodeError as error:
        reason = f"line {error.lineno}, column {error.colno}: {error.msg}"
        raise ValueError(f"{path}: not JSON: {reason}") from None
    except (UnicodeDecodeError, RecursionError, ValueError):
        raise ValueError(f"{path}: not JSON") from None
    if not isinstance(entries, list):
        raise ValueError(f"{path}: needs {needs}")
    for number, entry in enumerate(entries, start=1):
        is_object = isinstance(entry, dict)
        message = problem(entry) if is_object else f"needs an object {{ … }}, has {shown(entry)}"
        if message:
            raise ValueError(f"{path}, entry {number}: {message}")
    return entries


def position_problem(entry) -> str | None:
    """Return what is wrong with the `position` of an entry, or None."""
    place = entry.get("position")
    if "position" not in entry:
        return '"position" is missing'
    if not isinstance(place, list) or len(place) != 3 or not all(map(is_number, place)):
        return f'"position" needs three finite numbers, has {shown(place)}'
    return None
