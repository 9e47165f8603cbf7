"""The file of a complete state: named arrays and facts, with a checksum.

A snapshot is a compressed npz archive. Beside the arrays it holds `facts`, a JSON text, and
`checksum`, the SHA-256 of all the rest.
"""

import hashlib
import json
import sys
import zipfile
import zlib
from contextlib import contextmanager
from math import prod
from pathlib import Path
from typing import BinaryIO, NamedTuple

import numpy as np

FORMAT = 2
QUICK = 1
"""Level of compression: higher ones take several times as long and save little."""

MOST_ENTRIES = 1000
"""Arrays in a snapshot: no case needs more."""

MOST_OF_FACTS, GROWTH = 2**26, 16
"""Memory of the facts: so many bytes, and so many for each byte of the file."""

HEADING = 1, 0
"""Version of the heading of an array; that of others may be as long as the file."""


class Snapshot(NamedTuple):
    """Arrays by name, and facts that JSON can hold, to be written."""

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


class Entry:
    """An array in a snapshot file: its shape and type, and itself when it is needed.

    `most`: rows that it may have if the case allows any number of them.
    """

    def __init__(self, path, name, shape, dtype, most):
        self.path, self.name, self.shape, self.dtype, self.most = path, name, shape, dtype, most
        self._array = None

    @property
    def nbytes(self):
        """The size of the array in memory [bytes]."""
        return prod(self.shape) * self.dtype.itemsize

    def read(self) -> np.ndarray:
        """Return the array, which is kept for the checksum; ValueError if the file is broken."""
        if self._array is None:
            with _opened(self.path) as archive, archive.open(f"{self.name}.npy") as file:
                array = np.lib.format.read_array(file, allow_pickle=False)
                if (array.shape, array.dtype) != (self.shape, self.dtype):
                    raise ValueError("the file has changed")
                self._array = array
        return self._array


class StoredSnapshot:
    """A snapshot file of which only the facts and the sizes of the arrays have been read.

    So nothing of a size that a file claims is made before it is known what the case needs.
    """

    def __init__(self, path: Path | str):
        self.path = path
        with _opened(path) as archive:
            self._entries = {entry.name: entry for entry in _headings(archive, path)}
        most = MOST_OF_FACTS + GROWTH * Path(path).stat().st_size
        self._checksum, facts = (self._text(name, most) for name in ("checksum", "facts"))
        self.facts = _facts(facts)
        if self._checksum is None or self.facts is None:
            raise ValueError(f"{path}: is no snapshot")
        if self.facts.get("format") != FORMAT or self.facts.get("program") != program():
            raise ValueError(
                f"{path}: was written by {self.facts.get('program')} in format "
                f"{self.facts.get('format')}; "
                f"this is {program()}, format {FORMAT}; go on with the version that wrote it"
            )

    def _text(self, name, most):
        entry = self._entries.get(name)
        if entry is None or entry.shape != () or entry.dtype.kind != "U" or entry.nbytes > most:
            return None
        order = {"little": "le", "big": "be"}[sys.byteorder]
        try:
            return entry.read().tobytes().decode(f"utf-32-{order}").rstrip("\0")
        except UnicodeDecodeError:  # numbers that are no characters, over which numpy would stumble
            return None

    def entries(self, most: int) -> dict[str, Entry]:
        """Return the arrays by name, of which those of any length may have `most` rows."""
        named = {n: e for n, e in self._entries.items() if n not in ("checksum", "facts")}
        for entry in named.values():
            entry.most = most
        return named

    def verify(self) -> None:
        """Raise ValueError unless all that has been read is what was written."""
        arrays = {n: e.read() for n, e in self._entries.items() if n != "checksum"}
        if self._checksum != _checksum(arrays):
            raise ValueError(f"{self.path}: the file is broken: its checksum is wrong")


def program() -> str:
    """Return name and version of the program."""
    from importlib.metadata import PackageNotFoundError, version

    try:
        return f"mpmgeo {version('mpmgeo')}"
    except PackageNotFoundError:
        return "mpmgeo, not installed"


@contextmanager
def _opened(path):
    """Open a snapshot as an archive; raises ValueError if it is none, or broken."""
    try:
        with Path(path).open("rb") as file:
            is_archive = file.read(2) == b"PK"
    except OSError as error:
        raise ValueError(f"{path}: cannot be read ({error.strerror})") from None
    try:
        if not is_archive:
            raise ValueError
        with zipfile.ZipFile(path) as archive:
            yield archive
    except (zipfile.BadZipFile, zlib.error, MemoryError, OSError):
        raise ValueError(f"{path}: the file is broken, or not complete") from None
    except Exception:  # what a file can do to two libraries that parse it
        raise ValueError(f"{path}: is no snapshot") from None


def _headings(archive, path):
    """Yield the entries of an archive with shape and type; raises an Exception for odd ones."""
    members = archive.infolist()
    if len({member.filename for member in members}) < len(members) or len(members) > MOST_ENTRIES:
        raise ValueError
    for member in members:
        name, is_array = member.filename.removesuffix(".npy"), member.filename.endswith(".npy")
        if not is_array or member.compress_type not in (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED):
            raise ValueError
        with archive.open(member) as file:
            if np.lib.format.read_magic(file) != HEADING:
                raise ValueError
            shape, _, dtype = np.lib.format.read_array_header_1_0(file)
            entry = Entry(path, name, shape, dtype, most=0)
            if dtype.kind not in "biufU" or min(shape, default=0) < 0:
                raise ValueError
            if file.tell() + entry.nbytes != member.file_size:
                raise zipfile.BadZipFile
            yield entry


def _facts(text):
    try:
        facts = json.loads(str(text))
    except (ValueError, RecursionError):
        return None
    return facts if isinstance(facts, dict) else None


def _checksum(entries):
    digest = hashlib.sha256()
    for name in sorted(entries):
        array = np.ascontiguousarray(entries[name])
        digest.update(f"{name} {array.dtype.str} {array.shape};".encode())
        digest.update(array.tobytes() if array.dtype.kind == "U" else array)
    return digest.hexdigest()
