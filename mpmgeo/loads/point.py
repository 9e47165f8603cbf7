"""A force on one node of the grid."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from mpmgeo.action import Action
from mpmgeo.naming import GHOSTS
from mpmgeo.parameters import Vector, parameter

ROUND_OFF = 1e-9

REACH = 1.5
"""Cells between a particle and the nodes that it still carries mass to."""


@dataclass(frozen=True)
class PointLoad(Action):
    """A constant force on the node nearest to a point."""

    key: ClassVar[str] = "nodal_point_load"
    about: ClassVar[str] = "Forces on single nodes, each [[x, y, z], [Fx, Fy, Fz]]"
    may_be_list: ClassVar[bool] = True
    in_mesh: ClassVar[tuple[str, ...]] = ("position",)

    position: Vector = parameter("Point whose nearest node carries the force", unit="m")
    force: Vector = parameter("Force", unit="N")

    def node(self, origin: np.ndarray, cell: np.ndarray) -> np.ndarray:
        """Return the index (3,) of the nearest node, counted with two ghost layers.

        `origin` (3,) is the lower corner of the mesh [m], `cell` (3,) the size of its cells [m];
        halfway between two nodes the upper one is taken.
        """
        distance = (np.array(self.position) - origin) / cell
        return np.floor(distance + 0.5 + ROUND_OFF).astype(np.int64) + GHOSTS

    def idle(self, position: np.ndarray, body: np.ndarray, cell: np.ndarray) -> str | None:
        """Return that no particle is near, None if one is."""
        near = (np.abs(position - self.position) / cell < REACH).all(axis=1)
        if near.any():
            return None
        return f"no particle near {list(self.position)}; the force has no effect until one comes"
