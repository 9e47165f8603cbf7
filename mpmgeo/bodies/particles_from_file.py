"""Particles that a file lists."""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import ClassVar

import numpy as np

from mpmgeo.bodies.body import Body
from mpmgeo.bodies.cloud import Cloud
from mpmgeo.bodies.particle_file import ParticleTable, read_particles
from mpmgeo.bodies.particles import cubes
from mpmgeo.parameters import Placed, parameter


@dataclass(frozen=True)
class ParticlesFromFile(Body, Placed):
    """Particles of a JSON file: a list of objects with `position`, `volume` and `material_id`."""

    type: ClassVar[str] = "particles_from_file"
    is_listed: ClassVar[bool] = True

    file: Path = parameter("The file", file=True)
    material_id: int | None = parameter(
        "Number of the material of all particles, in place of their own",
        names="materials",
        default=None,
    )

    @cached_property
    def table(self) -> ParticleTable:
        """Return the content of the file; raises ValueError if it is wrong."""
        table = read_particles(self.file, self.material_id)
        return table._replace(position=table.position - self.zero)

    @property
    def materials(self) -> dict[int, tuple]:
        """Return the materials in use, each with the keys that name it."""
        if self.material_id is not None:
            return {self.material_id: ("material_id",)}
        return dict.fromkeys(np.unique(self.table.material).tolist(), ("file",))

    def complaints(self, cell: np.ndarray) -> Iterator[tuple[tuple, str]]:
        """Yield (keys, message) for what is wrong with the file."""
        try:
            _ = self.table
        except ValueError as error:
            yield ("file",), str(error)

    def clouds(self, cell: np.ndarray) -> tuple[Cloud, ...]:
        """Return the particles as cubes, whatever the cells."""
        return (cubes(*self.table),)


@dataclass(frozen=True)
class ParticlesList(ParticlesFromFile):
    """The same as `particles_from_file`, by its other name."""

    type: ClassVar[str] = "particles_list"
