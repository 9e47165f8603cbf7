"""Histories at points."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from mpmgeo.numerics.fit import linear_fit
from mpmgeo.output.probes.particles import Followed
from mpmgeo.output.probes.probe import FieldProbe, components, particles_within, values
from mpmgeo.parameters import Vector, parameter


@dataclass(frozen=True)
class PointProbe(FieldProbe):
    """Fields at points of space, or of the particles that start nearest to them."""

    type: ClassVar[str] = "points"

    points: tuple[Vector, ...] = parameter("The points", unit="m", place=True)
    interpolation: str = parameter(
        "linear: at the point, a linear fit to the particles within a cell's size of it, whichever "
        "they are; nearest: of the particle that starts nearest to it, wherever it goes",
        choices=("linear", "nearest"),
        default="linear",
    )

    def problems(self):
        """Yield (key, message) if there is no point, no field or no usable name."""
        yield from super().problems()
        if not self.points:
            yield "points", "needs at least one point"

    def sampler(self, simulation):
        """Return what takes the samples."""
        names = [f"point{number}" for number in range(1, len(self.points) + 1)]
        if self.interpolation == "linear":
            return Interpolated(simulation.solver, self.fields, np.array(self.points), names)
        start = simulation.solver.population.position
        rows = [int(((start - point) ** 2).sum(axis=1).argmin()) for point in self.points]
        return Followed(simulation.solver, self.fields, rows, names)


class Interpolated:
    """Fields at points (k, 3) [m] that stay; NaN where no particle is within a cell's size."""

    looks_by_place = True

    def __init__(self, solver, fields, points, names):
        self.solver, self.fields, self.points = solver, fields, points
        self.columns = [f"{n}.{c}" for n in names for c in components(solver, fields)]
        mesh = solver.grid.mesh
        self._cell = np.array([mesh.hx, mesh.hy, mesh.hz])

    def row(self):
        """Return the values now."""
        near, found = [], []
        for s in self.solver.sets:
            at, group, weight = self._neighbours(s)
            near.append((group, s.x[at], weight))
            found.append(values(self.solver, s, self.fields, at))
        group, position, weight = map(np.concatenate, zip(*near, strict=True))
        found = np.concatenate(found)
        return linear_fit(self.points, group, position, weight, found).ravel()

    def _neighbours(self, s):
        """Return indices of particles of a set, the points that they are near to, their weights."""
        low, high = self.points - self._cell, self.points + self._cell
        near = [particles_within(self.solver, s, *box) for box in zip(low, high, strict=True)]
        group = np.repeat(np.arange(len(near)), [len(at) for at in near])
        at = np.concatenate(near)
        distance = np.abs(s.x[at] - self.points[group]) / self._cell
        weight = s.V[at] * np.maximum(1 - distance, 0.0).prod(axis=1)
        counts = weight > 0
        return at[counts], group[counts], weight[counts]
