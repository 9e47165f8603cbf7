"""The file of a complete state: named arrays and facts, with a checksum.

A snapshot is a compressed npz archive. Beside the arrays it holds `facts`, a JSON text, and
`checksum`, the SHA-256 of all the rest.
"""

import hashlib
import json
import zipfile
import zlib
from pathlib import Path
from typing import BinaryIO, NamedTuple

import numpy as np

FORMAT = 2
QUICK = 1
"""Level of compression: higher ones take several times as long and save little."""


class Snapshot(NamedTuple):
    """Arrays by name, and facts that JSON can hold."""

    arrays: dict[str, np.ndarray]
    facts: dict


def write_snapshot(file: BinaryIO, snapshot: Snapshot) -> None:
    """Write a snapshot to a file that is open for writing bytes."""
    facts = {"format": FORMAT, "program": program(), **snapshot.facts}
    entries = {**snapshot.arrays, "facts": np.array(json.dumps(facts))}
    entries["checksum"] = np.array(_checksum(entries))
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED, compresslevel=QUICK) as archive:
        for name, array in entries.items():
            with archive.open(f"{name}.npy", "w", force_zip64=True) as entry:
                np.lib.format.write_array(entry, np.asanyarray(array), allow_pickle=False)


def read_snapshot(path: Path | str) -> Snapshot:
    """Read a snapshot; raises ValueError if it is none, broken, or of another version."""
    try:
        with Path(path).open("rb") as file:
            entries = _entries(file, path)
    except OSError as error:
        raise ValueError(f"{path}: cannot be read ({error.strerror})") from None
    checksum, facts = entries.pop("checksum", None), _facts(entries.get("facts"))
    if checksum is None or facts is None:
        raise ValueError(f"{path}: is no snapshot")
    if facts.get("format") != FORMAT or facts.get("program") != program():
        raise ValueError(
            f"{path}: was written by {facts.get('program')} in format {facts.get('format')}; "
            f"this is {program()}, format {FORMAT}; go on with the version that wrote it"
        )
    if str(checksum) != _checksum(entries):
        raise ValueError(f"{path}: the file is broken: its checksum is wrong")
    del entries["facts"]
    return Snapshot(entries, facts)


def program() -> str:
    """Return name and version of the program."""
    from importlib.metadata import PackageNotFoundError, version

    try:
        return f"mpmgeo {version('mpmgeo')}"
    except PackageNotFoundError:
        return "mpmgeo, not installed"


def _entries(file, path):
    """Return all arrays of an archive; raises ValueError if it is none, or broken."""
    try:
        with np.load(file, allow_pickle=False) as archive:
            return {name: archive[name] for name in archive.files}
    except (zipfile.BadZipFile, zlib.error, NotImplementedError, MemoryError, OSError):
        raise ValueError(f"{path}: the file is broken, or not complete") from None
    except (ValueError, EOFError, KeyError, AttributeError, TypeError):
        raise ValueError(f"{path}: is no snapshot") from None


def _facts(text):
    try:
        facts = json.loads(str(text))
    except ValueError:
        return None
    return facts if isinstance(facts, dict) else None


def _checksum(entries):
    digest = hashlib.sha256()
    for name in sorted(entries):
        array = np.ascontiguousarray(entries[name])
        digest.update(f"{name} {array.dtype.str} {array.shape};".encode())
        digest.update(array.tobytes() if array.dtype.kind == "U" else array)
    return digest.hexdigest()
