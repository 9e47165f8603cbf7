"""Particles that the case lists itself."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from mpmgeo.bodies.body import Body
from mpmgeo.bodies.cloud import Cloud
from mpmgeo.parameters import Vector, parameter


@dataclass(frozen=True)
class Listing:
    """Particles as columns; the shortest way to say how many is the list `id`."""

    id: tuple[int, ...] | None = parameter(
        "Only its length counts: the number of particles; absent: that of the positions",
        default=None,
    )
    position: tuple[Vector, ...] = parameter("Centres of the particles", unit="m", place=True)
    volume: tuple[float, ...] = parameter("Volumes of the particles", unit="m³", above=0)
    material_id: tuple[int, ...] | None = parameter(
        "Numbers of the particles' materials", default=None
    )

    @property
    def number(self) -> int:
        """Return how many particles there are; columns may be longer."""
        return len(self.position if self.id is None else self.id)

    @property
    def surplus(self) -> tuple[str, ...]:
        """Return one sentence for each column that is longer than needed."""
        return tuple(
            f"particles.{key} has {length} entries, of which the first {self.number} count"
            for key, length in self._lengths()
            if length > self.number
        )

    def problems(self) -> Iterator[tuple[str, str]]:
        """Yield (key, message) for every column that is too short."""
        for key, length in self._lengths():
            if length < self.number:
                yield key, f"has {length} entries for {self.number} particles"

    def _lengths(self):
        columns = ((key, getattr(self, key)) for key in ("position", "volume", "material_id"))
        return [(key, len(column)) for key, column in columns if column is not None]


@dataclass(frozen=True)
class Particles(Body):
    """Single particles, each with its own volume and, if wanted, its own material."""

    type: ClassVar[str] = "particles"
    is_listed: ClassVar[bool] = True

    particles: Listing = parameter("The particles")
    material_id: int | None = parameter(
        "Number of the material of all particles, in place of their own",
        names="materials",
        default=None,
    )

    def problems(self) -> Iterator[tuple[str, str]]:
        """Yield (key, message) if the particles have no material."""
        if self.material_id is None and self.particles.material_id is None:
            yield "particles", "material_id is missing, here or as one number for the whole body"

    @property
    def materials(self) -> dict[int, tuple]:
        """Return the materials in use, each with the keys that name it."""
        if self.material_id is not None:
            return {self.material_id: ("material_id",)}
        first = {}
        for index, number in enumerate(self.particles.material_id[: self.particles.number]):
            first.setdefault(number, ("particles", "material_id", index))
        return first

    def clouds(self, cell: np.ndarray) -> tuple[Cloud, ...]:
        """Return the particles as cubes, whatever the cells."""
        listing, first = self.particles, slice(self.particles.number)
        material = self.material_id
        if material is None:
            material = np.array(listing.material_id[first], np.int64)
        cloud = cubes(listing.position[first], listing.volume[first], material)
        return (cloud._replace(notes=listing.surplus),)


def cubes(position, volume, material) -> Cloud:
    """Return cubic particles at `position` (n, 3) [m] with `volume` (n,) [m³]."""
    position = np.array(position, dtype=np.float64).reshape(-1, 3)
    edge = np.cbrt(np.asarray(volume, dtype=np.float64))
    return Cloud(position, np.repeat(edge[:, None], 3, axis=1), material=material)
