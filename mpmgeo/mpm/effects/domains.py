"""Tells when particles whose size follows their material have grown beyond a cell."""

import numpy as np

from mpmgeo.effect import Effect
from mpmgeo.mpm.core.domain import MOST
from mpmgeo.positions import shown

LARGE = (1.05 * MOST) ** 2
"""Second moment [cells²] of a particle that is larger than a cell, by more than it may swing."""

EVERY = 50
"""Steps between two looks at all particles."""


class Domains(Effect):
    """Looks for a particle that is larger than a cell, and tells of the first one once."""

    name = "domains"
    does_work = False

    def join(self, solver):
        """Nothing has been seen yet."""
        self.first = None

    def end(self, solver):
        """Look for the particle of the lowest row among those that are too large."""
        if self.first is None and solver.steps % EVERY == 0:
            large = [
                (int(s.row[p]), s.x[p].copy(), solver.time)
                for s in solver.sets
                for p in np.flatnonzero((s.domain[: s.active, :3] > LARGE).any(axis=1))
            ]
            self.first = min(large, key=lambda entry: entry[0], default=None)

    def news(self, solver):
        """Yield which particle is larger than a cell, if there is one."""
        if self.first is not None:
            yield "domains", lambda: [self._message(solver.population.zero)]

    def _message(self, zero):
        row, x, time = self.first
        return (
            f"particles are stretched to more than a cell, the first is particle {row}, at "
            f"{shown(x, zero, digits=4)} after {time:.6g} s: they interpolate as if they were one "
            "cell large, and bodies may tear where gaps open between them"
        )
