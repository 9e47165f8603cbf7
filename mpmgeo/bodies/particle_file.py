"""Read a list of particles from a JSON file."""

from functools import partial
from pathlib import Path
from typing import NamedTuple

import numpy as np

from mpmgeo.listed import position_problem, read_entries
from mpmgeo.values import is_number, shown


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
    needs = 'a list of objects with "position" and "volume"'
    entries = read_entries(path, needs, partial(_problem, needs_material=material is None))
    position = np.array([entry["position"] for entry in entries], float).reshape(-1, 3)
    volume = np.array([entry["volume"] for entry in entries], float)
    if material is None:
        numbers = np.array([entry["material_id"] for entry in entries], np.int64)
    else:
        numbers = np.full(len(entries), material, np.int64)
    return ParticleTable(position, volume, numbers)


def _problem(entry, needs_material):
    """Return what is wrong with an entry, or None."""
    for key in ("position", "volume", "material_id")[: 2 + needs_material]:
        if key not in entry:
            return f'"{key}" is missing'
    volume = entry["volume"]
    if message := position_problem(entry):
        return message
    if not is_number(volume) or volume <= 0:
        return f'"volume" needs a finite number above 0, has {shown(volume)}'
    if needs_material and not _is_whole(entry["material_id"]):
        return f'"material_id" needs a whole number, has {shown(entry["material_id"])}'
    return None


def _is_whole(value):
    return is_number(value) and abs(value) < 2**31 and value == int(value)
