"""What a case may say: every JSON key declared once, with unit, bounds, default and one sentence.

Materials, bodies, actions, boundaries and damping declare their own keys in their own packages.
"""

from collections.abc import Iterator
from dataclasses import dataclass, field, make_dataclass
from functools import reduce
from math import isfinite, prod
from operator import or_
from pathlib import Path

from mpmgeo.bodies import BODIES
from mpmgeo.boundaries.planes import BoundaryConditions
from mpmgeo.boundaries.terrain import TerrainContact
from mpmgeo.case.initial_stress import InitialStress
from mpmgeo.case.method import Method
from mpmgeo.case.stepping import Stepping
from mpmgeo.damping import DAMPINGS, NoDamping
from mpmgeo.loads import LOADS, Gravity
from mpmgeo.materials import LAWS
from mpmgeo.mpm.schemes import SCHEMES
from mpmgeo.output.fields import (
    FLUID_FIELDS,
    FURTHER_FIELDS,
    GRID_FIELDS,
    PARTICLE_FIELDS,
    TERRAIN_FIELDS,
)
from mpmgeo.output.probes import PROBES
from mpmgeo.parameters import Counts, Placed, Vector, parameter

Law = reduce(or_, LAWS)
Body = reduce(or_, BODIES)
Damping = reduce(or_, DAMPINGS)
Probe = reduce(or_, PROBES)

ACTIONS = (*LOADS, TerrainContact)
"""All that may act on the material; each is declared in its own file."""

ONE_PHASE_SCHEMES = tuple(word for word in SCHEMES if word not in ("USL", "MUSL"))
ONE_PHASE = 'is for one phase; accepted with two: "USL", "MUSL"'

NOT_WITH_TWO_PHASES = (
    *(("stress_scheme_update", word, f'"{word}" {ONE_PHASE}') for word in ONE_PHASE_SCHEMES),
    ("compatibility", None, "two phases have no earlier form that is worth keeping; leave it out"),
    ("results.energy", None, "the balance of energy is for one phase; leave it out"),
    ("until", None, "the state of rest is that of one phase; leave it out"),
    *((cls.key, None, cls.one_phase_only) for cls in ACTIONS if cls.one_phase_only),
)
"""Keys, with those that lead to them, and values (None: any) that do not go with two phases, and
why."""

RESOLUTION = 1e-12
"""Smallest cell edge relative to the largest coordinate that doubles still resolve usefully."""


@dataclass(frozen=True)
class Mesh(Placed):
    """The regular grid in which everything happens."""

    cells_number: Counts = parameter("Number of cells along x, y, z", minimum=1, maximum=2**20)
    cells_dimension: Vector = parameter("Edge lengths of a cell", unit="m", above=0)
    origin: Vector = parameter(
        "Corner of lowest coordinates", unit="m", place=True, default=(0.0, 0.0, 0.0)
    )
    boundary_conditions: BoundaryConditions = parameter(
        "Conditions on the six bounding planes", default=BoundaryConditions()
    )
    boundary_conditions_fluid: BoundaryConditions = parameter(
        "Conditions of the planes on the pore fluid; with two phases", default=BoundaryConditions()
    )

    @property
    def upper(self) -> Vector:
        """Return the corner of highest coordinates [m]."""
        axes = zip(self.origin, self.cells_number, self.cells_dimension, strict=True)
        return tuple(o + n * h for o, n, h in axes)

    def problems(self) -> Iterator[tuple[str, str]]:
        """Yield (key, message) where cells have no volume or cannot be told apart in doubles."""
        if not 1e-300 < prod(self.cells_dimension) < 1e300:
            yield "cells_dimension", "the volume of such a cell is no usable number"
        for h, low, high in zip(self.cells_dimension, self.origin, self.upper, strict=True):
            reach = max(abs(low), abs(high))
            if not isfinite(reach) or h < RESOLUTION * reach:
                yield "cells_dimension", f"cells of {h:g} m are lost in round-off at {reach:g} m"
                return


@dataclass(frozen=True)
class EnergyPlan:
    """The balance of energy over time."""

    every: int = parameter("Steps between two rows", minimum=1, default=10)


@dataclass(frozen=True)
class Results:
    """What the run writes, and how often."""

    print: int = parameter("Number of outputs aimed at; 0 or less: every step", default=10)
    material_point_results: tuple[str, ...] = parameter(
        "Fields of the particle files; none: only the initial positions are written",
        choices=(*PARTICLE_FIELDS, *FURTHER_FIELDS, *FLUID_FIELDS, "all", "none"),
        default=("id", "displacement"),
    )
    grid_nodal_results: tuple[str, ...] = parameter(
        "Fields of the grid files; none: only the initial grid is written",
        choices=(*GRID_FIELDS, "all", "none"),
        default=("none", "id"),
    )
    grid_all_cells: bool = parameter(
        "Whether grid files of more than ten million cells hold all of them, "
        "not only those that particles touch",
        default=False,
    )
    stl_contact_mesh: tuple[str, ...] = parameter(
        "Fields of the terrain files; none: only the initial one is written",
        choices=(*TERRAIN_FIELDS, "all", "none"),
        default=("none",),
    )
    energy: EnergyPlan | None = parameter(
        "Balance of energy, in energy.csv; absent: none", default=None
    )
    probes: tuple[Probe, ...] = parameter("Histories at points, of particles, …", default=())

    @property
    def particle_fields(self) -> tuple[str, ...]:
        """Return the keys of the particle fields to write, in the order of the files."""
        words = self.material_point_results
        named = () if "none" in words else tuple(key for key in FURTHER_FIELDS if key in words)
        return _chosen(words, PARTICLE_FIELDS, without=()) + named

    @property
    def fluid_fields(self) -> tuple[str, ...]:
        """Return the keys of the fields of the pore fluid to write, if there is one."""
        words = self.material_point_results
        return () if "none" in words else tuple(key for key in FLUID_FIELDS if key in words)

    @property
    def needed_fields(self) -> set[str]:
        """Return the keys of all particle fields that the files and probes hold."""
        probed = (key for probe in self.probes for key in getattr(probe, "fields", ()))
        return {*self.particle_fields, *probed}

    @property
    def grid_fields(self) -> tuple[str, ...]:
        """Return the keys of the grid fields to write, in the order of the files."""
        return _chosen(self.grid_nodal_results, GRID_FIELDS, without=("id",))

    @property
    def terrain_fields(self) -> tuple[str, ...]:
        """Return the keys of the terrain fields to write, in the order of the files."""
        return _chosen(self.stl_contact_mesh, TERRAIN_FIELDS, without=())

    @property
    def terrain_once(self) -> bool:
        """Return whether only the initial terrain file is written."""
        return "none" in self.stl_contact_mesh

    @property
    def particles_once(self) -> bool:
        """Return whether only the initial particle file is written."""
        return "none" in self.material_point_results

    @property
    def grid_once(self) -> bool:
        """Return whether only the initial grid file is written."""
        return "none" in self.grid_nodal_results


def _chosen(words, fields, without):
    if "none" in words:
        return without
    return tuple(key for key in fields if "all" in words or key in words)


@dataclass(frozen=True)
class SnapshotPlan:
    """When the complete state is written, from which a run can go on."""

    every: int = parameter("Steps between two snapshots", minimum=1)
    keep: int = parameter("Number of snapshots that are kept, the last ones", minimum=1, default=2)


@dataclass(frozen=True)
class Settings:
    """What a case says besides its actions and results."""

    title: str = parameter("What the case is", default="")
    reference: str = parameter("Where the case or its expected numbers come from", default="")
    expected: dict | None = parameter(
        "Numbers to compare the results with, in any form; the solver ignores them", default=None
    )
    time: float = parameter("Simulated time", unit="s", above=0)
    n_phases: int = parameter(
        "Number of phases: the solid alone, or with a fluid in its pores",
        choices=(1, 2),
        default=1,
    )
    conductivity_gravity: float = parameter(
        "Acceleration in the unit weight of the fluid that hydraulic conductivity refers to",
        unit="m/s²",
        above=0,
        default=9.81,
    )
    pore_pressure_smoothing: bool = parameter(
        "Whether the particles of a cell share their mean pore pressure; with two phases",
        default=True,
    )
    n_threads: int | None = parameter(
        "Number of threads; absent or 0: all processors", minimum=0, default=None
    )
    gravity: Vector | Gravity = parameter(
        "Acceleration of gravity", unit="m/s²", default=(0.0, 0.0, 0.0)
    )
    save_state: bool = parameter(
        "Whether the final stresses are saved, in particle_stress_data.json", default=False
    )
    load_state: bool = parameter(
        "Whether the stresses of particle_stress_data.json are the initial ones", default=False
    )
    initial_stress: InitialStress | None = parameter(
        "Stresses of overburden at the start; absent: none", default=None
    )
    snapshot: SnapshotPlan | None = parameter(
        "Complete states of the run, from which it can go on", default=None
    )
    compatibility: str | None = parameter(
        "Reproduce deliberate differences to the program named here",
        choices=("mpm-geomechanics",),
        default=None,
    )
    mesh: Mesh = parameter("The grid")
    materials: tuple[Law, ...] = parameter("The materials")
    body: tuple[Body, ...] = parameter("The bodies")
    damping: Damping = parameter(
        "Damping of the motion, of one kind, or a list of several",
        default=NoDamping(),
        several=True,
    )

    @property
    def largest_gravity(self) -> Vector:
        """Return the acceleration of gravity [m/s²] where it is largest."""
        if isinstance(self.gravity, tuple):
            return self.gravity
        factor = 1.0 if self.gravity.course is None else self.gravity.course.largest
        return tuple(factor * g for g in self.gravity.value)

    @property
    def dampings(self) -> tuple[Damping, ...]:
        """Return all kinds of damping, in the order in which they act."""
        several = self.damping if isinstance(self.damping, tuple) else (self.damping,)
        return tuple(sorted(several, key=lambda damping: damping.order))


def _field_of(action):
    """Return name, annotation and dataclass field of an action's key in a case."""
    if action.is_several:
        return action.key, tuple[action, ...], parameter(action.about, default=())
    return action.key, action | None, parameter(action.about, default=None)


Actions = make_dataclass("Actions", map(_field_of, ACTIONS), frozen=True)


@dataclass(frozen=True)
class Case(Actions, Method, Stepping, Settings):
    """A simulation as its case file describes it, checked, defaults filled in, SI units."""

    results: Results = parameter("What the run writes", default=Results())

    notes: tuple[str, ...] = field(default=(), kw_only=True, compare=False)
    warnings: tuple[str, ...] = field(default=(), kw_only=True, compare=False)
    folder: Path = field(default=Path(), kw_only=True, compare=False)

    def entries(self, action: type) -> tuple:
        """Return what the case has of a class of actions, none of it if it has no effect."""
        if action.needs_two_phases and self.n_phases == 1:
            return ()
        found = getattr(self, action.key)
        return found if action.is_several else (found,) * (found is not None)

    def acting(self, how: str) -> list:
        """Return the actions that have an effect and a method of a name, in order of ACTIONS."""
        return [entry for cls in ACTIONS if hasattr(cls, how) for entry in self.entries(cls)]
