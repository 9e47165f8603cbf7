"""Read a file of Gmsh by meshio, and what meshio leaves out: which elements belong to which group.

A physical group has a number; a name is given to it apart, or not at all.
"""

from contextlib import contextmanager
from pathlib import Path

import numpy as np


class GmshFile:
    """A mesh file: `points` (p, 3) [m], `blocks` of elements of one kind, `names` of groups.

    `names`: {name: (number, dimension)}. Raises ValueError if the file cannot be read.
    """

    def __init__(self, path: Path | str):
        mesh, self._entities = _read(path)
        self.points, self.blocks = np.asarray(mesh.points, float), mesh.cells
        found = mesh.field_data.items()
        self.names = {name: (int(number), int(dimension)) for name, (number, dimension) in found}
        self._data = mesh.cell_data

    def numbers(self, dimension: int) -> list[int]:
        """Return the numbers of the groups that hold elements of a dimension, in order."""
        indices = [i for i, block in enumerate(self.blocks) if block.dim == dimension]
        return sorted({n for i in indices for n in self._of_block(i) if n > 0})

    def members(self, index: int, number: int) -> np.ndarray:
        """Return the rows of a block whose elements belong to the group of a number."""
        tags = self._tags_of_entity(index)
        if tags is not None:
            return np.arange(len(self.blocks[index].data) if number in tags else 0)
        data = self._data.get("gmsh:physical")
        return np.flatnonzero(data[index] == number) if data else np.arange(0)

    def _of_block(self, index):
        tags = self._tags_of_entity(index)
        data = self._data.get("gmsh:physical")
        return np.unique(data[index]).tolist() if tags is None and data else tags or ()

    def _tags_of_entity(self, index):
        """Return the groups of a block in a file whose entities, not elements, are in groups."""
        entity = self._data.get("gmsh:geometrical")
        if self._entities is None or not entity or not len(entity[index]):
            return None
        of_dimension = self._entities[self.blocks[index].dim]
        return [abs(int(tag)) for tag in of_dimension.get(int(entity[index][0]), ())]


def _read(path):
    """Return the meshio mesh of a file, and the groups of its entities, None without."""
    from meshio import ReadError
    from meshio.gmsh import read

    entities = []
    try:
        with _listening(entities):
            mesh = read(path)
    except OSError as error:
        raise ValueError(f"{path}: cannot be read ({error.strerror})") from None
    except ReadError as error:
        reason = f" ({error})" if str(error) else ""
        raise ValueError(f"{path}: no Gmsh mesh that can be read{reason}") from None
    except Exception:  # whatever meshio trips over in a file that is no mesh
        reason = "it is damaged, cut short, or has sections that do not fit together"
        raise ValueError(f"{path}: no Gmsh mesh that can be read ({reason})") from None
    return mesh, entities[-1] if entities else None


@contextmanager
def _listening(entities):
    """Let meshio read files of version 4.1 in which only some elements have a physical group.

    It leaves the others out of the list of groups and then refuses the mesh for its length. The
    groups of the entities by dimension, which it drops, are added to `entities`.
    """
    from meshio.gmsh import _gmsh41

    strict, read = _gmsh41.Mesh, _gmsh41._read_entities

    def tolerant(points, cells, cell_data, **others):
        whole = {key: data for key, data in cell_data.items() if len(data) == len(cells)}
        return strict(points, cells, cell_data=whole, **others)

    def noted(*arguments):
        tags, bounds = read(*arguments)
        entities.append(tags)
        return tags, bounds

    _gmsh41.Mesh, _gmsh41._read_entities = tolerant, noted
    try:
        yield
    finally:
        _gmsh41.Mesh, _gmsh41._read_entities = strict, read
