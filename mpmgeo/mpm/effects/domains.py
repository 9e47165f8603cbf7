"""Particles whose size in interpolation follows their material, from step to step.

Weights are those of the start of the step throughout, so that the momentum that a particle puts
into the nodes comes back to it: sizes change between steps.

What is compressed along an axis shrinks to a part of its first size and no further. Small domains
make steps short, and those that overlap do no harm.
"""

import numpy as np

from mpmgeo.effect import Effect
from mpmgeo.mpm.core.domain import LARGE, resize
from mpmgeo.positions import shown

FLOOR = 0.5
"""Part of the smallest size of a material's particles below which none of them shrinks."""


class Domains(Effect):
    """Makes half-sizes of the second moments of domains; after the effects that need the old ones.

    Particles that grow beyond a cell are told of once.
    """

    name = "domains"
    does_work = False

    def join(self, solver):
        """Note how small particles may become."""
        self.least = [tuple((FLOOR * s.half.min(axis=0)).tolist()) for s in solver.sets]
        self.large = False

    def end(self, solver):
        """Give the particles their new sizes."""
        large = 0
        for s, least in zip(solver.sets, self.least, strict=True):
            large += resize(solver.crew, s.chunk, s.start, s.domain, least, s.half)
        self.large = large > 0
        solver.clock.lap("domains")

    def news(self, solver):
        """Yield which particle is larger than a cell, if there is one."""
        if self.large:
            yield "domains", lambda: self._first(solver)

    def _first(self, solver):
        """Return what to tell of the first such particle, a list of messages."""
        found = []
        for s in solver.sets:
            large = np.flatnonzero(s.domain[: s.active, :3].max(axis=1) > LARGE)
            if len(large):
                p = large[s.row[large].argmin()]
                found.append((int(s.row[p]), s.x[p]))
        row, x = min(found, key=lambda entry: entry[0])
        where = shown(x, solver.population.zero, digits=4)
        return [
            f"particles are stretched to more than a cell, the first is particle {row}, at {where} "
            f"after {solver.time:.6g} s: they interpolate as if they were one cell large, and "
            "bodies may tear where gaps open between them"
        ]
