"""What every probe declares and provides, whatever it looks at."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from mpmgeo.naming import name_problems
from mpmgeo.output.fields import FURTHER_FIELDS, PARTICLE_FIELDS
from mpmgeo.output.particle_fields import TENSORS, field_of
from mpmgeo.parameters import parameter

FIELDS = ("position", "mass", *PARTICLE_FIELDS, *FURTHER_FIELDS)
FAR = 2.0**60
VECTOR, TENSOR = ("x", "y", "z"), ("xx", "yy", "zz", "xy", "yz", "xz")


@dataclass(frozen=True)
class Probe:
    """A history: a row of numbers every so many steps.

    Besides the members below a probe has `sampler(simulation)`, which returns an object with
    `columns`, the names of its numbers, and `row()`, the numbers now.
    """

    called: ClassVar[str] = "probe"  # what the names of entries in a list begin with

    name: str = parameter("Name of the file of the history, in the folder probes", default="")
    every: int = parameter("Steps between two rows", minimum=1, default=10)

    def problems(self) -> Iterator[tuple[str, str]]:
        """Yield (key, message) if the name cannot be that of a file."""
        yield from name_problems(self.name)


@dataclass(frozen=True)
class FieldProbe(Probe):
    """A probe of fields of particles."""

    fields: tuple[str, ...] = parameter("Fields to take the history of", choices=FIELDS)

    def problems(self) -> Iterator[tuple[str, str]]:
        """Yield (key, message) if there is no field or the name cannot be that of a file."""
        yield from super().problems()
        if not self.fields:
            yield "fields", "needs at least one field"


def components(solver, fields) -> list[str]:
    """Return the names of all components of some fields."""
    names = []
    for key in fields:
        if key in TENSORS:
            names += [f"{key}_{axes}" for axes in TENSOR]
        elif solver.sets and field_of(solver, solver.sets[0], key, slice(0, 0)).ndim == 2:
            names += [f"{key}_{axis}" for axis in VECTOR]
        else:
            names.append(key)
    return names


def values(solver, s, fields, at) -> np.ndarray:
    """Return all components of some fields of the particles `at` of a set, (len(at), columns)."""
    return np.column_stack([np.asarray(field_of(solver, s, key, at), float) for key in fields])


def particles_within(solver, s, low, high) -> np.ndarray:
    """Return the indices of a set's active particles in the closed box from low to high [m]
    in coordinates of the mesh."""
    cell = np.array(solver.grid.mesh[:3])
    # the first node of a particle lies this many cells below it at most
    reach = 0.5 * (np.array(solver.grid.widths) - 2) + 1
    limits = -FAR, FAR  # cells; beyond, whole numbers would overflow
    first = np.floor(np.clip(np.asarray(low) / cell - reach, *limits)).astype(np.int64) >> 2
    last = np.floor(np.clip(np.asarray(high) / cell, *limits)).astype(np.int64) >> 2
    corner = solver.grid.corner
    near = np.flatnonzero(((corner >= first) & (corner <= last)).all(axis=1))
    ranges = [np.arange(s.start[b], s.start[b + 1]) for b in near if s.start[b] < s.start[b + 1]]
    at = np.concatenate([np.empty(0, np.int64), *ranges])
    x = s.x[at]
    return at[((x >= low) & (x <= high)).all(axis=1)]
