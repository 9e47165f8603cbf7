"""The sums of the solver's twin (`verify.plain`): particles to nodes, nodes, nodes to particles."""

from math import floor, sqrt

import numpy as np

from mpmgeo.mpm.core.opening import confine
from mpmgeo.mpm.core.point import advance
from mpmgeo.numerics.jit import compiled, inlined
from mpmgeo.shapes.shape import cut_of, stencil, width
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
    `own`: masses or None, volumes, stresses, variables of the law, given divergences or None,
    deformation gradients or None; `nodes`: M and U.
    """
    S = width(shape)
    transfer, fits, v, C = motion
    m, V, stress, state, θ, F = own
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
            ex, ey, ez = with_divergence(θ, dx, dy, dz, p)
            strain(law, rotation, ex, ey, ez, V, stress, state, F, p, dt)
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
def with_divergence(θ, dx, dy, dz, p):
    """Return the columns of a velocity gradient with a given trace, if there is one."""
    if θ is None:
        return dx, dy, dz
    d = (θ[p] - (dx[0] + dy[1] + dz[2])) / 3.0
    return plus(dx, d, (1.0, 0.0, 0.0)), plus(dy, d, (0.0, 1.0, 0.0)), plus(dz, d, (0.0, 0.0, 1.0))


@inlined
def strain(law, rotation, dx, dy, dz, V, stress, state, F, p, dt):
    """Update the material of particle p; `dx` … are the columns of its velocity gradient."""
    x, y, z = plus(ZERO, dt, dx), plus(ZERO, dt, dy), plus(ZERO, dt, dz)
    xy, yz, xz = 0.5 * (x[1] + y[0]), 0.5 * (y[2] + z[1]), 0.5 * (z[0] + x[2])
    ε = x[0], y[1], z[2], xy, yz, xz
    W = 0.5 * (y[0] - x[1]), 0.5 * (z[1] - y[2]), 0.5 * (z[0] - x[2])
    advance(law, rotation, ε, W, V, stress, state, None, None, None, F, p, dt)


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
