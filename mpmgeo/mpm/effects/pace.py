"""Steps that follow from the speeds of waves and particles as they are now.

    Δt = min(s Δt_c, m Δt_s),    with c √r for c and v + Δv for v

Δt_c, Δt_s: critical and stable step (`case/building/time_step.py`), s: the share that the case
wants, m: a margin; r: by how much a material is stiffer than at the start at a particle, Δv: what
the largest speed grew by since the look before, and may grow until the next one. After a look the
step grows by a tenth at most, shrinks at once, and lands on the instants of outputs.
"""

from math import ceil
from typing import NamedTuple

import numpy as np

from mpmgeo.effect import Effect
from mpmgeo.mpm.effects.ledger import DIVERGING
from mpmgeo.positions import shown
from mpmgeo.state.checked import demand, number_from

EVERY = 5
"""Steps between two looks; the first of these steps are all looked at."""

GROWTH = 1.1
"""Factor by which the step grows after a look, at most."""

NOTICE = 0.8
"""Share of the first step below which the user is told why it shrinks."""

LEAST = 1e-3
"""Share of the first step below which it does not shrink: a run that diverges has to be noticed."""

ROUND_OFF = 1e-6  # of a step


class Haste(NamedTuple):
    """What limits the step: the largest speed [m/s], and r of each set of particles."""

    speed: float
    stiffening: tuple

    def limit(self, limits):
        """Return the longest step [s] and the number of the set that needs it."""
        steps = [f(self.speed, r) for f, r in zip(limits, self.stiffening, strict=True)]
        number = int(np.argmin(steps)) if steps else -1
        return (steps[number], number) if steps else (np.inf, number)


class Pace(Effect):
    """Chooses the next step after each one; before all effects that ask for it.

    `bind(solver)` returns two functions for each set of particles: of speed and r the longest step
    [s], and of the set r. `instants`: on which steps land, `Instants`.
    """

    name = "time step"
    does_work = False

    def __init__(self, bind, instants):
        self.bind, self.instants = bind, instants

    def join(self, solver):
        """Choose the first step."""
        self.solver = solver
        bound = self.bind(solver)
        self.limits, self.stiffenings = [f for f, _ in bound], [g for _, g in bound]
        self.start = now = self._now(solver)
        self.speed, self.tells = now.speed, None
        self.wish = self.first = min(now.limit(self.limits)[0], self.instants.end)
        solver.time_step = self._landing(0.0)

    @DIVERGING
    def end(self, solver):
        """Choose the next step."""
        near = self.instants.nearest(solver.time)
        if abs(solver.time - near) <= ROUND_OFF * solver.time_step:
            solver.time = near
        if solver.steps % EVERY == 0 or solver.steps < EVERY:
            self._look(solver)
        solver.time_step = self._landing(solver.time)

    def _landing(self, t):
        """Return the step from t on [s]: the one that is wished, or less to land on an instant."""
        left = self.instants.after(t) - t
        steps = ceil(left / self.wish - ROUND_OFF)
        return self.wish if steps > 2 else left / max(steps, 1)

    def _look(self, solver):
        now = self._now(solver)
        steps = 1 if solver.steps <= EVERY else EVERY  # since the look before
        growth = max(now.speed - self.speed, 0.0) * EVERY / steps
        ahead = now._replace(speed=now.speed + growth)
        step, number = ahead.limit(self.limits)
        self.speed = now.speed
        if step > 0:  # not NaN, of which the guard tells
            longest = min(GROWTH * self.wish, self.instants.end)
            self.wish = max(min(step, longest), LEAST * self.first)
        if self.wish < NOTICE * self.first:
            self.tells = self._cause(now, number)
        solver.clock.lap(self.name)

    def _now(self, solver):
        speeds = [_square(s) for s in solver.sets]
        r = tuple(g(s) for g, s in zip(self.stiffenings, solver.sets, strict=True))
        return Haste(max(speeds, default=0.0) ** 0.5, r)

    def _cause(self, now, number):
        """Return the topic of why the step shrinks, and the set of particles in question."""
        slow = now._replace(speed=self.start.speed).limit(self.limits)[0]
        soft = now._replace(stiffening=self.start.stiffening).limit(self.limits)[0]
        return ("fast", None) if slow > soft else ("stiff", number)

    def news(self, solver):
        """Tell why the step shrinks, once for each reason."""
        if self.tells is not None:
            topic, number = self.tells
            yield f"time step: {topic}", lambda: [self._message(solver, number)]
            self.tells = None

    def _message(self, solver, number):
        population = solver.population
        if number is None:
            s = max(solver.sets, key=_square)
            v = s.v[: s.active]
            p = int(np.argmax(np.einsum("ij,ij->i", v, v)))
            why = f"has a speed of {float(np.sqrt(v[p] @ v[p])):.3g} m/s"
        else:
            s, p = solver.sets[number], 0  # any of them shows body and material
            r = self.stiffenings[number](s)
            why = f"is of a material that has become stiffer, its waves {r**0.5:.3g} times as fast"
        row, at = int(s.row[p]), shown(s.x[p] + population.zero, digits=4)
        body, material = int(population.body[row]), int(population.material[row])
        return (
            f"after {solver.time:.6g} s the time step is {self.wish:.3g} s, {self.first:.3g} s at "
            f"the start: particle {row} of body {body}, material {material}, at {at} {why}"
        )

    def restarted(self, solver):
        """Choose the first step anew."""
        solver.time_step = self._landing(0.0)

    def held(self):
        """Return the next and the last step, the wish for them, and the largest speed."""
        steps = {"next": float(self.solver.time_step), "last": float(self.solver.previous)}
        return steps | {"wish": float(self.wish), "speed": float(self.speed)}

    def take(self, state):
        """Go on with what `held` once returned."""
        self._taken = [number_from(state, name, least=0.0) for name in ("next", "last")]
        self.wish, self.speed = (number_from(state, name, least=0.0) for name in ("wish", "speed"))
        demand(min(self._taken[0], self.wish) > 0, "next or wish is no step")

    def resumed(self, solver):
        """Give the solver its steps."""
        solver.time_step, solver.previous = self._taken


def _square(s):
    """Return the square of the largest speed [m²/s²] of a set of particles."""
    v = s.v[: s.active]
    return float(np.einsum("ij,ij->i", v, v).max(initial=0.0))
