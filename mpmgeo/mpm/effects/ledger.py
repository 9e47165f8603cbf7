"""The ledger of energy: what there is, what was put in, what has become of it.

    balance = kinetic + strain + plastic + damping − external − (kinetic + strain at the start)

All of a row is of the time of the velocities, half a step before that of the positions. Forces at
nodes work on the mean of the nodes' velocities before and after the step,

    W = Σ F · ½ (v + v′) h,

which is what they change the kinetic energy of the nodes by. What belongs to positions, stresses
and volumes is the mean of its values before and after they have moved: elastic energy, dissipation
of the laws, and the work Σ f·x + Σ p V of what does not change, weight, loads on particles and
given pore pressures; with USF the stresses, which lag, are continued by a step. So a vibration
without damping has a balance of second order in the step. Where forces on particles do change,
`effects/in_time.py` puts in what is lacking.
"""

from typing import NamedTuple

import numpy as np

from mpmgeo.boundaries.base_motion import STILL
from mpmgeo.effect import Effect
from mpmgeo.formulation import Energies
from mpmgeo.mpm.core.driven import holds
from mpmgeo.mpm.core.loops import at_node, is_needless
from mpmgeo.mpm.core.nodes import integrated
from mpmgeo.mpm.effects.reactions import has_driven
from mpmgeo.naming import ENERGIES
from mpmgeo.numerics.jit import inlined
from mpmgeo.numerics.simd import LANES, lane, load
from mpmgeo.state.checked import array_from

DIVERGING = np.errstate(over="ignore", invalid="ignore")
"""Of a run that diverges the guard tells, not every sum."""


class Works(NamedTuple):
    """Sum the work that planes, prescribed velocities and damping have done in another work.

    Arrays: those of the other work, `Momentum`, whose nodes have their velocities, and the sums
    (blocks, 2), zero: put in, and damped [J].
    """

    work: object


@at_node.register(Works)
def works(work, node, a):
    others, out = a
    nodes, driven = others
    r, inner, b = load(node.sums, node.at), work.work, node.block
    m = lane(r, 0)
    if m > 0.0:
        u = load(nodes, node.number * LANES)
        q = 0.5 * inner.h if m > inner.cutoff else 0.0
        x, y, z = (
            lane(u, 0) - q * lane(u, 3),
            lane(u, 1) - q * lane(u, 4),
            lane(u, 2) - q * lane(u, 5),
        )
        _, _, _, _, _, _, fx, fy, fz, dx, dy, dz = integrated(inner, node, driven, r, u)
        X = _held(inner.driven, driven, node.number, 0, x)
        Y = _held(inner.driven, driven, node.number, 1, y)
        Z = _held(inner.driven, driven, node.number, 2, z)
        out[b, 0] += inner.h * (fx * X + fy * Y + fz * Z)
        out[b, 1] -= inner.h * m * (dx * x + dy * y + dz * z)


@inlined
def _held(model, a, node, axis, v):
    """Return the mean velocity in the step of what holds a node, v unless it is prescribed."""
    if model is not None:
        t = holds(model, a, node, axis)
        if t >= 0:
            return 0.5 * (a[2][t, axis] + a[3][t, axis])
    return v


@is_needless.register(Works)
def nothing_works(work, a, b, bounded):
    return _damps_nothing(work.work.damping) and not (
        bounded or has_driven(work.work.driven, a[0][-1], b, len(a[1]))
    )


@inlined
def _damps_nothing(damping):
    return len(damping) == 0


class Ledger(Effect):
    """Keeps a row of ENERGIES [J] every so many steps; after all effects of a step.

    `is_early`: whether a step updates the stresses first, so that they are a step behind the
    positions. Effects that do work add it with `put_in`.
    """

    name = "ledger"
    does_work = False

    def __init__(self, every, is_early=False):
        self.every, self.is_early = every, is_early
        self.weights = (1.5, 1.5, 0.5) if is_early else (0.5, 0.5, 0.5)
        self.sums = np.zeros(2)  # put in at nodes, damped
        self.start = np.full(5, np.nan)  # kinetic, strain, given, plastic; strain with who left
        self._begins = False  # whether the balance begins in this step
        self.figures = np.full(len(ENERGIES), np.nan)  # the last row
        self._before = self._power = None  # what the end of a step compares with

    def join(self, solver):
        """Let effects find the ledger."""
        self.solver = solver
        solver.ledger = self
        self._is_paced = solver.effect("time step") is not None

    def put_in(self, work):
        """Count work [J] that an effect has done on the nodes, or on the particles."""
        self.sums[0] += work

    def restart(self):
        """Begin a new balance with what there is when the next step begins."""
        self.sums[:] = 0.0
        self.start[:] = self.figures[:] = np.nan
        for s in self.solver.sets:
            s.work[:] = 0.0

    def restarted(self, solver):
        """Begin a new balance."""
        self.restart()

    def row(self):
        """Return the figures of the last row; before the first step those of the start."""
        if self.solver.steps == 0:
            kinetic, strain = self.solver.kinetic_energy(), self.solver.tally().strain.sum()
            return kinetic, float(strain), 0.0, 0.0, 0.0, 0.0
        return self.figures

    def energies(self, within):
        """Return what the guard compares, None before the first row."""
        _, _, external, plastic, damping, balance = self.figures
        if not np.isfinite(balance):
            return None
        turnover = plastic + damping + abs(self.sums[0])
        return Energies(balance, within, turnover, abs(external) + self.figures[0])

    @DIVERGING
    def begin(self, solver, h):
        """Note what there is before the step."""
        due = (solver.steps + 1) % self.every == 0
        if self.is_early and solver.previous:
            self.weights = (*(1.0 + 0.5 * (solver.time_step / solver.previous),) * 2, 0.5)
        self._begins = bool(np.isnan(self.start[0]))
        if self._begins:
            self.start[4] = sum(solver.tally(left).strain.sum() for left in (False, True))
        self._h = h
        if due or self._begins:
            *self._before, self._power = self._levels()
        if self._begins:
            self.start[0] = solver.kinetic_energy()

    def before_nodes(self, solver, task):
        """Note what is done at the nodes."""
        self._task = task

    @DIVERGING
    def after_nodes(self, solver, h):
        """Sum the work of planes and tools that move, and of damping."""
        task, self._task = self._task, None
        moves = solver.driven[0] is not None or solver.motion is not STILL
        if moves or solver.damping:
            out = np.zeros((len(solver.grid.active), 2))
            solver.over_nodes(task._replace(work=Works(task.work), arrays=(task.arrays, out)))
            self.sums += out.sum(axis=0)
            solver.clock.lap(self.name)

    @DIVERGING
    def stopped(self, solver):
        """Count what was taken from the particles."""
        self.sums[1] += solver.peak_energy - solver.kinetic_energy()

    @DIVERGING
    def end(self, solver):
        """Make a row if one is due."""
        due = solver.steps % self.every == 0
        if not due and not self._begins:
            return
        *now, power = self._levels()
        if self._begins:
            self._set_start(solver, now, power)
        if due:
            both = zip(self._before, now, self.weights, strict=True)
            if self._is_paced:
                now[2] -= 2.0 * self._sag(power)  # of which half is taken
            values = (before + weight * (after - before) for before, after, weight in both)
            self.figures[:] = self._row(solver.kinetic_energy(), *values)
        solver.clock.lap(self.name)

    def _set_start(self, solver, now, power):
        """Set what there was when the velocities were those before the step, which is done now."""
        h, (strain, plastic, given) = solver.previous, self._before
        if solver.steps == 1 and not self._is_paced:
            self.sums[0] -= self._sag(power)
        elif solver.steps > 1:  # half a step before the positions
            strain += (self.weights[0] - 1.0) * (now[0] - strain)
            plastic += (self.weights[1] - 1.0) * (now[1] - plastic)
            given -= 0.5 * h * self._power
        self.start[1:4] = strain, given, plastic

    def _sag(self, power):
        """Return the work [J] to the mean of two positions less that to the one between them.

        A path of the acceleration a sags by a h²/8, so it is as much in all steps of a length; in
        the first one velocities change over half of it.
        """
        return 0.125 * self.solver.previous**2 * (power - self._power) / self._h

    def _row(self, kinetic, strain, plastic, given):
        plastic -= self.start[3]
        external, damping = self.sums[0] + given - self.start[2], self.sums[1]
        start = self.start[0] + self.start[1]
        balance = kinetic + strain + plastic + damping - external - start
        return kinetic, strain, external, plastic, damping, balance

    def _levels(self):
        """Return elastic energy, dissipation, work of what does not change [J], its power [W].

        What particles took along that left the mesh counts as taken out.
        """
        s = self.solver
        here, gone = s.tally(), s.tally(left=True)
        done, pressed = sum((part.work.sum(axis=0) for part in s.sets), np.zeros(2))
        given = (here.potential + gone.potential - gone.kinetic - gone.strain).sum() + pressed
        strain = here.strain.sum()
        dissipated = self.start[4] + done - strain - gone.strain.sum()
        return float(strain), float(dissipated), float(given), float(here.power.sum())

    def held(self):
        """Return the sums, what there was at the start, and the last row."""
        return {"sums": self.sums, "start": self.start, "figures": self.figures}

    def take(self, state):
        """Go on with what `held` once returned."""
        for name, own in self.held().items():
            np.copyto(own, array_from(state, name, np.float64, own.shape))
