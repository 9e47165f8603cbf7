"""A prescribed velocity of a body, of the particles in a box or of a plane of the mesh."""

from bisect import bisect_right
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from math import inf, nan
from pathlib import Path
from typing import ClassVar

import numpy as np

from mpmgeo.action import Action
from mpmgeo.loads.table import Form, read_table
from mpmgeo.naming import PLANES, name_problems
from mpmgeo.parameters import Components, Placed, Vector, parameter
from mpmgeo.region import turned, within

FORM = Form("three velocities", may_be_free=True)


@dataclass(frozen=True)
class Motion:
    """Velocities at increasing instants, linear between them, the first before and the last after.

    time (m,) [s]; velocity (m, 3) [m/s], NaN in components that are free.
    """

    time: np.ndarray
    velocity: np.ndarray

    @cached_property
    def _rows(self):
        # plain numbers: a run asks for two instants a step
        return self.time.tolist(), [tuple(row) for row in self.velocity.tolist()]

    def displacement(self, t: float) -> np.ndarray:
        """Return the way (3,) [m] from time 0 to time t [s], at least 0."""
        inner = self.time[(self.time > 0) & (self.time < t)].tolist()
        instants = np.array([0.0, *inner, t])
        velocity = np.array([self.at(instant) for instant in instants])
        return (np.diff(instants)[:, None] * (velocity[1:] + velocity[:-1]) / 2).sum(axis=0)

    def at(self, t: float) -> tuple[float, float, float]:
        """Return the velocity [m/s] at time t [s]."""
        time, rows = self._rows
        after = bisect_right(time, t)
        if after in (0, len(time)):
            return rows[0 if after == 0 else -1]
        share = (t - time[after - 1]) / (time[after] - time[after - 1])
        return tuple(
            (1 - share) * a + share * b for a, b in zip(rows[after - 1], rows[after], strict=True)
        )


@dataclass(frozen=True)
class PrescribedVelocity(Action, Placed):
    """A velocity that particles or the nodes of a plane keep, whatever the forces."""

    key: ClassVar[str] = "prescribed_velocity"
    about: ClassVar[str] = "Velocities that bodies, particles in a box or planes of the mesh keep"
    called: ClassVar[str | None] = "prescribed_velocity"

    name: str = parameter("Name of the file of its history, in the folder reactions", default="")
    body: int | None = parameter("Number of a body, from 1", minimum=1, names="body", default=None)
    point_p1: Vector | None = parameter(
        "Corner of lowest coordinates of a box; the particles that start in it are meant",
        unit="m",
        place=True,
        default=None,
    )
    point_p2: Vector | None = parameter(
        "Corner of highest coordinates of the box", unit="m", place=True, default=None
    )
    plane: str | None = parameter("Plane of the mesh", choices=PLANES, default=None)
    velocity: Components | None = parameter(
        "Constant velocity; null leaves a component free", unit="m/s", default=None
    )
    file: Path | None = parameter(
        "Text file with the columns time [s] and velocity x, y, z [m/s]; "
        "an empty column leaves a component free",
        file=True,
        default=None,
    )
    every: int = parameter("Steps between two rows of the history", minimum=1, default=10)

    def problems(self) -> Iterator[tuple[str, str]]:
        """Yield (key, message) unless one target and one velocity are given."""
        yield from name_problems(self.name)
        box = (self.point_p1, self.point_p2)
        targets = [self.body is not None, any(box), self.plane is not None]
        if sum(targets) != 1:
            yield "body", 'needs one of "body", "plane" or "point_p1" with "point_p2"'
        if any(box) and not all(box):
            yield "point_p2", "point_p1 and point_p2 are given together"
        elif all(box):
            yield from turned(*box)
        if (self.velocity is None) == (self.file is None):
            yield "velocity", 'needs either "velocity" or "file"'
        if self.velocity is not None and all(v is None for v in self.velocity):
            yield "velocity", "leaves all components free"

    @cached_property
    def motion(self) -> Motion:
        """Return the velocity over time; raises ValueError for a file that cannot be used."""
        if self.file is None:
            constant = [nan if v is None else v for v in self.velocity]
            return Motion(np.zeros(1), np.array([constant], float))
        table = read_table(self.file, FORM)
        if np.isnan(table.values).all():
            raise ValueError(f"{self.file}: all components are free")
        return Motion(table.time, table.values)

    def complaints(self) -> Iterator[tuple[str, str]]:
        """Yield (key, message) if the file cannot be used."""
        try:
            _ = self.motion
        except ValueError as error:
            yield "file", str(error)

    @property
    def side(self) -> tuple[int, int] | None:
        """Return axis and side (0 lower, 1 upper) of the plane, None for particles."""
        return None if self.plane is None else (PLANES.index(self.plane) % 3, self.plane[1] == "n")

    def chooses(self, position: np.ndarray, body: np.ndarray) -> np.ndarray:
        """Tell which particles are meant: initial position (n, 3) [m], number of the body (n,)."""
        if self.plane is not None:
            return np.zeros(len(position), bool)
        if self.body is not None:
            return body == self.body
        return within(self.point_p1, self.point_p2, position, self.zero)

    def idle(self, position: np.ndarray, body: np.ndarray, cell: np.ndarray) -> str | None:
        """Return that neither a plane nor a particle is meant, None if one is."""
        if self.plane is not None or self.chooses(position, body).any():
            return None
        return "no particle is meant; nothing happens"

    def ends(self) -> tuple[str, float]:
        """Return when the table ends [s]; a constant velocity does not."""
        return "table", inf if self.file is None else float(self.motion.time[-1])
