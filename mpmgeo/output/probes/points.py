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

    points: tuple[Vector, ...] = parameter("The points", unit="m")
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

    def __init__(self, solver, fields, points, names):
        self.solver, self.fields, self.points = solver, fields, points
        self.columns = [f"{n}.{c}" for n in names for c in components(solver, fields)]
        mesh = solver.grid.mesh
        self._cell = np.array([mesh.hx, mesh.hy, mesh.hz])

    def row(self):
        """Return the values now."""
        return np.concatenate([self._at(point) for point in self.points])

    def _at(self, point):
        solver, near, found = self.solver, [], []
        for s in solver.sets:
            at = particles_within(solver, s, point - self._cell, point + self._cell)
            distance = np.abs(s.x[at] - point) / self._cell
            weight = s.V[at] * np.maximum(1 - distance, 0.0).prod(axis=1)
            at, weight = at[weight > 0], weight[weight > 0]
            near.append(np.column_stack([s.x[at], weight]))
            found.append(values(solver, s, self.fields, at))
        near, found = np.concatenate(near), np.concatenate(found)
        group = np.zeros(len(near), np.int64)
        return linear_fit(point[None], group, near[:, :3], near[:, 3], found)[0]
