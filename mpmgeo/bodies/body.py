"""What every body declares and provides, whatever its particles come from."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from mpmgeo.bodies.cloud import Cloud
from mpmgeo.parameters import Counts, Placed, Vector, parameter


@dataclass(frozen=True)
class Body:
    """Particles that start together.

    Besides the members below a body has `materials`: the ids of its materials, each with the keys
    that lead to it in the JSON of the body. `is_listed`: its particles are listed one by one; they
    are created before those of all other bodies.
    """

    is_listed: ClassVar[bool] = False

    active: bool = parameter("Whether the body takes part in the simulation", default=True)
    initial_velocity: Vector = parameter(
        "Velocity of all particles at the start", unit="m/s", default=(0.0, 0.0, 0.0)
    )

    @property
    def labels(self) -> tuple[str, ...]:
        """Return what the numbered bodies that come of this one are, in messages."""
        return (self.type,)

    def complaints(self, cell: np.ndarray) -> Iterator[tuple[tuple, str]]:
        """Yield (keys, message) for all that only files and the cells, `cell` (3,) [m], show."""
        yield from ()

    def demand(self, cell: np.ndarray) -> tuple[float, float]:
        """Return about how many positions are looked at and particles made, 0 if files tell."""
        return 0.0, 0.0

    def clouds(self, cell: np.ndarray) -> tuple[Cloud, ...]:
        """Return the particles of each numbered body; `cell` (3,) is in m.

        Raises ValueError where `complaints` has something to say.
        """
        raise NotImplementedError


@dataclass(frozen=True)
class Filled(Body, Placed):
    """A geometry that is filled with particles of one material; subclasses `generate` them."""

    material_id: int = parameter("Number of the material the body consists of", names="materials")
    particles_per_direction: Counts = parameter(
        "Number of particles along each edge of a cell", minimum=1, default=(2, 2, 2)
    )

    @property
    def fullness(self) -> float:
        """Return about which share of the positions of the lattice becomes particles."""
        return 1.0

    @property
    def materials(self) -> dict[int, tuple]:
        """Return the materials in use, each with the keys that name it."""
        return {self.material_id: ("material_id",)}

    def demand(self, cell: np.ndarray) -> tuple[float, float]:
        """Return how many positions the lattice has, and about how many become particles."""
        number = self.lattice(cell).number
        return number, self.fullness * number

    def complaints(self, cell: np.ndarray) -> Iterator[tuple[tuple, str]]:
        """Yield (keys, message) if the geometry cannot be filled with particles."""
        try:
            self.lattice(cell)
        except ValueError as error:
            yield (), str(error)

    def holds(self, position: np.ndarray, cell: np.ndarray) -> np.ndarray:
        """Tell which of the positions (n, 3) [m] lie in what particles fill, if that is known."""
        return np.zeros(len(position), bool)

    def clouds(self, cell: np.ndarray) -> tuple[Cloud, ...]:
        """Return the particles of the one body."""
        return (self.generate(cell)._replace(material=self.material_id),)
