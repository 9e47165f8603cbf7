"""The solver's twin: a step of the material point method written down as its equations stand.

One particle after the other, on a dense grid, in one thread, for tests and benchmarks to compare
with. Capitals are nodal: mass M, momentum P, force F, velocity U, acceleration A.

    M = Σ m S,   P = Σ m v S,   F = Σ (f S − V σ ∇S),   A = F/M,   U = P/M + h A
    v ← v + h Σ A S,   x ← x + Δt Σ U S,   L = Σ U ⊗ ∇S,   Δε = ½(L + Lᵀ) Δt

Source: Sulsky, Zhou and Schreyer (1995), Comput. Phys. Commun. 87, 236–252, sections 3 and 4; for
Newmark's method `mpm.newmark`.
"""

import numpy as np

from mpmgeo.materials.hyperelastic import is_hyperelastic
from mpmgeo.mpm.newmark import Newmark, PredictorCorrector
from mpmgeo.mpm.schemes import first_step, musl, usf, usl
from mpmgeo.shapes.shape import width
from mpmgeo.transfers.apic import Symbols as Fitted
from mpmgeo.verify.dense_grid import Box, free_components
from mpmgeo.verify.plain_transfers import gather, leave, scatter, update_nodes


class PlainSolver:
    """A copy of a solver's state that steps on by itself; its arrays are in row order.

    `state` has the variables of each set's law, for all rows. Raises ValueError for a moving base,
    point loads, prescribed velocities and damping other than local.
    """

    EFFECTS = ()  # names of those that it knows

    def __init__(self, solver):
        others = [effect for effect in solver.effects if effect.name not in self.EFFECTS]
        if others or solver.early_damping or len(solver.damping) > 1:
            raise ValueError("the plain solver has gravity, box loads and local damping only")
        if solver.cells is not None and type(self) is PlainSolver:
            raise ValueError("the plain solver shares no strain in cells; PlainSharing does")
        self.shape, self.time_step, self.steps = solver.shape, solver.time_step, solver.steps
        self.local = solver.damping[0].α if solver.damping else None
        self.cutoff, self.transfer = solver.cutoff, solver.transfer
        self.fits = isinstance(solver.transfer, Fitted)
        mesh = solver.grid.mesh
        self.box = Box.of(mesh, solver.planes, ghosts=(width(solver.shape) + 1) // 2)
        self.free = free_components(self.box, solver.planes)
        self.M = np.zeros(self.free.shape[:3])
        self.P, self.F, self.U, self.A = (np.zeros_like(self.free) for _ in range(4))
        self._copy(solver)
        self.scheme = solver.scheme

    def _copy(self, solver):
        n = solver.count
        self.m, self.V, self.pressure, self.stress = *np.zeros((3, n)), np.zeros((n, 6))
        self.x, self.v, self.a, self.force, self.half = (np.zeros((n, 3)) for _ in range(5))
        self.gradient, self.active = np.zeros((n, 9)), np.zeros(n, bool)
        is_affine = any(s.C is not None for s in solver.sets)
        self.C = np.zeros((n, 3, 3)) if is_affine else None
        for s in solver.sets:
            self.active[s.row[: s.active]] = True
            self.m[s.row], self.V[s.row], self.half[s.row] = s.m, s.V, s.half
            self.x[s.row], self.v[s.row], self.stress[s.row] = s.x, s.v, s.stress
            if s.a is not None:
                self.a[s.row] = s.a
            if s.C is not None:
                self.C[s.row] = s.C
            self.force[s.row] = s.m[:, None] * solver.gravity
            if s.F is not None:
                self.gradient[s.row] = s.F
            if s.force is not None:
                self.force[s.row] += s.force
            if s.pressure is not None:
                self.pressure[s.row] = s.pressure
        self.sets = [(s.law, s.rotation, np.sort(s.row[: s.active])) for s in solver.sets]
        self.state = [np.zeros((n, len(s.law.STATE))) for s in solver.sets]
        for s, state in zip(solver.sets, self.state, strict=True):
            if s.state is not None:
                state[s.row] = s.state

    def step(self):
        """Advance by one time step; the first one changes velocities by half a step."""
        if leave(self.box, self.x, self.active):
            self.sets = [(*laws, rows[self.active[rows]]) for *laws, rows in self.sets]
        h = self.time_step * (first_step(self.scheme) if self.steps == 0 else 1.0)
        if isinstance(self.scheme, Newmark):
            self._newmark(self.scheme, h)
        else:
            {usl: self._usl, musl: self._musl, usf: self._usf}[self.scheme](h)
        self.steps += 1

    def _usl(self, h):
        self._scatter(self.M, self.P, self.F)
        self._update_nodes(h, self.F)
        self._gather(h, self.A, self.U, strains=True)

    def _musl(self, h):
        self._scatter(self.M, self.P, self.F)
        self._update_nodes(h, self.F)
        self._gather(h, self.A, None)
        drift = self.U.copy()
        self._scatter(self.M, self.P, None)
        self._update_nodes(h, None)
        self._gather(h, None, drift, strains=True)

    def _usf(self, h):
        self._scatter(self.M, self.P, None)
        self._update_nodes(h, None)
        self._gather(h, None, None, strains=True)
        self._scatter(None, None, self.F)
        self._update_nodes(h, self.F)
        self._gather(h, self.A, self.U)

    def _newmark(self, scheme, h):
        is_paper, γ = isinstance(scheme, PredictorCorrector), scheme.γ
        v, a = self.v.copy(), self.a.copy()
        self.v += h * (1 - γ if is_paper else 0.5) * a
        self._scatter(self.M, self.P, None)
        self._update_nodes(h, None)
        before = self.U.copy()
        self._gather(h, None, None, strains=True)
        self._scatter(None, None, self.F)
        self._update_nodes(h, self.F)
        after = before + γ * (self.U - before) if is_paper else before
        self.v[:] = 0.0
        self._gather(1.0, self.A, after)
        self.a, self.v = self.v, v
        if is_paper:
            self.x += 0.5 * h * h * self.a
            self.v += h * self.a
        else:
            self.v += (1 - γ) * h * a + γ * h * self.a

    def _scatter(self, M, P, F):
        for nodal in (M, P, F):
            if nodal is not None:
                nodal[:] = 0.0
        for *_, rows in self.sets:
            scatter(
                *(self.shape, self.box, rows, self.half, self.x, (self.v, self.C), self.m),
                *(self.V, self.stress, self.pressure, self.force, M, P, F),
            )

    def _divergence(self, rows):
        """Return the divergences that strains are to have, None for those of the particles."""

    def _update_nodes(self, h, F):
        update_nodes(h, self.local, self.cutoff, self.free, self.M, self.P, F, self.U, self.A)

    def _gather(self, h, A, drift, strains=False):
        motion = self.transfer, self.fits, self.v, self.C
        for (law, rotation, rows), state in zip(self.sets, self.state, strict=True):
            m = self.m if getattr(law, "GRAINS", False) else None
            θ = self._divergence(rows) if strains else None
            F = self.gradient if is_hyperelastic(law) else None
            own = m, self.V, self.stress, state, θ, F
            gather(
                *(self.shape, self.box, law if strains else None, rotation, rows, self.half),
                *(self.x, motion, own, (self.M, self.U), A, drift, self.time_step, h),
            )
