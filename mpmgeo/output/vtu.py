"""Points and hexahedra with their fields as VTK XML files (.vtu) of appended raw binary data.

Layout: VTK file formats, https://docs.vtk.org/en/latest/vtk_file_formats/vtkxml_file_format.html
"""

import sys
from html import escape
from pathlib import Path

import numpy as np

from mpmgeo.output.whole_file import whole_file

VERTEX, HEXAHEDRON = 1, 12
NUMBERS = {"Float": (32, 64), "Int": (8, 16, 32, 64), "UInt": (8, 16, 32, 64)}
TYPES = {
    np.dtype(f"{kind}{n}".lower()): f"{kind}{n}" for kind, bits in NUMBERS.items() for n in bits
}


def write_points(path: Path | str, position, fields: dict[str, np.ndarray]) -> None:
    """Write one vertex per position (n, 3) [m] with fields of shape (n,) or (n, components).

    The types of the arrays are kept. Raises ValueError if a field has another length, TypeError
    if its type is not a VTK one.
    """
    each = np.arange(len(position), dtype=_index_type(len(position)))
    _write(path, position, each[:, None], VERTEX, fields, {})


def write_hexahedra(path: Path | str, points, connectivity, point_fields, cell_fields) -> None:
    """Write hexahedra given by the rows (m, 8), in VTK order, of their points (n, 3) [m].

    Fields have shape (n,) or (n, components), and (m,) or (m, components). Raises as
    `write_points` does.
    """
    _write(path, points, connectivity, HEXAHEDRON, point_fields, cell_fields)


def _write(path, points, connectivity, kind, point_fields, cell_fields):
    number, corners = connectivity.shape
    index = _index_type(connectivity.size)
    sections = {
        "PointData": _checked(point_fields, len(points)),
        "CellData": _checked(cell_fields, number),
        "Points": {"Points": np.ascontiguousarray(points, dtype=np.float64)},
        "Cells": {
            "connectivity": connectivity.astype(index, copy=False).ravel(),
            "offsets": np.arange(corners, connectivity.size + 1, corners, dtype=index),
            "types": np.full(number, kind, dtype=np.uint8),
        },
    }
    arrays = [array for section in sections.values() for array in section.values()]
    # The data follow each other in the reverse of the order in which the heading names them:
    # meshio 5.3 rewrites the offsets of raw files one by one, and confuses a new offset with an
    # equal old one of a later array unless the later array has been dealt with before.
    offsets = np.cumsum([0] + [8 + array.nbytes for array in reversed(arrays)])[-2::-1]
    with whole_file(path) as file:
        file.write(_heading(sections, offsets.tolist(), len(points), number).encode())
        for array in reversed(arrays):
            file.write(np.uint64(array.nbytes).tobytes())
            file.write(array.data)
        file.write(b"\n</AppendedData>\n</VTKFile>\n")


def _heading(sections, offsets, points, cells):
    places = iter(offsets)
    lines = [
        '<?xml version="1.0"?>',
        '<VTKFile type="UnstructuredGrid" version="1.0" '
        f'byte_order="{sys.byteorder.capitalize()}Endian" header_type="UInt64">',
        "<UnstructuredGrid>",
        f'<Piece NumberOfPoints="{points}" NumberOfCells="{cells}">',
    ]
    for section, arrays in sections.items():
        lines.append(f"<{section}>")
        for name, array in arrays.items():
            components = f' NumberOfComponents="{array.shape[1]}"' if array.ndim == 2 else ""
            lines.append(
                f'<DataArray type="{TYPES[array.dtype]}" Name="{escape(name)}"{components} '
                f'format="appended" offset="{next(places)}"/>'
            )
        lines.append(f"</{section}>")
    lines += ["</Piece>", "</UnstructuredGrid>", '<AppendedData encoding="raw">', "_"]
    return "\n".join(lines)


def _checked(fields, length):
    arrays = {name: np.ascontiguousarray(values) for name, values in fields.items()}
    for name, array in arrays.items():
        if array.ndim not in (1, 2) or len(array) != length:
            raise ValueError(f"field {name!r} of shape {array.shape} needs {length} rows")
        if array.dtype not in TYPES:
            raise TypeError(f"field {name!r} has the type {array.dtype}, unknown to VTK")
    return arrays


def _index_type(size):
    return np.int32 if size <= np.iinfo(np.int32).max else np.int64
