"""Bodies from a mesh of Gmsh."""

from collections.abc import Iterator
from dataclasses import dataclass
from difflib import get_close_matches
from functools import cached_property
from pathlib import Path
from typing import ClassVar

import numpy as np

from mpmgeo.bodies.body import Body
from mpmgeo.bodies.cloud import Cloud
from mpmgeo.bodies.lattice import too_many
from mpmgeo.parameters import Counts, Placed, parameter
from mpmgeo.positions import resolution


@dataclass(frozen=True)
class Gmsh(Body, Placed):
    """The physical groups of volumes of a Gmsh mesh: each becomes a body of its own."""

    type: ClassVar[str] = "gmsh"

    mesh_file: Path = parameter("Mesh of Gmsh, version 2.2 or 4.1, text or binary", file=True)
    physical_to_material: dict[str, int] = parameter(
        "Name of a physical group of volumes, or its number in quotes if it has no name → number "
        "of its material; 0 or less: left out",
        names="materials",
    )
    particle_distribution: str = parameter(
        "Where the particles of an element are: one in its middle, one at each Gauss point, or as "
        "many as particles_per_direction puts into the cells of the grid",
        choices=("barycentric", "gaussian", "per_cell"),
        default="barycentric",
    )
    particles_per_direction: Counts = parameter(
        "Number of particles along each edge of a cell with per_cell", minimum=1, default=(2, 2, 2)
    )

    def problems(self) -> Iterator[tuple[str, str]]:
        """Yield (key, message) if no group is used."""
        if not self._groups:
            yield "physical_to_material", "names no group with a material above 0"

    @property
    def _groups(self):
        """Names of the groups that become bodies, in alphabetical order."""
        return sorted(name for name, id in self.physical_to_material.items() if id > 0)

    @property
    def labels(self) -> tuple[str, ...]:
        """Return what messages call the bodies, one name each."""
        return tuple(f'gmsh, "{name}"' for name in self._groups)

    @property
    def materials(self) -> dict[int, tuple]:
        """Return the materials in use, each with the keys that name it."""
        places = {self.physical_to_material[name]: name for name in reversed(self._groups)}
        return {id: ("physical_to_material", name) for id, name in places.items()}

    @cached_property
    def _mesh(self):
        from mpmgeo.bodies.volume_mesh import VolumeMesh

        return VolumeMesh(self.mesh_file, self.zero)

    @cached_property
    def _volumes(self):
        return self._mesh.volumes(self._groups)

    def complaints(self, cell: np.ndarray) -> Iterator[tuple[tuple, str]]:
        """Yield (keys, message) for what is wrong with the file."""
        try:
            unknown = list(self._unknown(self._mesh))
            yield from unknown
            if not unknown and (message := too_many(self.demand(cell)[0])):
                yield ("particles_per_direction",), message
        except ValueError as error:
            yield ("mesh_file",), str(error)

    def _unknown(self, mesh):
        """Yield a complaint if there are no groups of volumes, or one for each unknown name."""
        if not mesh.groups:
            yield (
                ("mesh_file",),
                f"{mesh.path} has no physical group of volumes; make them in Gmsh "
                "(Physical Volume) and save the mesh again",
            )
            return
        known = ", ".join(f'"{name}"' for name in mesh.groups)
        if not mesh.has_names and not set(self._groups) <= set(mesh.groups):
            text = f"{mesh.path} has no physical group of volumes with a name, but with a number"
            yield ("mesh_file",), f"{text} alone, which can be used as its name: {known}"
        for name in self._groups:
            if name in mesh.other_groups:
                text = f"a group of the mesh, but not of volumes; those are {known}"
            elif name not in mesh.groups:
                near = get_close_matches(name, mesh.groups, n=1)
                hint = f'; did you mean "{near[0]}"?' if near else ""
                text = f"no physical group of the mesh, which has {known}{hint}"
            else:
                continue
            yield ("physical_to_material", name), text

    def demand(self, cell: np.ndarray) -> tuple[float, float]:
        """Return how many particles fill the elements with per_cell, 0 otherwise; as positions too.

        Raises ValueError if the file is wrong.
        """
        pieces = [piece for volume in self._volumes.values() for piece in volume.pieces]
        if self.particle_distribution != "per_cell":
            return 0.0, 0.0
        spacing = cell / self.particles_per_direction
        number = sum(float(piece.volume.sum()) for piece in pieces) / float(spacing.prod())
        return number, number

    def clouds(self, cell: np.ndarray) -> tuple[Cloud, ...]:
        """Return the particles of each group; raises ValueError if the file is wrong."""
        pieces = [piece for volume in self._volumes.values() for piece in volume.pieces]
        start = np.min([piece.nodes.min(axis=(0, 1)) for piece in pieces], axis=0)
        return tuple(
            self._cloud(volume, cell, start, self.physical_to_material[name])
            for name, volume in self._volumes.items()
        )

    def _cloud(self, group, cell, start, material):
        """Return the particles of a group: boxes of the cells' shape with the volume of each."""
        notes = []
        if group.shared:
            notes.append(f"{group.shared} of its elements belong to a body before it, too")
        position, volume = self._particles(group.pieces, cell, start)
        wide = np.count_nonzero(volume > cell.prod() * (1 + 1e-9))
        if wide and self.particle_distribution != "per_cell":
            notes.append(
                f"{wide} of {len(volume)} particles have more volume than a cell and leave gaps; "
                'a "particle_distribution" of "per_cell" fills the elements'
            )
        size = cell * np.cbrt(volume / cell.prod())[:, None]
        return Cloud(position, size, tuple(notes), material)

    def _particles(self, pieces, cell, start):
        """Return positions (n, 3) [m] and volumes (n,) [m³]."""
        if not pieces:
            return np.empty((0, 3)), np.empty(0)
        if self.particle_distribution == "per_cell":
            from mpmgeo.bodies.filling import fill

            known = max(resolution(self.zero, p.nodes.reshape(-1, 3)).max() for p in pieces)
            return fill(pieces, start, cell / self.particles_per_direction, known)
        parts = [
            _at_gauss_points(piece)
            if self.particle_distribution == "gaussian"
            else (piece.center, piece.volume)
            for piece in pieces
        ]
        positions, volumes = zip(*parts, strict=True)
        return np.concatenate(positions), np.concatenate(volumes)


def _at_gauss_points(piece):
    """Return position and volume of a particle at each Gauss point, element by element."""
    rule = piece.element.gauss_rule
    share = np.abs(piece.element.shares(piece.nodes, rule))
    share *= (piece.volume / share.sum(axis=1))[:, None]
    return piece.element.points(piece.nodes, rule.points).reshape(-1, 3), share.ravel()
