"""The stress file of MPM-Geomechanics: stresses of all particles by row, and nothing else.

    [{"index": 0, "stress": [[xx, xy, xz], [yx, yy, yz], [zx, zy, zz]]}, …]
"""

import json
from pathlib import Path
from typing import BinaryIO

import numpy as np

NAME = "particle_stress_data.json"
SYMMETRY = 1e-9
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
    try:
        entries = json.loads(Path(path).read_bytes())
    except OSError as error:
        raise ValueError(f"{path}: cannot be read ({error.strerror})") from None
    except (ValueError, RecursionError):
        raise ValueError(f"{path}: not JSON") from None
    if not isinstance(entries, list):
        raise ValueError(f'{path}: needs a list of objects with "index" and "stress"')
    if len(entries) != count:
        raise ValueError(
            f"{path}: holds the stresses of {len(entries)} particles, the case has {count}; "
            "it was saved with other bodies or cells"
        )
    tensors = np.full((count, 3, 3), np.nan)
    for number, entry in enumerate(entries, start=1):
        try:
            index, tensor = entry["index"], entry["stress"]
            tensors[_index(index, tensors)] = np.array(tensor, dtype=float).reshape(3, 3)
        except (KeyError, TypeError, ValueError, OverflowError) as error:
            reason = error if isinstance(error, IndexError) else ""
            raise ValueError(
                f'{path}, entry {number}: needs "index" and a "stress" of three rows of three numbers'
            ) from None
    return _symmetric(path, tensors)
