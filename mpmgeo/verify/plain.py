"""The solver's twin: a step of the material point method written down as its equations stand.

One particle after the other, on a dense grid, in one thread, for tests and benchmarks to compare
with. Capitals are nodal: mass M, momentum P, force F, velocity U, acceleration A.

    M = Σ m S,   P = Σ m v S,   F = Σ (f S − V σ ∇S),   A = F/M,   U = P/M + h A
    v ← v + h Σ A S,   x ← x + Δt Σ U S,   L = Σ U ⊗ ∇S,   Δε = ½(L + Lᵀ) Δt

Source: Sulsky, Zhou and Schreyer (1995), Comput. Phys. Commun. 87, 236–252, sections 3 and 4.
"""

from math import floor, sqrt

import numpy as np

from mpmgeo.mpm.core.opening import confine
from mpmgeo.mpm.core.point import advance
from mpmgeo.mpm.schemes import musl, usf, usl
from mpmgeo.numerics.jit import compiled, inlined
from mpmgeo.shapes.shape import cut_of, stencil, width
from mpmgeo.transfers.apic import Symbols as Fitted
from mpmgeo.verify.dense_grid import Box, free_components
from mpmgeo.verify.plain_motion import ZERO, keep, new_velocity, plus, velocity_at, way


@inlined
def size(a):
    """Return the length of a vector."""
    return sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2])


@inlined
def vector(field, n):
    """Return the vector of node n."""
    return field[n[0], n[1], n[2], 0], field[n[0], n[1], n[2], 1], field[n[0], n[1], n[2], 2]


@inlined
def add(field, n, a):
    """Add a vector to node n."""
    for c in range(3):
        field[n[0], n[1], n[2], c] += a[c]


@inlined
def stencil_along(axis, shape, box, half, x, p):
    """Return the first node of particle p along an axis, its weights and slopes per cell."""
    S = width(shape)
    g = x[p, axis] / box.cell[axis]
    first = floor(g - 0.5 * (S - 2))
    cut = cut_of(shape, (box.lower[axis], box.upper[axis]), first)
    return first + box.ghosts, stencil(shape, g - first - 0.5 * (S - 1), half[p, axis], cut)


@inlined
def slopes(wx, wy, wz, i, j, k, cell):
    """Return ∇S of node (i, j, k) of a stencil."""
    S = len(wx) // 2
    return (
        wx[S + i] * wy[j] * wz[k] / cell[0],
        wx[i] * wy[S + j] * wz[k] / cell[1],
        wx[i] * wy[j] * wz[S + k] / cell[2],
    )


@compiled
def scatter(shape, box, rows, half, x, motion, m, V, stress, pressure, force, M, P, F):
    """Add mass and momentum to the nodes, and force; what is None is left out.

    `motion`: v, and C or None.
    """
    S = width(shape)
    v, C = motion
    for p in rows:
        I, wx = stencil_along(0, shape, box, half, x, p)
        J, wy = stencil_along(1, shape, box, half, x, p)
        K, wz = stencil_along(2, shape, box, half, x, p)
        mass = m[p]
        f = force[p, 0], force[p, 1], force[p, 2]
        u = -V[p] * pressure[p]
        xx, yy, zz = u + V[p] * stress[p, 0], u + V[p] * stress[p, 1], u + V[p] * stress[p, 2]
        xy, yz, xz = V[p] * stress[p, 3], V[p] * stress[p, 4], V[p] * stress[p, 5]
        for i in range(S):
            for j in range(S):
                for k in range(S):
                    n = I + i, J + j, K + k
                    w = wx[i] * wy[j] * wz[k]
                    if M is not None:
                        M[n] += w * mass
                        u = velocity_at(v, C, way(box, n, x, p), p)
                        add(P, n, plus(ZERO, w * mass, u))
                    if F is not None:
                        gx, gy, gz = slopes(wx, wy, wz, i, j, k, box.cell)
                        total = plus(ZERO, w, f)
                        total = plus(total, -gx, (xx, xy, xz))
                        total = plus(total, -gy, (xy, yy, yz))
                        total = plus(total, -gz, (xz, yz, zz))
                        add(F, n, total)


@compiled
def update_nodes(h, local, cutoff, free, M, P, F, U, A):
    """Make velocities of the nodal momentum and, unless the force is None, integrate it over h.

    `free`: 0 where a plane holds; `local`: share of local damping; `cutoff`: see `grid_update`.
    """
    for n in np.ndindex(M.shape):
        u = a = ZERO
        if M[n] > 0.0:
            u = held(free, n, plus(ZERO, 1.0 / M[n], vector(P, n)))
            if F is not None:
                a = held(free, n, plus(ZERO, 1.0 / M[n], vector(F, n)))
                if local is not None and size(u) > 0.0:
                    a = held(free, n, plus(a, -local * size(a) / size(u), u))
                if M[n] > cutoff:
                    u = plus(u, h, a)
        for c in range(3):
            U[n[0], n[1], n[2], c] = u[c]
            if F is not None:
                A[n[0], n[1], n[2], c] = a[c]


@inlined
def held(free, n, a):
    """Return what the planes leave of a vector of node n."""
    f = vector(free, n)
    return f[0] * a[0], f[1] * a[1], f[2] * a[2]


@compiled
def gather(shape, box, law, rotation, rows, half, x, motion, own, nodes, A, drift, dt, h):
    """Change v by the nodal A, move x with `drift`, strain with U; what is None is left out.

    `law` None: no strain; `motion`: transfer or None, whether its gradient is fitted, v, C or None;
    `own`: masses or None, volumes, stresses, variables of the law; `nodes`: M and U.
    """
    S = width(shape)
    transfer, fits, v, C = motion
    m, V, stress, state = own
    M, U = nodes
    for p in rows:
        I, wx = stencil_along(0, shape, box, half, x, p)
        J, wy = stencil_along(1, shape, box, half, x, p)
        K, wz = stencil_along(2, shape, box, half, x, p)
        a = u = new = D = dx = dy = dz = bx = by = bz = ZERO
        mass = 0.0
        for i in range(S):
            for j in range(S):
                for k in range(S):
                    n = I + i, J + j, K + k
                    w = wx[i] * wy[j] * wz[k]
                    if A is not None:
                        a = plus(a, w, vector(A, n))
                    if drift is not None:
                        u = plus(u, w, vector(drift, n))
                    gx, gy, gz = slopes(wx, wy, wz, i, j, k, box.cell)
                    nodal, d = vector(U, n), way(box, n, x, p)
                    dx, dy, dz = plus(dx, gx, nodal), plus(dy, gy, nodal), plus(dz, gz, nodal)
                    mass += w * M[n]
                    new, D = plus(new, w, nodal), plus(D, w, (d[0] ** 2, d[1] ** 2, d[2] ** 2))
                    bx, by = plus(bx, w * d[0], nodal), plus(by, w * d[1], nodal)
                    bz = plus(bz, w * d[2], nodal)
        if law is not None:
            confine(law, box.mesh, x, mass, m, V, state, p)
            strain(law, rotation, dx, dy, dz, V, stress, state, p, dt)
        if fits:
            bx, by, bz = (
                plus(ZERO, 1 / D[0], bx),
                plus(ZERO, 1 / D[1], by),
                plus(ZERO, 1 / D[2], bz),
            )
            keep(A, C, (bx, by, bz), p)
        else:
            keep(A, C, (dx, dy, dz), p)
        for c in range(3):
            v[p, c] = new_velocity(transfer, A, h, v[p, c], new[c], a[c])
            x[p, c] += dt * u[c]


@inlined
def strain(law, rotation, dx, dy, dz, V, stress, state, p, dt):
    """Update the material of particle p; `dx` … are the columns of its velocity gradient."""
    x, y, z = plus(ZERO, dt, dx), plus(ZERO, dt, dy), plus(ZERO, dt, dz)
    xy, yz, xz = 0.5 * (x[1] + y[0]), 0.5 * (y[2] + z[1]), 0.5 * (z[0] + x[2])
    ε = x[0], y[1], z[2], xy, yz, xz
    W = 0.5 * (y[0] - x[1]), 0.5 * (z[1] - y[2]), 0.5 * (z[0] - x[2])
    advance(law, rotation, ε, W, V, stress, state, None, None, None, p, dt)


@compiled
def leave(box, x, active):
    """Take out the particles that are not in the mesh; return how many."""
    left = 0
    for p in range(len(x)):
        for c in range(3):
            g = x[p, c] / box.cell[c]
            if active[p] and not (g >= 0.0 and g <= box.cells[c]):
                active[p] = False
                left += 1
    return left


class PlainSolver:
    """A copy of a solver's state that steps on by itself; its arrays are in row order.

    `state` has the variables of each set's law, for all rows. Raises ValueError for a moving base,
    point loads, prescribed velocities and damping other than local.
    """

    def __init__(self, solver):
        if solver.effects or solver.early_damping or len(solver.damping) > 1:
            raise ValueError("the plain solver has gravity, box loads and local damping only")
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
        self._scheme = {usl: self._usl, musl: self._musl, usf: self._usf}[solver.scheme]

    def _copy(self, solver):
        n = solver.count
        self.m, self.V, self.pressure, self.stress = *np.zeros((3, n)), np.zeros((n, 6))
        self.x, self.v, self.force, self.half = (np.zeros((n, 3)) for _ in range(4))
        self.active = np.zeros(n, bool)
        is_affine = any(s.C is not None for s in solver.sets)
        self.C = np.zeros((n, 3, 3)) if is_affine else None
        for s in solver.sets:
            self.active[s.row[: s.active]] = True
            self.m[s.row], self.V[s.row], self.half[s.row] = s.m, s.V, s.half
            self.x[s.row], self.v[s.row], self.stress[s.row] = s.x, s.v, s.stress
            if s.C is not None:
                self.C[s.row] = s.C
            self.force[s.row] = s.m[:, None] * solver.gravity
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
        self._scheme(0.5 * self.time_step if self.steps == 0 else self.time_step)
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

    def _scatter(self, M, P, F):
        for nodal in (M, P, F):
            if nodal is not None:
                nodal[:] = 0.0
        for *_, rows in self.sets:
            scatter(
                *(self.shape, self.box, rows, self.half, self.x, (self.v, self.C), self.m),
                *(self.V, self.stress, self.pressure, self.force, M, P, F),
            )

    def _update_nodes(self, h, F):
        update_nodes(h, self.local, self.cutoff, self.free, self.M, self.P, F, self.U, self.A)

    def _gather(self, h, A, drift, strains=False):
        motion = self.transfer, self.fits, self.v, self.C
        for (law, rotation, rows), state in zip(self.sets, self.state, strict=True):
            m = self.m if getattr(law, "GRAINS", False) else None
            own = m, self.V, self.stress, state
            gather(
                *(self.shape, self.box, law if strains else None, rotation, rows, self.half),
                *(self.x, motion, own, (self.M, self.U), A, drift, self.time_step, h),
            )
