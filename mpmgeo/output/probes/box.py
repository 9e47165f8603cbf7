"""Histories of all particles in a box."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from mpmgeo.output.probes.probe import FieldProbe, components, particles_within, values
from mpmgeo.parameters import Placed, Vector, parameter
from mpmgeo.region import bounds, turned


@dataclass(frozen=True)
class BoxProbe(FieldProbe, Placed):
    """Mean or sum of fields over the particles that are in a closed box at the time."""

    type: ClassVar[str] = "box"

    point_p1: Vector = parameter("Corner of lowest coordinates", unit="m", place=True)
    point_p2: Vector = parameter("Corner of highest coordinates", unit="m", place=True)
    reduction: str = parameter(
        "mean: weighted by volume; sum: of the particles' values",
        choices=("mean", "sum"),
        default="mean",
    )

    def problems(self) -> Iterator[tuple[str, str]]:
        """Yield (key, message) if the box is turned round, or there is no field or usable name."""
        yield from super().problems()
        yield from turned(self.point_p1, self.point_p2)

    def sampler(self, simulation):
        """Return what takes the samples."""
        return Reduced(simulation.solver, self)


class Reduced:
    """The number of particles in a box and the mean or sum of their fields."""

    looks_by_place = True

    def __init__(self, solver, probe):
        self.solver, self.probe = solver, probe
        self._bounds = bounds(probe.point_p1, probe.point_p2, probe.zero)
        self.columns = ["particles", *components(solver, probe.fields)]

    def row(self):
        """Return the values now; the mean of no particles is NaN."""
        probe = self.probe
        count, weight, total = 0, 0.0, np.zeros(len(self.columns) - 1)
        for s in self.solver.sets:
            at = particles_within(self.solver, s, *self._bounds)
            w = s.V[at] if probe.reduction == "mean" else np.ones(len(at))
            count, weight = count + len(at), weight + w.sum()
            total = total + w @ values(self.solver, s, probe.fields, at)
        if probe.reduction == "mean":
            total = total / weight if count else np.full(len(total), np.nan)
        return np.array([count, *total])
