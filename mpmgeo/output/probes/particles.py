"""Histories of single particles."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from mpmgeo.output.particle_fields import particle_field
from mpmgeo.output.probes.probe import FieldProbe, components, values
from mpmgeo.parameters import parameter


@dataclass(frozen=True)
class ParticleProbe(FieldProbe):
    """Fields of single particles, wherever they go."""

    type: ClassVar[str] = "particles"

    ids: tuple[int, ...] = parameter("Numbers of the particles, as in the field id", minimum=0)

    def problems(self):
        """Yield (key, message) if there is no particle, no field or no usable name."""
        yield from super().problems()
        if not self.ids:
            yield "ids", "needs at least one number"

    def sampler(self, simulation):
        """Return what takes the samples; raises ValueError for a number that no particle has."""
        known = particle_field(simulation.solver, "id")
        for number in self.ids:
            if number >= len(known):
                raise ValueError(
                    f"results.probes, {self.name}: there is no particle {number}; "
                    f"they are numbered from 0 to {len(known) - 1}"
                )
        rows = [int((known == number).argmax()) for number in self.ids]
        names = [f"particle{number}" for number in self.ids]
        return Followed(simulation.solver, self.fields, rows, names)


class Followed:
    """Fields of the particles in some rows."""

    def __init__(self, solver, fields, rows, names):
        self.solver, self.fields, self.rows = solver, fields, np.array(rows, np.int64)
        self._width = len(components(solver, fields))
        self.columns = [f"{n}.{c}" for n in names for c in components(solver, fields)]
        self._order = [None] * len(solver.sets)
        self._found = [None] * len(solver.sets)

    def row(self):
        """Return the values now."""
        out = np.full((len(self.rows), self._width), np.nan)
        for number, s in enumerate(self.solver.sets):
            if self._order[number] is not s.start:  # sorted since the last time
                self._order[number] = s.start
                self._found[number] = self._find(s)
            place, at = self._found[number]
            if len(at):
                out[place] = values(self.solver, s, self.fields, at)
        return out.ravel()

    def _find(self, s):
        """Return which of the rows are in a set, and where."""
        index = np.full(len(self.solver.population.position), -1)
        index[s.row] = np.arange(len(s.row))
        at = index[self.rows]
        return np.flatnonzero(at >= 0), at[at >= 0]
