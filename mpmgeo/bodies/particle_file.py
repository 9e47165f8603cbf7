"""Read a list of particles from a JSON file."""

import json
from pathlib import Path
from typing import NamedTuple

import numpy as np

LARGEST = 1e100
"""Number beyond which products of three overflow."""


class ParticleTable(NamedTuple):
    """Particles of a file in its order: position (n, 3) [m], volume (n,) [m³], material (n,)."""

    position: np.ndarray
    volume: np.ndarray
    material: np.ndarray


def read_particles(path: Path | str, material: int | None = None) -> ParticleTable:
    """Read a JSON list of objects with `position`, `volume` and `material_id`; ignore other keys.

    `material`: id of the material of all particles, which need none of their own then. Raises
    ValueError naming the file and the first entry that is wrong.
    """
    entries = _entries(path)
    for number, entry in enumerate(entries, start=1):
        problem = _problem(entry, material is None)
        if problem:
            raise ValueError(f"{path}, entry {number}: {problem}")
    position = np.array([entry["position"] for entry in entries], float).reshape(-1, 3)
    volume = np.array([entry["volume"] for entry in entries], float)
    if material is None:
        numbers = np.array([entry["material_id"] for entry in entries], np.int64)
    else:
        numbers = np.full(len(entries), material, np.int64)
    return ParticleTable(position, volume, numbers)


def _entries(path):
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
        raise ValueError(f'{path}: needs a list of objects with "position" and "volume"')
    return entries


def _problem(entry, needs_material):
    """Return what is wrong with an entry, or None."""
    if not isinstance(entry, dict):
        return f"needs an object {{ … }}, has {_shown(entry)}"
    keys = ("position", "volume", "material_id") if needs_material else ("position", "volume")
    for key in keys:
        if key not in entry:
            return f'"{key}" is missing'
    place, volume = entry["position"], entry["volume"]
    if not isinstance(place, list) or len(place) != 3 or not all(map(_is_number, place)):
        return f'"position" needs three finite numbers, has {_shown(place)}'
    if not _is_number(volume) or volume <= 0:
        return f'"volume" needs a finite number above 0, has {_shown(volume)}'
    if needs_material and not _is_whole(entry["material_id"]):
        return f'"material_id" needs a whole number, has {_shown(entry["material_id"])}'
    return None


def _is_number(value):
    return type(value) in (int, float) and abs(value) <= LARGEST


def _is_whole(value):
    return type(value) in (int, float) and abs(value) < 2**31 and value == int(value)


def _shown(value):
    text = json.dumps(value)
    return text if len(text) <= 60 else text[:59] + "…"
