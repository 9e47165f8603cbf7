"""A case that runs: what scripts and the command line work with."""

from dataclasses import replace
from functools import cached_property
from pathlib import Path
from typing import NamedTuple

import numba
import numpy as np

from mpmgeo.case.building.solver import build
from mpmgeo.case.building.time_step import critical_time_step
from mpmgeo.case.coordinates import in_mesh
from mpmgeo.mpm.incidents import Unsound
from mpmgeo.naming import GHOSTS, PLANES
from mpmgeo.numerics.jit import remarks
from mpmgeo.output.final_stress import FinalStress
from mpmgeo.output.histories import Histories, histories_of
from mpmgeo.output.leftovers import SNAPSHOTS, STRESS_FILE, TERRAIN, Leftovers
from mpmgeo.output.particle_fields import particle_field
from mpmgeo.run.diagnosis import diagnose
from mpmgeo.run.loop import run
from mpmgeo.run.losses import Losses
from mpmgeo.run.snapshots import Snapshots
from mpmgeo.run.watch import Diverged, Guard


class Nodes(NamedTuple):
    """Nodes with mass: index with two ghost layers, position [m], mass [kg], velocity [m/s]."""

    index: np.ndarray
    position: np.ndarray
    mass: np.ndarray
    velocity: np.ndarray


class Simulation:
    """A case with its state.

    `output`: folder for the files of the run, None for none; `threads`: number of threads, by
    default what the case says, or all. Raises ValueError for a file or geometry that cannot be
    used.
    """

    def __init__(self, case, output=None, threads=None):
        self.case = case
        self.output = None if output is None else Path(output)
        self.messages = [*case.notes, *case.warnings]
        self.solver, notes = build(case)
        self.probes = in_mesh(case.results, case.mesh.origin).probes
        self.messages += [*notes, *remarks()]
        self.threads = self._set_threads(threads or case.n_threads)
        self.critical_time_step = critical_time_step(case, self.field("velocity"))
        self.interrupted = False
        self.goes_on = False  # whether files of its earlier part may be in the output folder
        self.snapshot = None  # path of the last one written
        self._kept = None
        self._told = set()
        self._histories = histories_of(self, self.output or Path())

    @classmethod
    def resume(cls, path, case=None, output=None, threads=None):
        """Return a simulation in the state of the snapshot at `path`, from which it goes on.

        `case`: the snapshot's case, needed only if the files that it names have moved. Raises
        ValueError if the snapshot cannot be used or is not of the case.
        """
        from mpmgeo.case.resume import case_of
        from mpmgeo.mpm.persistence import take_snapshot
        from mpmgeo.state.snapshot import read_snapshot

        snapshot = read_snapshot(path)
        case = case_of(path, snapshot.facts, case)
        simulation = cls(replace(case, load_state=False), output, threads)
        simulation.case = case
        take_snapshot(simulation.solver, snapshot)
        simulation._told = set(snapshot.facts["told"])
        simulation.goes_on = True
        return simulation

    def save(self, path):
        """Write a snapshot of the complete state."""
        from mpmgeo.mpm.persistence import snapshot_of
        from mpmgeo.output.whole_file import whole_file
        from mpmgeo.state.snapshot import Snapshot, write_snapshot

        arrays, facts = snapshot_of(self.solver)
        facts |= {"told": sorted(self._told), **self._case_facts}
        with whole_file(path) as file:
            write_snapshot(file, Snapshot(arrays, facts))
        self.snapshot = path

    @cached_property
    def _case_facts(self):
        from mpmgeo.case.resume import case_facts

        return case_facts(self.case)

    def _set_threads(self, wanted):
        most = numba.config.NUMBA_NUM_THREADS
        if wanted and wanted > most:
            self.say(f"n_threads: {wanted} asked for, {most} available")
        return min(wanted or most, most)

    def say(self, message):
        """Keep a message for the user."""
        self.messages.append(message)

    # Running

    def run(self, until=None, watchers=()):
        """Run to the end of the case, or to time `until` [s]; returns the simulation.

        Raises Diverged when particles become NaN, infinite or too fast; the state is then the last
        sound one. The first Ctrl-C ends the run after a whole step and sets `interrupted`.
        """
        every = self.output_interval
        watchers = [Guard(every), *self._files(every), Losses(), *watchers]
        try:
            run(self, self.case.time if until is None else until, watchers)
        finally:
            self.goes_on = True
        return self

    def _files(self, every):
        if self.output is None:
            return []
        from mpmgeo.output.results import ResultFiles

        files = [ResultFiles(self.output, self.case, every)]
        if self._histories:
            files.append(Histories(self._histories, every))
        if self.case.save_state:
            files.append(FinalStress(self.output))
        if self.case.snapshot is not None:
            files.append(Snapshots(self.output, self.case.snapshot, self._histories))
        return [Leftovers(self.output, self._written()), *files]

    def _written(self):
        """Return files and folders, among those that only some cases have, that this one has."""
        written = [history.path for history in self._histories]
        asked = (
            (self.case.save_state, STRESS_FILE),
            (self.case.snapshot is not None, SNAPSHOTS),
            (self.solver.ground is not None, TERRAIN),
        )
        return written + [self.output / name for is_asked, name in asked if is_asked]

    def step(self, steps=1):
        """Advance by some steps; returns the simulation."""
        for _ in range(steps):
            self.advance()
        return self

    def advance(self):
        """Advance by one step."""
        if numba.get_num_threads() != self.threads:
            numba.set_num_threads(self.threads)
        self._guarded(self.solver.step)
        self._report_events()

    def _report_events(self):
        for topic, messages in self.solver.news():
            if self._once(topic):
                for message in messages():
                    self.say(message)

    def _once(self, topic):
        new = topic not in self._told
        self._told.add(topic)
        return new

    def arrange(self):
        """Bring the particles in the order that looking for them by place needs."""
        self._guarded(self.solver.arrange)

    def check(self):
        """Raise Diverged unless all particles are sound."""
        self._guarded(self.solver.check)

    def _guarded(self, action):
        try:
            action()
        except Unsound as error:
            error.position = error.position + self.solver.population.zero
            raise Diverged(diagnose(self, error, self._last_stress(error.row))) from error

    def _last_stress(self, row):
        """Return the stress (6,) [Pa] in the state kept last of the particle in a row, or None."""
        for number in range(len(self.solver.sets)) if self._kept else ():
            if (found := self._kept[f"set{number}.row"] == row).any():
                return self._kept[f"set{number}.stress"][found][0]
        return None

    def keep(self):
        """Keep a copy of the state."""
        self._kept = self.solver.keep(self._kept)

    def restore(self):
        """Go back to the state that was kept."""
        self.solver.restore(self._kept)

    # The state

    @property
    def time(self):
        """Time of the state [s]."""
        return self.solver.time

    @property
    def steps(self):
        """Number of steps done."""
        return self.solver.steps

    @property
    def time_step(self):
        """Time step [s]."""
        return self.solver.time_step

    @property
    def label(self):
        """Time that files show for the state [s]: a step early as in MPM-Geomechanics if asked."""
        early = self.case.compatibility is not None and self.steps > 0
        return self.time - self.time_step if early else self.time

    @property
    def output_interval(self):
        """Steps between two outputs."""
        wanted = self.case.results.print
        steps = int(self.case.time / self.time_step)
        return max(1, steps // wanted) if wanted > 0 else 1

    def kinetic_energy(self):
        """Return the kinetic energy [J]."""
        return self.solver.kinetic_energy()

    def output_energy(self):
        """Return the kinetic energy [J], before kinetic damping stopped the particles."""
        peak = self.solver.peak_energy
        return self.kinetic_energy() if peak is None else peak

    def field(self, key):
        """Return a field of all particles in row order: a key of the results, or position, mass,
        volume; stress has the columns xx yy zz xy yz xz. Raises KeyError for an unknown key."""
        return particle_field(self.solver, key)

    def assign(self, key, values):
        """Set "velocity" (n, 3) [m/s] or "stress" (n, 6) [Pa] of all particles, in row order.

        With two phases also "velocity_fluid" (n, 3) and "pressure" (n,) [Pa]. Raises KeyError for
        another key, ValueError for another shape.
        """
        known = {"velocity": ("v", (3,)), "stress": ("stress", (6,))}
        if self.case.n_phases == 2:
            known |= {"velocity_fluid": ("vf", (3,)), "pressure": ("pf", ())}
        name, shape = known[key]
        values, shape = np.asarray(values, float), (self.solver.count, *shape)
        if values.shape != shape:
            raise ValueError(f"{key} has the shape {shape}, not {values.shape}")
        for s in self.solver.sets:
            getattr(s, name)[:] = values[s.row]

    def reactions(self):
        """Return the forces (3,) [N] on the material by plane, X0 … Zn, and prescribed velocity.

        They are of the last step that a plane probe or prescribed velocity of the case measured;
        empty before.
        """
        if self.solver.reactions is None:
            return {}
        names = [*PLANES, *(entry.name for entry in self.case.prescribed_velocity)]
        return dict(zip(names, self.solver.reactions, strict=True))

    def nodes(self):
        """Return the nodes that carried mass in the last step."""
        grid = self.solver.grid
        mass, velocity = grid.solid.at_nodes("mass"), grid.solid.at_nodes("velocity")
        index, used = grid.indices().reshape(-1, 3), mass > self.solver.cutoff
        mesh = self.case.mesh
        position = index[used] * np.array(mesh.cells_dimension) + mesh.origin
        return Nodes(index[used] + GHOSTS, position, mass[used], velocity[used])
