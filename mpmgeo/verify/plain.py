"""The solver's twin: a step of the material point method written down as its equations stand.

One particle after the other, on a dense grid, in one thread. Tests compare the solver with it and
benchmarks measure against it.

    m = Σ m S,    p = Σ m v S,    f = Σ (f S − V σ ∇S),    v = p/m,    a = f/m          on nodes
    v ← v + h Σ a S,    x ← x + Δt Σ v S,    L = Σ v ⊗ ∇S,    Δε = ½(L + Lᵀ) Δt     on particles

Source: Sulsky, Zhou and Schreyer (1995), Comput. Phys. Commun. 87, 236–252, sections 3 and 4.
"""

from typing import NamedTuple

import numpy as np

from mpmgeo.boundaries.planes import FIXED, SLIDING
from mpmgeo.materials.law import update_stress
from mpmgeo.mpm.schemes import musl, usf, usl
from mpmgeo.numerics.jit import compiled, inlined
from mpmgeo.shapes.shape import stencil, width


class Box(NamedTuple):
    """The mesh, and how many rows of nodes the dense grid has around it."""

    origin: tuple
    cell: tuple
    cells: tuple
    ghosts: int


class Particles(NamedTuple):
    """The particles in row order."""

    row: np.ndarray  # (n,) those that take part
    x: np.ndarray  # (n, 3) position [m]
    v: np.ndarray  # (n, 3) velocity [m/s]
    m: np.ndarray  # (n,) mass [kg]
    V: np.ndarray  # (n,) volume [m³]
    stress: np.ndarray  # (n, 6) [Pa]
    half: np.ndarray  # (n, 3) half-sizes in cells
    force: np.ndarray  # (n, 3) external force [N]


@inlined
def place(shape, box, x, half, p, axis):
    """Return the first node of particle p along an axis, and its weights and slopes per cell."""
    g = (x[p, axis] - box.origin[axis]) / box.cell[axis]
    S = width(shape)
    first = int(np.floor(g - 0.5 * (S - 2)))
    return first + box.ghosts, stencil(shape, g - first - 0.5 * (S - 1), half[p, axis])


@compiled
def scatter(shape, box, rows, x, v, m, V, stress, half, force, M, P, F):
    """Add mass and momentum to the nodal M and P, forces to F; what is None is left out."""
    S = width(shape)
    hx, hy, hz = box.cell
    for p in rows:
        I, wx = place(shape, box, x, half, p, 0)
        J, wy = place(shape, box, x, half, p, 1)
        K, wz = place(shape, box, x, half, p, 2)
        xx, yy, zz = V[p] * stress[p, 0], V[p] * stress[p, 1], V[p] * stress[p, 2]
        xy, yz, xz = V[p] * stress[p, 3], V[p] * stress[p, 4], V[p] * stress[p, 5]
        for i in range(S):
            for j in range(S):
                for k in range(S):
                    n = I + i, J + j, K + k
                    w = wx[i] * wy[j] * wz[k]
                    if M is not None:
                        M[n] += w * m[p]
                        for a in range(3):
                            P[n][a] += w * m[p] * v[p, a]
                    if F is not None:
                        gx = wx[S + i] * wy[j] * wz[k] / hx
                        gy = wx[i] * wy[S + j] * wz[k] / hy
                        gz = wx[i] * wy[j] * wz[S + k] / hz
                        f = F[n]
                        f[0] += w * force[p, 0] - (xx * gx + xy * gy + xz * gz)
                        f[1] += w * force[p, 1] - (xy * gx + yy * gy + yz * gz)
                        f[2] += w * force[p, 2] - (xz * gx + yz * gy + zz * gz)


@compiled
def gather(shape, box, law, rows, x, v, V, stress, half, A, drift, U, dt, h):
    """Change v by the nodal A, x by the nodal drift, strain with the nodal U; None is left out."""
    S = width(shape)
    dv, dx, L = np.zeros(3), np.zeros(3), np.zeros((3, 3))
    for p in rows:
        I, wx = place(shape, box, x, half, p, 0)
        J, wy = place(shape, box, x, half, p, 1)
        K, wz = place(shape, box, x, half, p, 2)
        dv[:], dx[:], L[:] = 0.0, 0.0, 0.0
        for i in range(S):
            for j in range(S):
                for k in range(S):
                    n = I + i, J + j, K + k
                    w = wx[i] * wy[j] * wz[k]
                    if A is not None:
                        for a in range(3):
                            dv[a] += w * A[n][a]
                    if drift is not None:
                        for a in range(3):
                            dx[a] += w * drift[n][a]
                    if law is not None:
                        gx = wx[S + i] * wy[j] * wz[k] / box.cell[0]
                        gy = wx[i] * wy[S + j] * wz[k] / box.cell[1]
                        gz = wx[i] * wy[j] * wz[S + k] / box.cell[2]
                        for a in range(3):
                            u = U[n][a]
                            L[a, 0] += u * gx
                            L[a, 1] += u * gy
                            L[a, 2] += u * gz
        for a in range(3):
            v[p, a] += h * dv[a]
            x[p, a] += dt * dx[a]
        if law is not None:
            strain(law, L, V, stress, p, dt)


@inlined
def strain(law, L, V, stress, p, dt):
    ε = (
        L[0, 0] * dt,
        L[1, 1] * dt,
        L[2, 2] * dt,
        0.5 * (L[0, 1] + L[1, 0]) * dt,
        0.5 * (L[1, 2] + L[2, 1]) * dt,
        0.5 * (L[0, 2] + L[2, 0]) * dt,
    )
    V[p] *= 1.0 + (ε[0] + ε[1] + ε[2])
    s = stress[p]
    new = update_stress(law, (s[0], s[1], s[2], s[3], s[4], s[5]), ε, (), dt)
    for c in range(6):
        stress[p, c] = new[c]
