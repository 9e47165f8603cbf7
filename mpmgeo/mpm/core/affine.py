"""Affine velocities of particles: brought to the nodes, and made of those of the nodes.

A particle with the velocity gradient C brings m S (v + C (x_n − x_p)) to a node. Mass, momentum and
force stay one record, for the term in C is deposited like a force, with the moments S (x_n − x_p)
of the weights in the place of their slopes: in the lanes of the momentum moments, in those of the
force slopes.
"""

from numba.extending import overload

from mpmgeo.mpm.core.stencils import find, is_across, of_axis
from mpmgeo.mpm.core.tile import collect, deposit
from mpmgeo.numerics.halves import paired
from mpmgeo.numerics.jit import INLINED, inlined
from mpmgeo.numerics.simd import load_row, scale, store_row, with_velocity
from mpmgeo.transfers.transfer import gradient_stencil, with_moments


@inlined
def deposit_affine(here, m, C, C0, C1, C2, C3, p):
    """Add S C0, m S C (x_n − x_p), and slopes times C1 … C3 to the tiles.

    C (n, 3, 3) has the derivatives along x, y, z of particle p in three rows.
    """
    n, w = find(here, p)
    q, mesh = with_moments(w), here.mesh
    C1 = with_velocity(C1, scale(m[p] * mesh.hx, load_row(C, 3 * p)))
    C2 = with_velocity(C2, scale(m[p] * mesh.hy, load_row(C, 3 * p + 1)))
    C3 = with_velocity(C3, scale(m[p] * mesh.hz, load_row(C, 3 * p + 2)))
    shape = here.shape
    wx = _halves(of_axis(shape, q, 0), of_axis(shape, w, 0))
    wy = _halves(of_axis(shape, q, 1), of_axis(shape, w, 1))
    wz = _halves(of_axis(shape, q, 2), of_axis(shape, w, 2))
    deposit(here.tiles[0], here.n0 + n, here.rows, wx, wy, wz, C0, C1, C2, C3)


def _halves(moments, slopes):
    """Return factors for momentum and force along an axis, None where nothing changes."""


@overload(_halves, jit_options=INLINED)
def _compiled_halves(moments, slopes):
    if is_across(slopes):
        return lambda moments, slopes: None
    return lambda moments, slopes: paired(moments, slopes)


@inlined
def keep_gradient(transfer, here, C, n, w, sx, sy, sz, p):
    """Let particle p keep the gradient that a transfer makes of the nodes' velocities, if it does.

    n: where its records begin, w: its stencil, sx, sy, sz: slopes per cell of the node records.
    """
    if C is not None:
        x, y, z = _fitted(here, n, gradient_stencil(transfer, w), sx, sy, sz)
        mesh = here.mesh
        store_row(C, 3 * p, scale(mesh.ix, x))
        store_row(C, 3 * p + 1, scale(mesh.iy, y))
        store_row(C, 3 * p + 2, scale(mesh.iz, z))


@inlined
def _fitted(here, n, w, sx, sy, sz):
    if w is None:
        return sx, sy, sz
    shape = here.shape
    wx, wy, wz = of_axis(shape, w, 0), of_axis(shape, w, 1), of_axis(shape, w, 2)
    _, x, y, z = collect(here.source, n, here.rows, wx, wy, wz)
    return x, y, z
