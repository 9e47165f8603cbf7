"""The volume elements of a Gmsh mesh by physical group."""

from contextlib import contextmanager
from pathlib import Path
from typing import NamedTuple

import numpy as np

from mpmgeo.bodies.elements import ELEMENTS, Element
from mpmgeo.positions import NOWHERE, shown

VOLUME = 3
FOLDED = 0.1
"""Share of an element's volume that may be inside out, as near corners of curved elements."""


class Piece(NamedTuple):
    """Elements of one kind: their nodes (n, k, 3) [m] in VTK order and their volumes (n,) [m³]."""

    element: Element
    nodes: np.ndarray
    volume: np.ndarray

    @property
    def center(self) -> np.ndarray:
        """Return the middles of the elements (n, 3) [m]."""
        return self.element.points(self.nodes, self.element.center[None])[:, 0]


class Volume(NamedTuple):
    """The elements of a group, and how many more it shares with groups before it."""

    pieces: list[Piece]
    shared: int


class VolumeMesh:
    """A mesh file whose volumes have names; `groups` lists them, `other_groups` those of surfaces,
    curves and points.

    Positions count from `zero` (3,) [m], not from the (0, 0, 0) of the file. Raises ValueError if
    the file is no mesh that can be read.
    """

    def __init__(self, path: Path | str, zero=NOWHERE):
        self.path, self.zero = path, zero
        self._mesh = _read(path)
        names = self._mesh.field_data.items()
        self._tag = {name: tag for name, (tag, dimension) in names if dimension == VOLUME}
        self.groups = tuple(self._tag)
        self.other_groups = tuple(name for name, _ in names if name not in self._tag)

    def volumes(self, names) -> dict[str, Volume]:
        """Return the elements of some groups in the order of the file.

        An element of several groups belongs to the first of them. Raises ValueError if a group
        holds elements that are no linear or quadratic tetrahedra or hexahedra, or that are broken.
        """
        taken, found = {}, {}
        for name in names:
            members = list(self._members(name))
            if not members:
                raise ValueError(f'{self.path}: the group "{name}" has no elements')
            fresh = [(kind, _untaken(taken, kind, nodes)) for kind, nodes in members]
            shared = sum(len(old[1]) - len(new[1]) for old, new in zip(members, fresh, strict=True))
            pieces = [self._piece(name, kind, nodes) for kind, nodes in fresh if len(nodes)]
            found[name] = Volume(pieces, shared)
        return found

    def _members(self, name):
        """Yield kind and node numbers (n, k) of a group's elements, block by block."""
        sets, tags = self._mesh.cell_sets.get(name), self._mesh.cell_data.get("gmsh:physical")
        for index, block in enumerate(self._mesh.cells):
            if block.dim != VOLUME:
                continue
            if sets is not None:
                rows = sets[index]
            elif tags is not None:
                rows = np.flatnonzero(tags[index] == self._tag[name])
            else:
                rows = ()
            if len(rows):
                yield block.type, block.data[np.asarray(rows, np.int64)]

    def _piece(self, name, kind, numbers):
        where = f'{self.path}: the group "{name}"'
        if kind not in ELEMENTS:
            known = ", ".join(ELEMENTS)
            raise ValueError(f"{where} holds elements of type {kind}; supported: {known}")
        if numbers.min() < 0:
            raise ValueError(f"{where} has elements whose nodes are not in the file")
        nodes = (np.asarray(self._mesh.points, float) - self.zero)[numbers]
        if not np.isfinite(nodes).all():
            raise ValueError(f"{where} has nodes whose coordinates are not finite")
        element = ELEMENTS[kind]
        shares = element.shares(nodes, element.volume_rule)
        volume = shares.sum(axis=1)
        # the numbering of an inside-out element is mirrored, which leaves its volume as it is
        size = np.abs(volume)
        broken = ~(size > 0) | (np.abs(shares).sum(axis=1) > (1 + 2 * FOLDED) * size)
        if broken.any():
            number, first = np.count_nonzero(broken), int(broken.argmax())
            near = shown(nodes[first].mean(axis=0), self.zero)
            problem = f"{number} {kind} without volume or folded"
            raise ValueError(f"{where} has {problem}, one at {near}")
        return Piece(element, nodes, size)


def _untaken(taken, kind, numbers):
    """Return the elements (n, k) that were not there before, and remember them."""
    key = np.sort(numbers, axis=1)
    before = taken.get(kind, key[:0])
    _, first = np.unique(np.concatenate([before, key]), axis=0, return_index=True)
    fresh = np.sort(first[first >= len(before)]) - len(before)
    taken[kind] = np.concatenate([before, key[fresh]])
    return numbers[fresh]


def _read(path):
    """Return the meshio mesh of a file; raises ValueError if it has none."""
    from meshio.gmsh import read

    try:
        with _tolerance():
            return read(path)
    except OSError as error:
        raise ValueError(f"{path}: cannot be read ({error.strerror})") from None
    except Exception as error:  # whatever meshio trips over in a file that is no mesh
        reason = f" ({error})" if str(error) else ""
        raise ValueError(f"{path}: no Gmsh mesh that can be read{reason}") from None


@contextmanager
def _tolerance():
    """Let meshio read files of version 4.1 in which only some elements have a physical group.

    It leaves the others out of the list of groups and then refuses the mesh for its length.
    """
    from meshio.gmsh import _gmsh41

    strict = _gmsh41.Mesh

    def tolerant(points, cells, cell_data, **others):
        whole = {key: data for key, data in cell_data.items() if len(data) == len(cells)}
        return strict(points, cells, cell_data=whole, **others)

    _gmsh41.Mesh = tolerant
    try:
        yield
    finally:
        _gmsh41.Mesh = strict
