"""The stress file of MPM-Geomechanics: stresses of all particles by row, and nothing else.

[{"index": 0, "stress": [[xx, xy, xz], [yx, yy, yz], [zx, zy, zz]]}, …]
"""

import json
from pathlib import Path
from typing import BinaryIO

import numpy as np

from mpmgeo.values import is_number

NAME = "particle_stress_data.json"
SYMMETRY = 1e-6
"""Largest difference of xy and yx, relative to the largest stress of the particle."""

ROWS, COLUMNS = (0, 1, 2, 0, 1, 0), (0, 1, 2, 1, 2, 2)
PLACES = ((0, 3, 5), (3, 1, 4), (5, 4, 2))


def write_stress(file: BinaryIO, stress: np.ndarray) -> None:
    """Write stresses (n, 6) [Pa] in row order to a file that is open for writing bytes."""
    rows = np.asarray(stress, float)[:, PLACES].tolist()
    entries = [{"index": index, "stress": tensor} for index, tensor in enumerate(rows)]
    file.write(json.dumps(entries).encode())


def read_stress(path: Path | str, count: int) -> np.ndarray:
    """Return the stresses (count, 6) [Pa] of a file in row order.

    Raises ValueError that says how the file does not fit `count` particles, or what is wrong.
    """
    entries = _entries(path)
    if len(entries) != count:
        raise ValueError(
            f"{path}: holds the stresses of {len(entries)} particles, the case has {count}; "
            "it was saved with other bodies or cells"
        )
    stress, seen = np.empty((count, 6)), np.zeros(count, bool)
    for number, entry in enumerate(entries, start=1):
        problem = _problem(entry, seen)
        if problem:
            raise ValueError(f"{path}, entry {number}: {problem}")
        tensor = entry["stress"]
        stress[entry["index"]] = [tensor[i][j] for i, j in zip(ROWS, COLUMNS, strict=True)]
        seen[entry["index"]] = True
    return stress


def _entries(path):
    try:
        entries = json.loads(Path(path).read_bytes())
    except OSError as error:
        raise ValueError(f"{path}: cannot be read ({error.strerror})") from None
    except (ValueError, RecursionError):
        raise ValueError(f"{path}: not JSON") from None
    if not isinstance(entries, list):
        raise ValueError(f'{path}: needs a list of objects with "index" and "stress"')
    return entries


def _problem(entry, seen):
    """Return what is wrong with an entry, or None."""
    index, tensor = (entry.get(k) if isinstance(entry, dict) else None for k in ("index", "stress"))
    if type(index) is not int or not 0 <= index < len(seen):
        return f'"index" needs a whole number from 0 to {len(seen) - 1}'
    if seen[index]:
        return f"the index {index} is there twice"
    rows = tensor if isinstance(tensor, list) else []
    numbers = [x for row in rows for x in (row if isinstance(row, list) else ())]
    if [len(row) if isinstance(row, list) else 0 for row in rows] != [3, 3, 3] or not all(
        map(is_number, numbers)
    ):
        return '"stress" needs three rows of three finite numbers'
    slack = SYMMETRY * max(map(abs, numbers))
    if any(abs(tensor[i][j] - tensor[j][i]) > slack for i, j in ((0, 1), (1, 2), (0, 2))):
        return '"stress" is not symmetric'
    return None
