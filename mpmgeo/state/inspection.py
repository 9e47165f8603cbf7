"""Look over all particles: kinetic energy, the first that is no longer a sound state."""

import numpy as np

from mpmgeo.numerics.chunks import blockwise


@blockwise
def _energy(c, chunk, start, m, v, out):
    for b in range(chunk[c], chunk[c + 1]):
        total = 0.0
        for p in range(start[b], start[b + 1]):
            total += m[p] * (v[p, 0] * v[p, 0] + v[p, 1] * v[p, 1] + v[p, 2] * v[p, 2])
        out[b] = 0.5 * total


@blockwise
def _unsound(c, chunk, start, x, v, stress, limit, out):
    out[c] = -1
    for p in range(start[chunk[c]], start[chunk[c + 1]]):
        # a sum of anything with NaN or infinity is not below a bound
        v2 = v[p, 0] * v[p, 0] + v[p, 1] * v[p, 1] + v[p, 2] * v[p, 2]
        size = abs(x[p, 0]) + abs(x[p, 1]) + abs(x[p, 2])
        for a in range(6):
            size += abs(stress[p, a])
        if not (v2 <= limit * limit and size < np.inf):
            out[c] = p
            break


def kinetic_energy(s, crew):
    """Return ½ Σ m v² [J] of a set's active particles; its bits do not depend on threads.

    With a pore fluid, that of both phases.
    """
    out = np.empty(len(s.start) - 1)
    _energy(crew, s.chunk, s.start, s.m, s.v, out)
    energy = float(out.sum())
    if s.fluid is not None:
        _energy(crew, s.chunk, s.start, s.mf, s.vf, out)
        energy += float(out.sum())
    return energy


def first_unsound(s, limit, crew):
    """Return the index of the first particle with NaN, infinity or a speed above `limit`, or −1."""
    out = np.empty(len(s.chunk) - 1, np.int64)
    for v in (s.v, s.vf) if s.fluid is not None else (s.v,):
        _unsound(crew, s.chunk, s.start, s.x, v, s.stress, limit, out)
        found = out[out >= 0]
        if len(found):
            return int(found[0])
    return -1
