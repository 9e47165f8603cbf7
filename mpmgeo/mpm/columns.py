"""Columns of particles across the material, each with one particle that stands for all."""

import numpy as np

from mpmgeo.state.grid import Mesh

EXTENSIVE = ("m", "V", "force", "work")
"""Arrays of a set that hold for a whole column what each of its particles has a share of."""


def seen_in_plane(mesh, axis):
    """Return a mesh as kernels see it that know nothing of an axis, with one cell along it.

    All particles stand on its lower side. The nodes there have half of the cell, which is as wide
    as the material.
    """
    h, n = list(mesh[:3]), list(mesh[6:])
    h[axis], n[axis] = 2.0 * h[axis] * n[axis], 1
    return Mesh.of(h, n)


SHEAR = ([3, 5], [3, 4], [4, 5])
"""Components of stress that are zero in plane strain across x, y, z."""
ROUND_OFF = 1e-9
"""Share of the largest value of a field by which layers may differ and count as the same."""


class Columns:
    """Which particles stand in a row across the material; `axis`: along which.

    `first` (n,): the row of the particle that stands for each row; `layers`: how many each has.
    """

    def __init__(self, axis, first, layers):
        self.axis, self.first, self.layers = axis, first, layers
        self.order = np.argsort(first, kind="stable")
        self._begin = first[self.order]

    def rows_of(self, rows):
        """Return the rows of all particles for which those of `rows` stand, in order."""
        low = np.searchsorted(self._begin, rows)
        return np.sort(self.order[(low[:, None] + np.arange(self.layers)).ravel()])


def to_layer(s, columns):
    """Let particles of a set stand for their columns."""
    s.x[:, columns.axis] = s.v[:, columns.axis] = 0.0
    s.stress[:, SHEAR[columns.axis]] = 0.0
    for name in EXTENSIVE:
        if getattr(s, name) is not None:
            getattr(s, name)[...] *= columns.layers


def are_same(values, others):
    """Tell whether values are others but for round-off."""
    size = np.abs(values).max(initial=0.0)
    return bool((np.abs(values - others) <= ROUND_OFF * size).all())
