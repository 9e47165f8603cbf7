"""How particles of the plain twin move: what they bring to the nodes, and take from them.

With an affine transfer P = Σ m (v + C (X − x)) S, v ← Σ U S, and C ← L, or C ← B/D axis by axis,

    B = Σ S U ⊗ (X − x),   D = Σ S (X − x)²,   X: where the node is.

Sources: those of `mpmgeo.transfers`.
"""

from mpmgeo.numerics.jit import inlined
from mpmgeo.transfers.transfer import carried

ZERO = (0.0, 0.0, 0.0)


@inlined
def plus(a, s, b):
    """Return the vector a + s b."""
    return a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]


@inlined
def way(box, n, x, p):
    """Return the vector from particle p to node n."""
    g, h = box.ghosts, box.cell
    return (
        (n[0] - g) * h[0] - x[p, 0],
        (n[1] - g) * h[1] - x[p, 1],
        (n[2] - g) * h[2] - x[p, 2],
    )


@inlined
def velocity_at(v, C, d, p):
    """Return v + C d for particle p; C has the derivatives along an axis in a row, or is None."""
    u = v[p, 0], v[p, 1], v[p, 2]
    if C is None:
        return u
    u = plus(u, d[0], (C[p, 0, 0], C[p, 0, 1], C[p, 0, 2]))
    u = plus(u, d[1], (C[p, 1, 0], C[p, 1, 1], C[p, 1, 2]))
    return plus(u, d[2], (C[p, 2, 0], C[p, 2, 1], C[p, 2, 2]))


@inlined
def new_velocity(transfer, A, h, v, u, a):
    """Return a component of a particle's velocity; `transfer` None: FLIP, A None: it stays."""
    if A is None:
        return v
    if transfer is None:
        return v + h * a
    return carried(transfer, h, v, u, a)


@inlined
def keep(A, C, columns, p):
    """Keep a velocity gradient, if particles have one and A says that velocities change."""
    if A is not None and C is not None:
        for j in range(3):
            for c in range(3):
                C[p, j, c] = columns[j][c]
