"""That a particle is open by no more than the space around it is empty.

A law that has `opening` among its variables keeps the strain θ by which tension has opened the
material (`materials/opening.py`). V is the volume without openings, that with them is V e^θ. The
velocities of nodes that few particles reach tell less of the space between particles than of their
own noise, and what has opened in them would close by squeezing the particles together. So the mass
around a particle of grains bounds what is open:

    θ ≤ max(0, 2 (q − φ)/(q + φ)) ≈ ln q/φ,    φ = (V/m) Σ S mᵢ/Σ S Vᵢ

φ is the share of that space that is filled, with neighbours as dense as the particle; Vᵢ is the
volume of a node, half a cell and less at the sides of the mesh. A share q is full, for φ swings by
some hundredths where particles have left their lattice. A fluid needs no bound: what opens in it is
little, and closes. Source: ours.
"""

from numba.extending import overload

from mpmgeo.numerics.jit import INLINED, inlined
from mpmgeo.state.particles import column_of_opening

FULL = 1.03


@inlined
def confine(law, mesh, x, mass, m, V, state, p):
    """Let particle p be open by no more than the space around it is empty.

    `mass`: Σ S mᵢ [kg], `m`: the masses of the particles, None for a law without bound.
    """
    if m is not None:
        column = column_of_opening(law)
        if state[p, column] > 0.0:
            φ = mass * V[p] / (m[p] * space(mesh, x, p))
            most = 2.0 * (FULL - φ) / (FULL + φ)
            state[p, column] = min(state[p, column], max(most, 0.0))


@overload(column_of_opening, jit_options=INLINED)
def _compiled_column(law):
    column = column_of_opening(law.instance_class)
    return lambda law: column


@inlined
def space(mesh, x, p):
    """Return Σ S Vᵢ [m³], the volume of the nodes around particle p, with linear weights."""
    X = _inside(x[p, 0] * mesh.ix, mesh.nx)
    Y = _inside(x[p, 1] * mesh.iy, mesh.ny)
    Z = _inside(x[p, 2] * mesh.iz, mesh.nz)
    return mesh.hx * mesh.hy * mesh.hz * X * Y * Z


@inlined
def _inside(g, n):
    """Return which share of the two nodes at g, in an axis of n cells, lies in the mesh."""
    return 1.0 - 0.5 * (max(1.0 - g, 0.0) + max(g - n + 1.0, 0.0))
