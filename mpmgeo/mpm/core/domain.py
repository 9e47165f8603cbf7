"""The domain of a particle: the box for which it stands in interpolation, as its material deforms.

A box with the half edges l₀ deforms into a parallelepiped, whose places have the second moments

    B = F diag(l₀²) Fᵀ,    B ← A B Aᵀ,    A = I + L Δt

about its middle, but for a factor of three. The domain is the box along the axes that has the same
ones: its half edges are lₐ = √Bₐₐ. A stretch along an axis changes that edge alone, a turn by a
right angle exchanges edges, and no turn changes a cube, for A is then orthogonal.

Domains that follow touch each other as long as their middles do, too. The mean velocity *in* a
domain is not that of its middle where the velocity has a kink at a node: gaps and overlaps would
grow there, and where the material is in tension they drive themselves. So particles move with the
mean velocity of the *corners*,

    x ← x + Δt ⅛ Σ_c N(x_c) v,    N the hats of the nodes,

by the same nodal velocities that L is of.

Source: Bardenhagen and Kober (2004), CMES 5(6), 477–496, for domains that deform; Coombs et al.
(2020), CMAME 358, 112622, for stretches in place of Fₐₐ, which vanishes in a quarter turn;
Sadeghirad, Brannon and Burghardt (2011), Int. J. Numer. Meth. Engng 86, 1435–1456, for fields at
corners. Second moments, which need no roots of tensors, and places that follow corners are ours.
"""

from math import sqrt

from mpmgeo.materials.rotation import times_row
from mpmgeo.mpm.core.stencils import half_size, in_block
from mpmgeo.numerics.jit import inlined
from mpmgeo.numerics.simd import LANES, along, axpy, lane, load, load_row, pack4, quarter, truncate
from mpmgeo.shapes.shape import ends, width
from mpmgeo.state.layout import SIDE, place

MOST = 0.5
"""Half-size in cells from which on shapes see no larger one."""


@inlined
def deform(follower, here, sx, sy, sz, dt, p):
    """Let domain and half-sizes of particle p follow the slopes per cell of the node records.

    `follower`: that of `ParticleSet`, or None.
    """
    if follower is not None:
        domain, least = follower
        x, y, z = here.mesh.ix * dt, here.mesh.iy * dt, here.mesh.iz * dt
        B = (domain[p, 0], domain[p, 1], domain[p, 2], domain[p, 3], domain[p, 4], domain[p, 5])
        new = moments(
            B,
            (1.0 + x * lane(sx, 0), x * lane(sy, 0), x * lane(sz, 0)),
            (y * lane(sx, 1), 1.0 + y * lane(sy, 1), y * lane(sz, 1)),
            (z * lane(sx, 2), z * lane(sy, 2), 1.0 + z * lane(sz, 2)),
        )
        for a in range(6):
            domain[p, a] = new[a]
        for a in range(3):
            here.half[p, a] = min(max(sqrt(new[a]), least[a]), MOST)


@inlined
def moments(B, x, y, z):
    """Return A B Aᵀ for the rows x, y, z of A; symmetric tensors are xx yy zz xy yz xz."""
    X = times_row(B, x[0], x[1], x[2])
    Y = times_row(B, y[0], y[1], y[2])
    Z = times_row(B, z[0], z[1], z[2])
    return (
        X[0] * x[0] + X[1] * x[1] + X[2] * x[2],
        Y[0] * y[0] + Y[1] * y[1] + Y[2] * y[2],
        Z[0] * z[0] + Z[1] * z[1] + Z[2] * z[2],
        X[0] * y[0] + X[1] * y[1] + X[2] * y[2],
        Y[0] * z[0] + Y[1] * z[1] + Y[2] * z[2],
        X[0] * z[0] + X[1] * z[1] + X[2] * z[2],
    )


@inlined
def moved_with_corners(follower, dt, here, n, X, p):
    """Return where the corners of its domain move particle p, X if `follower` is None.

    `n`: where the records of its nodes begin.
    """
    if follower is None:
        return X
    S = width(here.shape)
    old = load_row(here.x, p)
    g = in_block(here.mesh, here.origin, old)
    first = min(max(truncate(g - 0.5 * (S - 2)), 0.0), SIDE - 1.0)
    w = ends(here.shape, g - first - 0.5 * (S - 1), half_size(here.half, p))
    return axpy(dt, _mean(here, n, along(w, 0), along(w, 1), along(w, 2)), old)


@inlined
def _mean(here, n0, wx, wy, wz):
    """Return the sum of the nodal velocities, times weights, of the records from n0 on."""
    mean = pack4(0.0, 0.0, 0.0, 0.0)
    for i in range(len(wx)):
        for j in range(len(wy)):
            n, row = n0 + place(here.rows, i, j, 0) * LANES, pack4(0.0, 0.0, 0.0, 0.0)
            for k in range(len(wz)):
                row = axpy(wz[k], quarter(load(here.source, n + k * LANES), 0), row)
            mean = axpy(wx[i] * wy[j], row, mean)
    return mean
