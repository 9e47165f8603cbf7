"""What acts on the particles in a box: a force that they share."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from mpmgeo.action import Action
from mpmgeo.parameters import Vector, parameter
from mpmgeo.region import Box


class ActionInBox(Action, Box):
    """An action on the particles that start in a closed box."""

    def idle(self, position: np.ndarray, body: np.ndarray, cell: np.ndarray) -> str | None:
        """Return that the box is empty, None if it is not."""
        return None if self.contains(position).any() else "no particle in the box; nothing happens"


@dataclass(frozen=True)
class BoxLoad(ActionInBox):
    """A constant total force, shared equally by the particles that start inside a closed box."""

    key: ClassVar[str] = "load_distributed_box"
    about: ClassVar[str] = "Forces shared by the particles in a box"

    load: Vector = parameter("Total force", unit="N")

    def particle_force(self, position: np.ndarray) -> np.ndarray:
        """Return the force (n, 3) [N] on particles that start at `position` (n, 3) [m].

        Without a particle in the box all forces are zero.
        """
        inside = self.contains(position)
        share = np.array(self.load) / max(np.count_nonzero(inside), 1)
        return inside[:, None] * share
