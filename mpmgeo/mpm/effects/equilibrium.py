"""How far the material is from rest: the figures by which a run may end before its time.

    unbalanced force    max |f_n| / (1/N Σ F),   Σ F = Σ_p (|w_p| + 2 V Σ_a |σ e_a|/h_a) + Σ |P|
    kinetic energy      E / W,   W = Σ_p w_p · (x_p − X_p) + ∫ Σ P · v dt

f_n: resultant at a node, without what planes hold and before damping; N: number of nodes with mass;
w: weight and load of a particle, which pulls with V |σ e_a|/h_a at the nodes on either side of it;
P: loads on nodes; E: kinetic energy of the nodes, of their inertia, which may be scaled. Given pore
pressures count in σ, and in W with p (V − V₀). Velocities of particles that cancel at the nodes
move nothing; kinetic damping, which stops them, looks at all of them, and so does E with it.

All of it passes through zero in a vibration: forces in its middle, speeds at its ends. So a figure
is the largest of the last `LOOKS`. Between the stops of kinetic damping the energy grows from
nothing; there it is not less than that of the last stop, and endless before the first.
"""

import numpy as np

from mpmgeo.effect import Effect
from mpmgeo.state.checked import array_from

LOOKS = 5
"""Looks over which a figure has to hold."""

UNBALANCED, KINETIC = "unbalanced force", "kinetic energy"
"""The figures."""

SUMS = ("start", "done", "largest", "peak")
"""Work from the zero of coordinates at the start and at nodes so far, energies of the largest step
since the last look and of the last stop [J]."""


class Equilibrium(Effect):
    """Looks at the figures every so many steps; after loads and damping.

    `wanted`: limit of each figure by name; `since`: time [s] from which the loads are constant;
    `stops`: whether damping stops the particles at peaks of their energy.
    """

    name = "equilibrium"
    does_work = False

    def __init__(self, wanted, every, since=0.0, stops=False):
        self.wanted, self.every, self.since, self.stops = wanted, every, since, stops
        self.restarted(None)

    def restarted(self, solver):
        """Begin without any looks."""
        self.looks = np.full((len(self.wanted), LOOKS), np.inf)
        self.sums = dict.fromkeys(SUMS, 0.0) | {"start": np.nan}
        if self.stops:
            self.sums["peak"] = np.inf
        self._unbalanced = np.inf

    @property
    def figures(self):
        """Return the figures by name, infinite before the looks are enough."""
        return dict(zip(self.wanted, self.looks.max(axis=1).tolist(), strict=True))

    @property
    def latest(self):
        """Return the figures of the last look by name, infinite before the first."""
        return dict(zip(self.wanted, self.looks[:, -1].tolist(), strict=True))

    def is_reached(self, time):
        """Tell whether the loads are constant and all figures are below their limits."""
        below = all(figure <= self.wanted[name] for name, figure in self.figures.items())
        return below and time >= self.since

    def begin(self, solver, h):
        """Note what the loads count from."""
        if KINETIC in self.wanted and np.isnan(self.sums["start"]):
            self.sums["start"] = _work(solver)

    def before_nodes(self, solver, task):
        """Look at the forces if a look is due."""
        if UNBALANCED in self.wanted and (solver.steps + 1) % self.every == 0:
            work = task.work._replace(damping=(), early=None)
            solver.over_nodes(task._replace(work=work))  # which the step itself does once more
            self._unbalanced = _unbalanced(solver)
            solver.clock.lap(self.name)

    def after_nodes(self, solver, h):
        """Count the work of loads on nodes."""
        if KINETIC in self.wanted and (loads := solver.effect("point loads")) is not None:
            self.sums["done"] += solver.scaling * loads.work(solver, h)

    def stopped(self, solver):
        """Note at which energy damping has stopped the particles."""
        self.sums["peak"] = solver.scaling * solver.peak_energy

    def end(self, solver):
        """Look at the figures if a look is due."""
        due, sums = solver.steps % self.every == 0, self.sums
        if KINETIC in self.wanted and (due or solver.peak_energy is not None):
            energy = solver.peak_energy
            energy = _energy_of_nodes(solver) if energy is None else energy
            sums["largest"] = max(sums["largest"], solver.scaling * energy)
        if not due:
            return
        figures = {UNBALANCED: self._unbalanced, KINETIC: np.inf}
        if KINETIC in self.wanted:
            work = abs(_work(solver) - sums["start"] + sums["done"])
            figures[KINETIC] = max(sums["largest"], sums["peak"]) / work if work > 0 else np.inf
            sums["largest"] = 0.0
        self.looks[:, :-1] = self.looks[:, 1:]
        self.looks[:, -1] = [figures[name] for name in self.wanted]
        solver.clock.lap(self.name)

    def held(self):
        """Return the last looks and the sums."""
        return {"looks": self.looks, "sums": np.array(list(self.sums.values()))}

    def take(self, state):
        """Go on with what `held` once returned, or begin if the run had no such end before."""
        if not state:
            return
        np.copyto(self.looks, array_from(state, "looks", np.float64, self.looks.shape))
        sums = array_from(state, "sums", np.float64, (len(SUMS),))
        self.sums = dict(zip(SUMS, sums.tolist(), strict=True))


def _work(solver):
    """Return the work [J] of forces on particles from the zero of coordinates."""
    return float(solver.tally().potential.sum() + solver.tally(left=True).potential.sum())


def _energy_of_nodes(solver):
    """Return the kinetic energy [J] of the nodes with their last velocities."""
    of_node = solver.grid.solid.at_nodes
    v = of_node("velocity")
    return 0.5 * float((of_node("mass") * (v * v).sum(axis=1)).sum())


def _unbalanced(solver):
    """Return the largest resultant at a node over the mean of the forces, infinite without any.

    The nodes hold the accelerations that these resultants give them.
    """
    of_node = solver.grid.solid.at_nodes
    mass = of_node("mass")
    used = mass > solver.cutoff
    a = of_node("acceleration")[used]
    largest = float((mass[used] * np.sqrt((a * a).sum(axis=1))).max(initial=0.0))
    total = sum(_pulls(solver, s) for s in solver.sets)
    if (loads := solver.effect("point loads")) is not None:
        total += float(np.sqrt((loads.force**2).sum(axis=1)).sum())
    return largest * np.count_nonzero(used) / total if total > 0 else np.inf


def _pulls(solver, s):
    """Return the sum of the sizes of the forces [N] with which the particles of a set pull."""
    at, mesh = slice(0, s.active), solver.grid.mesh
    weight = s.m[at, None] * np.array(solver.gravity)
    if s.force is not None:
        weight = weight + s.force[at]
    xx, yy, zz, xy, yz, xz = s.stress[at].T
    if s.pressure is not None:
        xx, yy, zz = (σ - s.pressure[at] for σ in (xx, yy, zz))
    rows = ((xx, xy, xz, mesh.hx), (xy, yy, yz, mesh.hy), (xz, yz, zz, mesh.hz))
    pulls = sum(np.sqrt(x * x + y * y + z * z) / h for x, y, z, h in rows)
    return float(np.sqrt((weight * weight).sum(axis=1)).sum() + 2.0 * (s.V[at] * pulls).sum())
