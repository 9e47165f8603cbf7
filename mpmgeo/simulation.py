"""A case that runs: what scripts and the command line work with."""

from functools import cached_property, partial
from pathlib import Path

import numba

from mpmgeo.case.building.lint import lint
from mpmgeo.case.building.outputs import outputs_of, steps_between_outputs
from mpmgeo.case.building.solver import build
from mpmgeo.case.building.time_step import critical_time_step, stable_time_step
from mpmgeo.case.coordinates import in_mesh
from mpmgeo.case.load import load_case
from mpmgeo.case.report import nearest, show
from mpmgeo.case.spec import Case
from mpmgeo.mpm.assignment import assign
from mpmgeo.mpm.incidents import Unsound
from mpmgeo.naming import ENERGIES, PLANES
from mpmgeo.numerics.chunks import most_threads
from mpmgeo.numerics.jit import remarks
from mpmgeo.output.claim import claimed
from mpmgeo.output.final_stress import FinalStress
from mpmgeo.output.histories import Histories, histories_of
from mpmgeo.output.leftovers import Leftovers
from mpmgeo.output.nodes import nodes_of
from mpmgeo.output.particle_fields import particle_field, particle_field_names
from mpmgeo.run.diagnosis import diagnose, last_stress
from mpmgeo.run.loop import run
from mpmgeo.run.losses import Losses
from mpmgeo.run.rest import rest_of
from mpmgeo.run.snapshots import Snapshots
from mpmgeo.run.surplus import Surplus
from mpmgeo.run.watch import Diverged, Guard


class Simulation:
    """A case with its state.

    `case`: what `load_case` returns, or takes; `output`: folder for the files of the run, None for
    none; `threads`: number of threads, by default what the case says, or all; `body_force`: None,
    or a function (t, X) of time [s] and of where the particles began (n, 3) [m] that returns
    accelerations (n, 3) [m/s²]. What is hardly meant is in `warnings`, which are shown as
    CaseWarning. Raises ValueError for a file or geometry that cannot be used, and what `load_case`
    raises.
    """

    def __init__(self, case, output=None, threads=None, body_force=None):
        case = case if isinstance(case, Case) else load_case(case)
        self._build(case, output, threads, body_force)
        self.warnings = lint(self)
        show(self.warnings)

    def _build(self, case, output, threads, body_force, starts=True):
        self.case, self.body_force = case, body_force
        self.output = None if output is None else Path(output)
        self.messages = [*case.notes, *case.warnings]
        self.solver, notes = build(case, body_force, starts)
        self.probes = in_mesh(case.results, case.mesh.origin).probes
        self.messages += [*notes, *remarks()]
        self.threads = self._set_threads(threads or case.n_threads)
        self.critical_time_step = critical_time_step(case, self.field("velocity"))
        self.stable_time_step = stable_time_step(case, self.solver, self.field("velocity"))
        self.interrupted = False
        self.stopped = None  # why a watcher stopped the last run, None if none did
        self.goes_on = False  # whether files of its earlier part may be in the output folder
        self.snapshot = None  # path of the last one written
        self.warnings = []
        self.changes = []  # of the case on the way, each with time, steps and values by key
        self._kept, self._told = None, set()
        self.changed = 0  # how often values have changed otherwise than by steps
        self._histories = histories_of(self, self.output or Path())

    @classmethod
    def resume(cls, path, case=None, output=None, threads=None, allow=(), body_force=None):
        """Return a simulation in the state of the snapshot at `path`, from which it goes on.

        `case`: the snapshot's case, needed only if the files that it names have moved, or if it has
        other values of the keys in `allow`, like "gravity" or "materials[0].young"; `changes` tells
        of them, here and in later snapshots. A `body_force` of the run is to be given again. Raises
        ValueError if the snapshot cannot be used or is not of the case.
        """
        from mpmgeo.case import resume
        from mpmgeo.case.building.taking_up import take_up
        from mpmgeo.state.snapshot import StoredSnapshot

        snapshot = StoredSnapshot(path)
        told = resume.topics_of(path, snapshot.facts)
        resume.check_force(path, snapshot.facts, body_force)
        if case is not None and not isinstance(case, Case):
            case = load_case(case)
        case, changed = resume.branch_of(path, snapshot.facts, case, allow)
        simulation = cls.__new__(cls)
        simulation._build(case, output, threads, body_force, starts=False)
        original = partial(load_case, snapshot.facts["case"])
        take_up(simulation.solver, snapshot, original, body_force)
        simulation._told = told
        simulation.goes_on = True
        if changed:
            simulation._changed()
        simulation.changes = resume.record_of(simulation, changed, snapshot.facts)
        for remark in resume.remarks_on(simulation, changed):
            simulation.say(remark)
        return simulation

    def save(self, path):
        """Write a snapshot of the complete state."""
        from mpmgeo.mpm.persistence import snapshot_of
        from mpmgeo.output.whole_file import whole_file
        from mpmgeo.state.snapshot import Snapshot, write_snapshot

        arrays, facts = snapshot_of(self.solver)
        facts |= {"told": sorted(self._told), "changes": self.changes, **self._case_facts}
        facts["body_force"] = self.body_force is not None
        facts["across"] = getattr(self.solver, "across", None)
        with whole_file(path) as file:
            write_snapshot(file, Snapshot(arrays, facts))
        self.snapshot = path

    @cached_property
    def _case_facts(self):
        from mpmgeo.case.resume import case_facts

        return case_facts(self.case)

    def _set_threads(self, wanted):
        most = most_threads()
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
        sound one. The first Ctrl-C ends the run after a whole step and sets `interrupted`; StopRun,
        raised by a watcher, or a state of rest ends it too and sets `stopped` to the reason. Raises
        OSError if files cannot be written, or if another run writes into the output folder.
        """
        at = outputs_of(self.case, self.time_step)
        watchers = [Guard(at), Surplus(at), *self._files(at), *rest_of(self), Losses(), *watchers]
        try:
            with claimed(self.output, self.case.title):
                run(self, self.case.time if until is None else until, watchers)
        finally:
            self.goes_on = True
        return self

    def _files(self, outputs):
        if self.output is None:
            return []
        from mpmgeo.output.results import ResultFiles

        files = [ResultFiles(self.output, self.case, outputs)]
        if self._histories:
            files.append(Histories(self._histories, outputs))
        if self.case.save_state:
            files.append(FinalStress(self.output))
        if self.case.snapshot is not None:
            files.append(Snapshots(self.output, self.case.snapshot, self._histories))
        return [Leftovers(self.output, self._histories), *files]

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
        for topic, messages in self.solver.news():
            self.tell(topic, messages)
        for message in remarks():
            if message not in self.messages:
                self.say(message)

    def tell(self, topic, messages):
        """Keep messages for the user, which `messages()` returns, unless the topic is old."""
        if topic not in self._told:
            self._told.add(topic)
            self.messages += messages()

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
            raise Diverged(diagnose(self, error, last_stress(self._kept, error.row))) from error

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
        """Steps between two outputs, if all steps are of the same length."""
        return steps_between_outputs(self.case, self.time_step)

    def kinetic_energy(self):
        """Return the kinetic energy [J]."""
        return self.solver.kinetic_energy()

    def output_energy(self):
        """Return the kinetic energy [J], before kinetic damping stopped the particles."""
        peak = self.solver.peak_energy
        return self.kinetic_energy() if peak is None else peak

    def energy(self):
        """Return the last row of the balance of energy, {column: [J]}; empty without one."""
        ledger = self.solver.ledger
        return {} if ledger is None else dict(zip(ENERGIES, map(float, ledger.row()), strict=True))

    def field(self, key):
        """Return a field of all particles in row order: a key of the results, position, mass, or a
        variable of a law; stress has the columns xx yy zz xy yz xz. KeyError for an unknown key."""
        known = particle_field_names(self.solver)
        if key not in known:
            guess = nearest(key, known)
            end = f"did you mean {guess!r}?" if guess else f"there are {', '.join(known)}"
            raise KeyError(f"{key!r} is no field; {end}")
        return particle_field(self.solver, key)

    def assign(self, key, values):
        """Set "velocity" (n, 3) [m/s] or "stress" (n, 6) [Pa] of all particles, in row order.

        Also "displacement" (n, 3) [m] and "deformation_gradient" (n, 3, 3), which sets the volume,
        and the stress of laws that keep it; with two phases "velocity_fluid" (n, 3) and "pressure"
        (n,) [Pa]. Raises KeyError for another key, ValueError for values that cannot be.
        """
        assign(self.solver, key, values)
        self._changed()

    def reset_displacements(self):
        """Count time, displacements and strains from now on, at rest, with the present stresses."""
        self.solver.restart()
        self.changed, self.changes, self.goes_on, self._kept = self.changed + 1, [], False, None

    def _changed(self):
        """Begin a new balance of energy: values are others."""
        self.changed += 1
        if self.solver.ledger is not None:
            self.solver.ledger.restart()

    def reactions(self):
        """Return the forces (3,) [N] on the material by plane, X0 … Zn, and prescribed velocity.

        Of the last step that a plane probe or prescribed velocity measured; empty before.
        """
        if self.solver.reactions is None:
            return {}
        names = [*PLANES, *(entry.name for entry in self.case.prescribed_velocity)]
        return dict(zip(names, self.solver.reactions, strict=True))

    def nodes(self):
        """Return the nodes that carried mass in the last step."""
        return nodes_of(self.solver, self.case.mesh)
