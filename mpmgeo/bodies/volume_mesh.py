"""The volume elements of a Gmsh mesh by physical group."""

from pathlib import Path
from typing import NamedTuple

import numpy as np

from mpmgeo.bodies.elements import ELEMENTS, Element
from mpmgeo.bodies.gmsh_file import GmshFile
from mpmgeo.positions import NOWHERE, shown

VOLUME, OTHERS = 3, (2, 1, 0)
"""Dimensions."""

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
    """A mesh file with groups of volumes; `groups` lists their names, `other_groups` those of
    groups of surfaces, curves and points. A group without a name is called by its number.

    Positions count from `zero` (3,) [m], not from the (0, 0, 0) of the file. Raises ValueError if
    the file is no mesh that can be read.
    """

    def __init__(self, path: Path | str, zero=NOWHERE):
        self.path, self.zero = path, zero
        self._file = GmshFile(path)
        self._tag = self._groups((VOLUME,))
        self.groups = tuple(self._tag)
        self.other_groups = tuple(n for n in self._groups(OTHERS) if n not in self._tag)
        self.has_names = any(name in self._file.names for name in self.groups)

    def _groups(self, dimensions):
        """Return the number of each group of some dimensions by its name."""
        names = self._file.names.items()
        named = {name: number for name, (number, d) in names if d in dimensions}
        numbers = sorted({n for d in dimensions for n in self._file.numbers(d)})
        plain = {str(n): n for n in numbers if n not in named.values()}
        return named | {name: n for name, n in plain.items() if name not in named}

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
        for index, block in enumerate(self._file.blocks):
            rows = self._file.members(index, self._tag[name]) if block.dim == VOLUME else ()
            if len(rows):
                yield block.type, block.data[rows]

    def _piece(self, name, kind, numbers):
        where = f'{self.path}: the group "{name}"'
        if kind not in ELEMENTS:
            known = ", ".join(ELEMENTS)
            raise ValueError(f"{where} holds elements of type {kind}; supported: {known}")
        if numbers.min() < 0:
            raise ValueError(f"{where} has elements whose nodes are not in the file")
        nodes = (self._file.points - self.zero)[numbers]
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
