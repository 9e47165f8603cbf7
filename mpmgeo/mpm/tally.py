"""Sums over all particles for a balance of energy, for each body by itself."""

from typing import NamedTuple

import numpy as np

from mpmgeo.materials.hyperelastic import energy_of
from mpmgeo.materials.law import strain_energy
from mpmgeo.numerics.chunks import blockwise
from mpmgeo.numerics.jit import inlined
from mpmgeo.numerics.matrices import row_of
from mpmgeo.state.grid import cut


class Tally(NamedTuple):
    """Sums for each body (bodies + 1,); `power` is that of the constant forces on particles [W].

    `potential`: work of these forces, and of given pore pressures, from the zero of coordinates and
    volumes [J].
    """

    mass: np.ndarray  # [kg]
    momentum: np.ndarray  # (bodies + 1, 3) [kg m/s]
    kinetic: np.ndarray  # [J]
    strain: np.ndarray  # elastic energy [J]
    potential: np.ndarray
    power: np.ndarray

    @property
    def within(self) -> float:
        """Return the energy [J] of the bodies apart from the motion of their centres of mass."""
        of_centre = (self.momentum**2).sum(axis=1) / (2 * np.where(self.mass > 0, self.mass, 1.0))
        return float((self.strain + np.maximum(self.kinetic - of_centre, 0.0)).sum())


@inlined
def _force(force, gravity, m, p):
    """Return the constant force on particle p."""
    x, y, z = m * gravity[0], m * gravity[1], m * gravity[2]
    if force is not None:
        x, y, z = x + force[p, 0], y + force[p, 1], z + force[p, 2]
    return x, y, z


@inlined
def _pressed(pressure, V, p):
    return 0.0 if pressure is None else pressure[p] * V[p]


@inlined
def _elastic(law, stress, F, p):
    """Return the elastic energy of particle p in a unit of volume."""
    if F is not None:
        return energy_of(law, row_of(F, p))
    σ = stress[p, 0], stress[p, 1], stress[p, 2], stress[p, 3], stress[p, 4], stress[p, 5]
    return strain_energy(law, σ)


@blockwise
def _tally(c, chunk, start, law, gravity, body, a, out):
    row, x, v, m, V, stress, F, force, pressure = a
    for p in range(start[chunk[c]], start[chunk[c + 1]]):
        o = body[row[p]]
        u, w, q = v[p, 0], v[p, 1], v[p, 2]
        fx, fy, fz = _force(force, gravity, m[p], p)
        out[c, o, 0] += m[p]
        out[c, o, 1] += m[p] * u
        out[c, o, 2] += m[p] * w
        out[c, o, 3] += m[p] * q
        out[c, o, 4] += 0.5 * m[p] * (u * u + w * w + q * q)
        out[c, o, 5] += V[p] * _elastic(law, stress, F, p)
        out[c, o, 6] += fx * x[p, 0] + fy * x[p, 1] + fz * x[p, 2] + _pressed(pressure, V, p)
        out[c, o, 7] += fx * u + fy * w + fz * q


def tally(sets, gravity, body, crew, left=False) -> Tally:
    """Return the sums over the active particles of `sets`, or over those that `left` the mesh.

    `body` (n,): number of each row's body. The bits do not depend on threads.
    """
    total = np.zeros((int(body.max(initial=0)) + 1, 8))
    for s in sets:
        start = np.array([s.active, len(s.row)]) if left else s.start
        if start[0] == start[-1]:
            continue
        out = np.zeros((len(s.chunk) - 1, *total.shape))
        chunk = cut(start) if left else s.chunk
        arrays = (s.row, s.x, s.v, s.m, s.V, s.stress, s.F, s.force, s.pressure)
        _tally(crew, chunk, start, s.law, gravity, body, arrays, out)
        total += out.sum(axis=0)
    return Tally(total[:, 0], total[:, 1:4], *total[:, 4:].T)


def sag(sets, gravity, step):
    """Return by how much [J] the work of constant forces is too large at the mean of two positions.

    A path of the acceleration f/m sags by f/m h²/8 in a `step` h [s]; matters where steps change.
    """
    squares = 0.0
    for s in sets:
        f = s.m[: s.active, None] * np.array(gravity)
        f = f if s.force is None else f + s.force[: s.active]
        squares += float(((f * f).sum(axis=1) / s.m[: s.active]).sum())
    return 0.125 * step**2 * squares
