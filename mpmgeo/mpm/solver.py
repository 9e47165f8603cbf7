"""The explicit material point method: its state, and the step that advances it."""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from mpmgeo.boundaries.base_motion import STILL
from mpmgeo.boundaries.planes import Planes
from mpmgeo.effect import HOOKS, Effect
from mpmgeo.formulation import Energies
from mpmgeo.materials.law import stores_energy
from mpmgeo.mpm.incidents import Departures, Unsound
from mpmgeo.mpm.locking import CellMeans
from mpmgeo.mpm.newmark import Newmark
from mpmgeo.mpm.persistence import copy_of, state_of, take_over
from mpmgeo.mpm.restart import origin_of, restart
from mpmgeo.mpm.stages import Stages
from mpmgeo.mpm.tally import sag, tally
from mpmgeo.mpm.task import OnePhase
from mpmgeo.numerics.clock import Clock
from mpmgeo.state.checked import array_from, demand, number_from, whole_from
from mpmgeo.state.grid import Grid
from mpmgeo.state.inspection import first_unsound, kinetic_energy
from mpmgeo.state.particles import ParticleSet, Population, opens_under_pressure
from mpmgeo.state.sorting import OPEN, sort

COUNTERS = ("time", "steps", "gone", "peak_energy")
SMALL = 4096  # particles up to which threads cost more than they save


@dataclass
class Solver(Stages):
    """All that a step needs; `step` advances it. SI units.

    `effects`: what joins the step, in the order in which it is asked. Raises Unsound when particles
    diverge.
    """

    grid: Grid
    sets: list[ParticleSet]
    population: Population
    shape: NamedTuple
    scheme: Callable
    planes: Planes
    time_step: float
    gravity: tuple
    effects: tuple[Effect, ...] = ()
    damping: tuple = ()  # models of damping at the nodes
    early_damping: object = None  # one that acts as in MPM-Geomechanics
    transfer: object = None  # how velocities go to particles; None: FLIP
    leaky: bool = False  # whether particles may pass planes that hold, as in MPM-Geomechanics
    cutoff: float = 0.0  # [kg] nodal mass up to which forces do not move a node
    scaling: float = 1.0  # factor of the inertia, not of weight and loads; not for Newmark's
    cells: CellMeans | None = None  # of strain and stress, if the particles of a cell share them

    time: float = 0.0
    steps: int = 0
    clock: Clock = field(default_factory=Clock)

    def __post_init__(self):
        self.count = len(self.population.position)
        self.small = self.count <= SMALL
        self.departures = Departures(self.population.zero)
        self.reactions = None  # (6 + tools, 3) [N] of planes and tools when last measured
        self.ledger = None  # of energy, if it is asked for
        self.peak_energy = None  # before the particles were stopped in the last step, if they were
        self.previous = 0.0  # the step before [s]; while effects end a step, that one
        self.gone = self.count  # how many particles are not where the order says
        self.moved_origin = False  # whether displacements count from a later time than the start
        self.motion = STILL  # of a plane that moves
        self.driven = None, ()  # model and arrays of nodes whose velocity is prescribed
        self.nodal = OnePhase()
        for s in self.sets:
            s.lie_in(self.grid)
            if self.is_whole and s.a is None:
                s.a = np.zeros_like(s.v)
        self.asked = {
            hook: [getattr(effect, hook) for effect in self.effects if effect.overrides(hook)]
            for hook in HOOKS
        }
        self.bound(self.planes)
        for effect in self.effects:
            effect.join(self)

    def bound(self, planes):
        """Take on planes that bound the mesh from now on; shapes that end at walls end there."""
        self.planes = planes
        walls = planes.cutting
        for cutting in self.asked["cutting"]:
            walls = cutting(walls)
        self.grid.end_at(walls)

    @property
    def active(self) -> int:
        """Number of particles that have not left the mesh."""
        return sum(s.active for s in self.sets)

    def effect(self, name):
        """Return the effect of a name, None without."""
        return next((effect for effect in self.effects if effect.name == name), None)

    @property
    def ground(self):
        """Return the terrain that particles touch, None without."""
        return self.effect("ground")

    @property
    def is_whole(self) -> bool:
        """Return whether velocities are of the times of positions, not half a step behind."""
        return isinstance(self.scheme, Newmark)

    @property
    def load_time(self) -> float:
        """Return of which time the loads of the next step are [s]: with Newmark's its end."""
        return self.time + (self.time_step if self.is_whole else 0.0)

    def news(self):
        """Yield (topic, messages) for what the user should be told of, `messages` a function."""
        if self.departures:
            yield "departure", self.departures.first
        for news in self.asked["news"]:
            yield from news(self)

    def arrange(self):
        """Sort the particles now if some are not where the order says; may raise Unsound."""
        if self.gone:
            self._sort()

    def keep(self, kept=None):
        """Return a copy of the whole state, in the arrays of the copy `kept` if there is one."""
        return copy_of(state_of(self), kept or {})

    def restore(self, kept):
        """Go back to the state that `keep` returned."""
        take_over(self, kept)
        if self.gone:
            self._sort(judge=False)

    def step(self):
        """Advance by one time step.

        Velocities change over h, from the middle of the step before to that of this one, or, in
        Newmark's method, over the step; there is no step before the first. What has more inertia
        changes its velocity as if h were shorter.
        """
        h = self.time_step if self.is_whole else 0.5 * (self.previous + self.time_step)
        h /= self.scaling
        self.clock.begin()
        if self.gone:
            self._sort()
            self.clock.lap("sort")
        for begin in self.asked["begin"]:
            begin(self, h)
        self.scheme(self, h)
        self.steps += 1
        self.time += self.time_step
        self.previous = self.time_step
        for end in self.asked["end"]:
            end(self)

    def stop(self):
        """Set the velocities of all particles to zero."""
        for s in self.sets:
            s.stop()
        for stopped in self.asked["stopped"]:
            stopped(self)

    def kinetic_energy(self) -> float:
        """Return the kinetic energy of the active particles [J]."""
        return sum(kinetic_energy(s, self.crew) for s in self.sets)

    def tally(self, left=False):
        """Return the sums of energies over the active particles, or over those that `left`."""
        return tally(self.sets, self.gravity, self.population.body, self.crew, left)

    def energies(self):
        """Return what tells whether energy has appeared, None if work is done that nobody sees.

        Positions and volumes are taken back by half a step, to where the velocities are.
        """
        if self.scaling != 1.0:
            return None
        works = any(effect.does_work for effect in self.effects)
        works = works or any(opens_under_pressure(s) for s in self.sets)
        if self.ledger is None and (works or not all(stores_energy(s.law) for s in self.sets)):
            return None
        here = self.tally()
        if self.ledger is not None:
            return self.ledger.energies(here.within)
        lag = 0.5 * self.previous
        potential = float((here.potential - lag * here.power).sum())
        if self.effect("time step") is not None:
            potential -= sag(self.sets, self.gravity, self.previous)
        potential += float(self.tally(left=True).potential.sum())
        held = float((here.kinetic + here.strain).sum())
        return Energies(held - potential, here.within, 0.0, held + abs(potential))

    def check(self):
        """Raise Unsound if a particle is NaN, infinite or would cross a cell in a step."""
        for s in self.sets:
            p = first_unsound(s, self.speed_limit, self.crew)
            if p >= 0:
                self._refuse(s, p)

    @property
    def speed_limit(self) -> float:
        """The speed at which a particle crosses the smallest cell in a step [m/s]."""
        mesh = self.grid.mesh
        return min(mesh.hx, mesh.hy, mesh.hz) / self.time_step

    def _refuse(self, s, p):
        material = int(self.population.material[s.row[p]])
        state = [np.copy(a[p]) for a in (s.x, s.v, s.stress)]
        raise Unsound(material, int(s.row[p]), self.steps, self.time, *state)

    def _sort(self, judge=True):
        """Sort the particles, note who leaves; `judge`: raise Unsound for those that failed."""
        left = sort(self.grid, self.sets, self.crew, self._walls())
        self.gone = 0
        for act in self.asked["after_sort"]:
            act(self)
        new = [slice(s.active, s.active + n) for s, n in zip(self.sets, left, strict=True)]
        if judge:
            self._judge(new)
        for s, rows in zip(self.sets, new, strict=True):
            if rows.start < rows.stop:
                first = s.active + int(s.row[rows].argmin())
                self.departures.add(self.time, np.sort(s.row[rows]), s.x[first].copy())

    def _judge(self, new):
        """Raise Unsound if one of those that left did so because it failed."""
        for s, rows in zip(self.sets, new, strict=True):
            speed = np.hypot(np.hypot(*s.v[rows, :2].T), s.v[rows, 2])  # squares may overflow
            broken = ~(speed <= self.speed_limit) | ~np.isfinite(s.x[rows]).all(axis=1)
            if broken.any():
                self._refuse(s, s.active + int(broken.argmax()))

    def _walls(self):
        """Return the planes that keep particles in; who begins outside the mesh stays there."""
        if self.leaky or self.steps == 0:
            return OPEN
        walls = self.planes.walls
        for keeping in self.asked["keeping"]:
            walls = keeping(walls)
        return walls

    def assigned(self):
        """Take note that somebody has given particles other values."""

    def restart(self):
        """Count time and displacements from now on, at rest, with the present stresses."""
        restart(self)

    # What a run must hold to go on

    def solver_of(self, state):
        """Return the solver that a state is one of: this one."""
        return self

    def owners(self):
        """Return all that hold a part of the state, by the name that their part has.

        The solver comes last, for it looks whether the parts fit together.
        """
        sets = {f"set{number}": s for number, s in enumerate(self.sets)}
        effects = {effect.name: effect for effect in self.effects}
        return {"departures": self.departures, "grid": self.grid, **sets, **effects, "": self}

    def held(self):
        """Return the solver's own part, by name."""
        return {name: getattr(self, name) for name in COUNTERS} | origin_of(self)

    def take(self, state):
        """Go on with what `held` once returned; ValueError if the parts do not fit together."""
        self.time = number_from(state, "time", least=0.0)
        self.steps, self.gone = whole_from(state, "steps"), whole_from(state, "gone")
        if (peak := state.pop("peak_energy")) is not None:
            peak = number_from({"peak_energy": peak}, "peak_energy")
        self.peak_energy = peak
        if self.moved_origin or "origin" in state:
            origin = array_from(state, "origin", np.float64, self.population.position.shape)
            self.population, self.moved_origin = (
                self.population._replace(position=origin.copy()),
                True,
            )
        self.previous = self.time_step if self.steps else 0.0
        blocks = len(self.grid.keys)
        for s in self.sets:
            unsorted = blocks == 0 and (self.gone > 0 or s.active == 0)
            is_sound = unsorted or len(s.start) == blocks + 1
            demand(is_sound, "grid.keys are not the blocks of the particles")
        is_sound = all(d.rows.min() >= 0 and d.rows.max() < self.count for d in self.departures)
        demand(is_sound, "departures are of particles that there are not")
        for s in self.sets:
            s.lie_in(self.grid)
        for resumed in self.asked["resumed"]:
            resumed(self)
