"""Gmsh files of boxes, made of any kind of element, in any version of the format."""

from itertools import product

import meshio
import numpy as np

from mpmgeo.bodies.elements import ELEMENTS

TETRAHEDRA = [(0, 1, 2, 6), (0, 2, 3, 6), (0, 3, 7, 6), (0, 7, 4, 6), (0, 4, 5, 6), (0, 5, 1, 6)]
"""Corners of the six tetrahedra of a hexahedron."""

FORMATS = [("2.2", False), ("2.2", True), ("4.1", False), ("4.1", True)]
KINDS = list(ELEMENTS)


def box(kind, cells=(2, 2, 2), low=(0, 0, 0), high=(1, 1, 1)):
    """Return points (p, 3) and elements (n, k) of a box cut into `cells` hexahedra, or these into
    tetrahedra."""
    step = (np.array(high, float) - low) / cells
    corners = np.array(ELEMENTS["hexahedron"].nodes + 1) / 2 * step
    origins = [np.array(low) + step * index for index in product(*map(range, cells))]
    nodes = np.array([origin + corners for origin in origins])
    linear = "hexahedron"
    if kind.startswith("tetra"):
        nodes = nodes[:, TETRAHEDRA].reshape(-1, 4, 3)
        linear = "tetra"
    nodes = ELEMENTS[linear].shape(ELEMENTS[kind].nodes) @ nodes
    points, number = np.unique(np.round(nodes.reshape(-1, 3), 12), axis=0, return_inverse=True)
    return points, number.reshape(nodes.shape[:2])


def mesh_of(groups, names=None, lift=None):
    """Return the meshio mesh of groups {name: [(kind, points, elements), …]}.

    `names`: {name: (number, dimension)} in place of consecutive volumes; `lift`: a map of points.
    """
    names = names or {name: (number, 3) for number, name in enumerate(groups, start=1)}
    points, blocks, physical, entity, owner = [], [], [], [], []
    for name, parts in groups.items():
        for kind, nodes, elements in parts:
            blocks.append((kind, elements + sum(map(len, points))))
            points.append(nodes)
            entity.append(np.full(len(elements), len(blocks)))
            physical.append(np.full(len(elements), names[name][0] if name else 0))
            owner += len(nodes) * [(3, len(blocks))]
    points = np.concatenate(points)
    return meshio.Mesh(
        points if lift is None else lift(points),
        blocks,
        point_data={"gmsh:dim_tags": np.array(owner)},
        cell_data={"gmsh:physical": physical, "gmsh:geometrical": entity},
        field_data={name: np.array(number) for name, number in names.items() if name},
    )


def write(path, mesh, version="2.2", is_binary=False):
    """Write a mesh as Gmsh does, and return its path."""
    meshio.gmsh.write(path, mesh, fmt_version=version, binary=is_binary)
    return path
