"""A force on one node of the grid."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from mpmgeo.action import Action
from mpmgeo.effect import Effect
from mpmgeo.loads.in_time import InTime
from mpmgeo.naming import GHOSTS
from mpmgeo.parameters import Placed, Vector, parameter
from mpmgeo.positions import resolution
from mpmgeo.state.grid import keys_of
from mpmgeo.state.layout import NODES, SIDE, inner, place, volume

ROUND_OFF = 1e-9

REACH = 1.5
"""Cells between a particle and the nodes that it still carries mass to."""


@dataclass(frozen=True)
class PointLoad(Action, Placed, InTime):
    """A force on the node nearest to a point."""

    key: ClassVar[str] = "nodal_point_load"
    about: ClassVar[str] = "Forces on single nodes, each [[x, y, z], [Fx, Fy, Fz]]"
    may_be_list: ClassVar[bool] = True
    in_mesh: ClassVar[tuple[str, ...]] = ("point",)

    point: Vector = parameter("Point whose nearest node carries the force", unit="m", place=True)
    force: Vector = parameter("Force", unit="N")

    def node(self, cell: np.ndarray) -> np.ndarray:
        """Return the index (3,) of the nearest node, counted with two ghost layers.

        The point is that in the mesh, `cell` (3,) the size of its cells [m]; halfway between two
        nodes the upper one is taken.
        """
        slack = np.maximum(ROUND_OFF, resolution(self.zero, self.point) / cell)
        return np.floor(np.array(self.point) / cell + 0.5 + slack).astype(np.int64) + GHOSTS

    def idle(self, position: np.ndarray, body: np.ndarray, cell: np.ndarray) -> str | None:
        """Return that no particle is near, None if one is."""
        near = (np.abs(position - self.point) / cell < REACH).all(axis=1)
        if near.any():
            return None
        place = np.add(self.point, self.zero).tolist()
        return f"no particle near {place}; the force has no effect until one comes"

    @classmethod
    def effect(cls, loads, mesh):
        """Return what puts the forces on their nodes, None without loads."""
        if not loads:
            return None
        cell = np.array([mesh.hx, mesh.hy, mesh.hz])
        nodes = [load.node(cell) - GHOSTS for load in loads]
        courses = [load.course for load in loads]
        return PointLoads(nodes, [load.force for load in loads], courses)


class PointLoads(Effect):
    """Forces (k, 3) [N] on the nodes of index (k, 3).

    `courses` (k,): the factor in time of each, None for one that is constant.
    """

    name = "point loads"

    def __init__(self, node, force, courses=()):
        self.node = np.asarray(node, np.int64)
        self.force = np.asarray(force, float)
        self._whole = self.force
        self._courses = [(k, course) for k, course in enumerate(courses) if course is not None]
        self._keys = None

    def _find(self, grid):
        """Find a tile that covers each node, and the node's record among those of all tiles."""
        corner = self.node // SIDE
        self._keys = grid.keys
        self._owner = np.full(len(self.node), -1)
        self._at, self._record = np.zeros((2, len(self.node)), np.int64)
        for index, key in enumerate(keys_of(corner)):
            block = np.searchsorted(grid.active, key)
            if block == len(grid.active) or grid.active[block] != key:
                continue
            for owner in grid.below[block]:
                local = self.node[index] - grid.corner[owner] * SIDE
                if owner >= 0 and (local < grid.rows).all():
                    self._owner[index] = owner
                    self._at[index] = owner * volume(grid.rows) + place(grid.rows, *local)
                    self._record[index] = block * NODES + inner(grid.rows, *self.node[index] % SIDE)
                    break

    def _scale(self, t):
        """Give the forces their values at time t [s]."""
        if self._courses:
            self.force = self._whole.copy()
        for k, course in self._courses:
            self.force[k] *= course.at(t)

    def before_nodes(self, solver, task):
        """Add the forces to the tiles; one on a node that no tile covers does nothing."""
        grid = solver.grid
        self._scale(solver.time)
        if self._keys is not grid.keys:
            self._find(grid)
        covered = self._owner >= 0
        np.add.at(grid.solid.in_tiles("force"), self._at[covered], self.force[covered])

    def after_nodes(self, solver, h):
        """Add the work of the forces to a ledger."""
        if solver.ledger is not None:
            solver.ledger.put_in(self.work(solver, h))

    def work(self, solver, h):
        """Return the work [J] of the forces in a step whose nodes have their velocities."""
        covered = self._owner >= 0
        of_node, at = solver.grid.solid.at_nodes, self._record[covered]
        v = of_node("velocity")[at] - 0.5 * h * of_node("acceleration")[at]
        return h * float((self.force[covered] * v).sum())

    def news(self, solver):
        """Tell, once the nodes have their masses, of loads that act on nothing."""
        yield (
            "point loads",
            lambda: [
                f"nodal_point_load, entry {number}: its node carries no mass at the start; "
                "the force acts only while material is there"
                for number in np.flatnonzero(self.idle(solver.grid)) + 1
            ],
        )

    def idle(self, grid):
        """Return which loads (k,) act on a node without mass, and so on nothing."""
        mass = np.zeros(len(self.node))
        known, keys = grid.solid.at_nodes("mass"), keys_of(self.node // SIDE)
        for index, (key, at) in enumerate(zip(keys, self.node % SIDE, strict=True)):
            block = np.searchsorted(grid.active, key)
            if block < len(grid.active) and grid.active[block] == key:
                mass[index] = known[block * NODES + inner(grid.rows, *at)]
        return mass == 0.0
