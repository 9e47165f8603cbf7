"""The solver's twin: a step of the material point method written down as its equations stand.

One particle after the other, on a dense grid, in one thread. Tests compare the solver with it and
benchmarks measure against it. Capitals are nodal: mass M, momentum P, force F, velocity U and
acceleration A.

    M = Σ m S,   P = Σ m v S,   F = Σ (f S − V σ ∇S),   U = P/M,   A = F/M
    v ← v + h Σ A S,   x ← x + Δt Σ U S,   L = Σ U ⊗ ∇S,   Δε = ½(L + Lᵀ) Δt

Source: Sulsky, Zhou and Schreyer (1995), Comput. Phys. Commun. 87, 236–252, sections 3 and 4.
"""

from math import floor
from typing import NamedTuple

import numpy as np

from mpmgeo.boundaries.planes import FIXED, SLIDING
from mpmgeo.materials.law import update_stress
from mpmgeo.mpm.schemes import musl, usf, usl
from mpmgeo.numerics.jit import compiled, inlined
from mpmgeo.shapes.shape import stencil, width

ZERO = (0.0, 0.0, 0.0)


class Box(NamedTuple):
    """The mesh, and how many rows of nodes the dense grid has around it."""

    origin: tuple
    cell: tuple
    cells: tuple
    ghosts: int


@inlined
def plus(a, s, b):
    """Return the vector a + s b."""
    return a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]


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
def along(shape, box, half, x, p, axis):
    """Return the first node of particle p along an axis, its weights and slopes per cell."""
    S = width(shape)
    g = (x[p, axis] - box.origin[axis]) / box.cell[axis]
    first = int(floor(g - 0.5 * (S - 2)))
    return first + box.ghosts, stencil(shape, g - first - 0.5 * (S - 1), half[p, axis])


@inlined
def slopes(wx, wy, wz, i, j, k, cell):
    """Return ∇S of the node (i, j, k) of a stencil."""
    S = len(wx) // 2
    return (
        wx[S + i] * wy[j] * wz[k] / cell[0],
        wx[i] * wy[S + j] * wz[k] / cell[1],
        wx[i] * wy[j] * wz[S + k] / cell[2],
    )


@compiled
def scatter(shape, box, rows, half, x, v, m, V, stress, force, M, P, F):
    """Add mass and momentum to the nodes, and force; what is None is left out."""
    S = width(shape)
    for p in rows:
        I, wx = along(shape, box, half, x, p, 0)
        J, wy = along(shape, box, half, x, p, 1)
        K, wz = along(shape, box, half, x, p, 2)
        mass = m[p]
        momentum = plus(ZERO, mass, (v[p, 0], v[p, 1], v[p, 2]))
        f = force[p, 0], force[p, 1], force[p, 2]
        xx, yy, zz = V[p] * stress[p, 0], V[p] * stress[p, 1], V[p] * stress[p, 2]
        xy, yz, xz = V[p] * stress[p, 3], V[p] * stress[p, 4], V[p] * stress[p, 5]
        for i in range(S):
            for j in range(S):
                for k in range(S):
                    n = I + i, J + j, K + k
                    w = wx[i] * wy[j] * wz[k]
                    if M is not None:
                        M[n] += w * mass
                        add(P, n, plus(ZERO, w, momentum))
                    if F is not None:
                        gx, gy, gz = slopes(wx, wy, wz, i, j, k, box.cell)
                        total = plus(ZERO, w, f)
                        total = plus(total, -gx, (xx, xy, xz))
                        total = plus(total, -gy, (xy, yy, yz))
                        total = plus(total, -gz, (xz, yz, zz))
                        add(F, n, total)


@compiled
def gather(shape, box, law, rows, half, x, v, V, stress, A, drift, U, dt, h):
    """Change v by the nodal A, x by the nodal drift, strain with the nodal U; None is left out."""
    S = width(shape)
    for p in rows:
        I, wx = along(shape, box, half, x, p, 0)
        J, wy = along(shape, box, half, x, p, 1)
        K, wz = along(shape, box, half, x, p, 2)
        a = u = dx = dy = dz = ZERO
        for i in range(S):
            for j in range(S):
                for k in range(S):
                    n = I + i, J + j, K + k
                    w = wx[i] * wy[j] * wz[k]
                    if A is not None:
                        a = plus(a, w, vector(A, n))
                    if drift is not None:
                        u = plus(u, w, vector(drift, n))
                    if law is not None:
                        gx, gy, gz = slopes(wx, wy, wz, i, j, k, box.cell)
                        U_n = vector(U, n)
                        dx, dy, dz = plus(dx, gx, U_n), plus(dy, gy, U_n), plus(dz, gz, U_n)
        for c in range(3):
            v[p, c] += h * a[c]
            x[p, c] += dt * u[c]
        if law is not None:
            strain(law, dx, dy, dz, V, stress, p, dt)


@inlined
def strain(law, dx, dy, dz, V, stress, p, dt):
    """Update volume and stress of particle p for the columns of its velocity gradient."""
    ε = (
        dx[0] * dt,
        dy[1] * dt,
        dz[2] * dt,
        0.5 * (dx[1] + dy[0]) * dt,
        0.5 * (dy[2] + dz[1]) * dt,
        0.5 * (dz[0] + dx[2]) * dt,
    )
    V[p] *= 1.0 + (ε[0] + ε[1] + ε[2])
    s = stress[p]
    new = update_stress(law, (s[0], s[1], s[2], s[3], s[4], s[5]), ε, (), dt)
    for c in range(6):
        stress[p, c] = new[c]


@compiled
def move_nodes(h, local, cutoff, free, M, P, F, U, A):
    """Make velocity of the nodal momentum and, unless the force is None, integrate it over h.

    `free`: which components the planes leave; `local`: share of local damping, None without.
    """
    for n in np.ndindex(M.shape):
        u = a = ZERO
        if M[n] > cutoff:
            u = times(vector(free, n), plus(ZERO, 1.0 / M[n], vector(P, n)))
            if F is not None:
                a = times(vector(free, n), plus(ZERO, 1.0 / M[n], vector(F, n)))
                if local is not None:
                    a = times(vector(free, n), plus(a, -local * size(a) / max(size(u), TINY), u))
                u = plus(u, h, a)
        for c in range(3):
            U[n[0], n[1], n[2], c] = u[c]
            if F is not None:
                A[n[0], n[1], n[2], c] = a[c]


@compiled
def leave(box, x, active):
    """Take out the particles that are not in the mesh; return how many."""
    left = 0
    for p in range(len(x)):
        for c in range(3):
            g = (x[p, c] - box.origin[c]) / box.cell[c]
            if active[p] and not (g >= 0.0 and g <= box.cells[c]):
                active[p] = False
                left += 1
    return left


def free_components(box, planes):
    """Return 0 for nodal components (nx, ny, nz, 3) that a plane holds, 1 for others."""
    shape = [n + 1 + 2 * box.ghosts for n in box.cells]
    free = np.ones((*shape, 3))
    kinds = (planes.x0, planes.y0, planes.z0), (planes.xn, planes.yn, planes.zn)
    for axis in range(3):
        along_axis = np.moveaxis(free, axis, 0)
        lower, upper = along_axis[: box.ghosts + 1], along_axis[box.ghosts + box.cells[axis] :]
        for slab, kind in ((lower, kinds[0][axis]), (upper, kinds[1][axis])):
            if kind == FIXED:
                slab[:] = 0.0
            elif kind == SLIDING:
                slab[..., axis] = 0.0
    return free


class PlainSolver:
    """A copy of a solver's state that steps on by itself; arrays `x`, `v` … are in row order.

    Raises ValueError for a moving base, point loads, damping other than local, laws with a state.
    """

    def __init__(self, solver):
        if solver.base or solver.point_loads or solver.delayed or solver.settles:
            raise ValueError("no moving base, point loads or damping but local in the plain solver")
        if any(s.law.STATE for s in solver.sets):
            raise ValueError("no laws with variables of their own in the plain solver")
        self.shape, self.time_step, self.steps = solver.shape, solver.time_step, solver.steps
        self.local, self.cutoff = solver.local, solver.cutoff
        mesh, ghosts = solver.grid.mesh, (width(solver.shape) + 1) // 2
        self.box = Box(mesh[:3], mesh[3:6], mesh[9:], ghosts)
        self._copy_particles(solver)
        self.free = free_components(self.box, solver.planes)
        self.M = np.zeros(self.free.shape[:3])
        self.P, self.F, self.U, self.A = (np.zeros_like(self.free) for _ in range(4))
        self._step = {usl: self._usl, musl: self._musl, usf: self._usf}[solver.scheme]

    def _copy_particles(self, solver):
        n = solver.count
        self.x, self.v, self.force, self.half = (np.zeros((n, 3)) for _ in range(4))
        self.m, self.V, self.stress = np.zeros(n), np.zeros(n), np.zeros((n, 6))
        self.active = np.zeros(n, bool)
        self.bodies = [(s.law, np.sort(s.row)) for s in solver.sets]
        for s in solver.sets:
            self.x[s.row], self.v[s.row], self.stress[s.row] = s.x, s.v, s.stress
            self.m[s.row], self.V[s.row], self.half[s.row] = s.m, s.V, s.half
            self.force[s.row] = s.m[:, None] * solver.gravity
            if s.force is not None:
                self.force[s.row] += s.force
            self.active[s.row[: s.active]] = True

    def step(self):
        """Advance by one time step; the first one changes velocities by half a step."""
        h = 0.5 * self.time_step if self.steps == 0 else self.time_step
        if leave(self.box, self.x, self.active) or self.steps == 0:
            self.rows = [rows[self.active[rows]] for rows in self.all_rows]
        self._step(h)
        self.steps += 1
