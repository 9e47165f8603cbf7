"""Read triangles from an STL file, ASCII or binary, of whatever program wrote it.

Which of the two it is tells its length: a binary file has 84 bytes and 50 for each triangle. The
word "solid" does not, for many programs write it into the heading of binary files. In a text the
rest of a line with "solid" or "endsolid" is a name, whatever words it is made of.
"""

import re
from pathlib import Path
from typing import NamedTuple

import numpy as np

from mpmgeo.positions import NOWHERE, resolution

HEADING = 84  # bytes before the first triangle, the last four their number
RECORD = np.dtype([("normal", "<f4", 3), ("corner", "<f4", (3, 3)), ("attribute", "<u2")])
SINGLE = float(np.finfo(np.float32).eps)  # of coordinates in binary files
NUMBER = rb"[ \t\r\n]+([^\s]+)"
BYTE_ORDER_MARK = b"\xef\xbb\xbf"
NAME = re.compile(rb"(?:^|(?<=[\r\n]))[ \t]*(?:end[ \t]?)?solid\b[^\r\n]*", re.IGNORECASE)
FACET = re.compile(rb"(?<!end)(?<!end\s)\bfacet\b", re.IGNORECASE)
END_OF_FACET = re.compile(rb"\bend\s?facet\b", re.IGNORECASE)
VERTEX = re.compile(rb"\bvertex" + 3 * NUMBER, re.IGNORECASE)
NORMAL = re.compile(rb"\bfacet[ \t\r\n]+normal" + 3 * NUMBER, re.IGNORECASE)
END = re.compile(rb"\bend\s?solid\b", re.IGNORECASE)


class Triangles(NamedTuple):
    """Triangles of a file: corner (n, 3, 3) [m], normal (n, 3), zero where none is given, whether
    numbers are in single precision, and what the user should know about the file."""

    corner: np.ndarray
    normal: np.ndarray
    is_single: bool
    warnings: tuple[str, ...] = ()

    @property
    def resolution(self) -> float:
        """Return how exactly the file holds the coordinates [m]."""
        if self.is_single:
            return SINGLE * float(np.abs(self.corner).max())
        return float(resolution(NOWHERE, self.corner).max())


def read_stl(path: Path | str) -> Triangles:
    """Read the triangles of an STL file; raises ValueError naming the file if it has none."""
    try:
        content = Path(path).read_bytes()
    except OSError as error:
        raise ValueError(f"{path}: cannot be read ({error.strerror})") from None
    if not content.strip(b"\0 \t\r\n"):
        raise ValueError(f"{path}: the file is empty")
    triangles = _binary(path, content) if _is_binary(content) else _ascii(path, content)
    if not len(triangles.corner):
        raise ValueError(f"{path}: no triangles")
    broken = ~np.isfinite(triangles.corner).all(axis=(1, 2))
    if broken.any():
        raise ValueError(
            f"{path}: triangle {broken.argmax() + 1} has coordinates that are no numbers"
        )
    return triangles


def _count(content):
    return int.from_bytes(content[HEADING - 4 : HEADING], "little")


def _is_binary(content):
    if len(content) >= HEADING and len(content) == HEADING + RECORD.itemsize * _count(content):
        return True
    start = content.removeprefix(BYTE_ORDER_MARK).lstrip()[:5].lower()
    return not (start == b"solid" and b"\0" not in content[:4096])


def _binary(path, content):
    count, size = _count(content), len(content)
    needed = HEADING + RECORD.itemsize * count
    if size < HEADING:
        raise ValueError(f"{path}: no STL file: neither the word solid nor {HEADING} bytes")
    if size < needed:
        there = (size - HEADING) // RECORD.itemsize
        raise ValueError(
            f"{path}: cut short, or no STL file: as a binary one it should hold {count} triangles "
            f"in {needed} bytes; it has {size} bytes, {there} triangles"
        )
    found = np.frombuffer(content, RECORD, count, HEADING)
    warnings = (f"{path}: {size - needed} bytes behind the last triangle",) if size > needed else ()
    return Triangles(found["corner"].astype(float), found["normal"].astype(float), True, warnings)


def _ascii(path, content):
    text = _without_names(content.removeprefix(BYTE_ORDER_MARK))
    vertices, normals = VERTEX.findall(text), NORMAL.findall(text)
    facets, ends = len(FACET.findall(text)), len(END_OF_FACET.findall(text))
    if facets != ends or len(vertices) != 3 * ends:
        raise ValueError(
            f"{path}: cut short or damaged: {facets} facets begin, {ends} end, and "
            f"{len(vertices)} vertices were found where {3 * facets} are needed"
        )
    corner = _numbers(path, vertices, "vertex").reshape(-1, 3, 3)
    normal = np.zeros((len(corner), 3))
    if len(normals) == len(corner):
        normal = np.nan_to_num(_numbers(path, normals, "normal"), posinf=0.0, neginf=0.0)
    warnings = ()
    if not END.search(content, max(0, content.rfind(b"\n", 0, len(content.rstrip())))):
        warnings = (f"{path}: the last line is not endsolid; the file may be cut short",)
    return Triangles(corner, normal, False, warnings)


def _without_names(text):
    """Return a text without the names of its solids, if they stand on lines of their own."""
    is_one_line = not re.search(rb"[\r\n]", text.strip())
    return text if is_one_line else NAME.sub(b"", text)


def _numbers(path, words, what):
    try:
        return np.array(words).astype(float).reshape(-1, 3)
    except ValueError:
        for number, row in enumerate(words, 1):
            try:
                _ = [float(word) for word in row]
            except ValueError:
                text = b" ".join(row).decode("utf-8", "replace")
                raise ValueError(f"{path}: {what} {number} is no three numbers: {text}") from None
        raise
