"""Weights and slopes of two axes applied to the records of a particle's nodes in a plane.

`A`, `B`: how far a record lies from the next one along each axis; wa, wb: their stencils.
"""

from mpmgeo.numerics.jit import inlined
from mpmgeo.numerics.simd import axpy, load, pack4, quarter, scale, splat, store


@inlined
def deposit(tiles, n0, A, B, wa, wb, C0, Ca, Cb):
    """Add S C0 + ∂S/∂a Ca + ∂S/∂b Cb to the nodes whose records begin at n0."""
    I, J = len(wa) // 2, len(wb) // 2
    for i in range(I):
        X, Y = axpy(wa[I + i], Ca, scale(wa[i], C0)), scale(wa[i], Cb)
        for j in range(J):
            at = n0 + i * A + j * B
            store(tiles, at, axpy(wb[J + j], Y, axpy(wb[j], X, load(tiles, at))))


@inlined
def collect(tile, n0, A, B, wa, wb):
    """Return Σ S r, and Σ ∂S/∂a r, Σ ∂S/∂b r of four lanes of the records r."""
    I, J = len(wa) // 2, len(wb) // 2
    value = splat(0.0)
    sa = sb = pack4(0.0, 0.0, 0.0, 0.0)
    for i in range(I):
        n = n0 + i * A
        record = load(tile, n)
        r, q = scale(wb[0], record), scale(wb[J], quarter(record, 0))
        for j in range(1, J):
            record = load(tile, n + j * B)
            r, q = axpy(wb[j], record, r), axpy(wb[J + j], quarter(record, 0), q)
        value, sa, sb = (
            axpy(wa[i], r, value),
            axpy(wa[I + i], quarter(r, 0), sa),
            axpy(wa[i], q, sb),
        )
    return value, sa, sb
