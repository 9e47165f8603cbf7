"""What acts on the particles in a box: a force that they share."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from mpmgeo.action import Action
from mpmgeo.loads.in_time import InTime
from mpmgeo.parameters import Vector, parameter
from mpmgeo.region import Box


class ActionInBox(Action, Box):
    """An action on the particles that start in a closed box."""

    def idle(self, position: np.ndarray, body: np.ndarray, cell: np.ndarray) -> str | None:
        """Return that the box is empty, None if it is not."""
        return None if self.contains(position).any() else "no particle in the box; nothing happens"


@dataclass(frozen=True)
class ForceInBox(ActionInBox, InTime):
    """A force on the particles that start in a closed box, constant or with a factor in time."""

    def problems(self) -> Iterator[tuple[str, str]]:
        """Yield (key, message) for what is wrong with the box and with the factor."""
        yield from ActionInBox.problems(self)
        yield from InTime.problems(self)


@dataclass(frozen=True)
class BoxLoad(ForceInBox):
    """A total force, shared equally by the particles that start inside a closed box."""

    key: ClassVar[str] = "load_distributed_box"
    about: ClassVar[str] = "Forces shared by the particles in a box"

    load: Vector = parameter("Total force", unit="N")

    def particle_force(self, position: np.ndarray) -> np.ndarray:
        """Return the force (n, 3) [N] on particles that start at `position` (n, 3) [m], times one.

        Without a particle in the box all forces are zero.
        """
        inside = self.contains(position)
        share = np.array(self.load) / max(np.count_nonzero(inside), 1)
        return inside[:, None] * share
