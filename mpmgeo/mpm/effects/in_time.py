"""Gravity and forces on particles that change in time.

A step from t to t + Δt takes the forces of time t, at which it evaluates the acceleration. So
velocities, half a step behind, are integrated by the rule of midpoints, to second order. Between
steps the solver holds the forces of its time.

The ledger of energy takes the work of forces on particles for F·x, half of it before and half of it
after a step. Where a force changes by ΔF between two steps, that is too much by

    ΔF · ½ (x + x′),

x and x′ the positions before and after the first of them.
"""

import numpy as np

from mpmgeo.effect import Effect
from mpmgeo.mpm.effects.ledger import DIVERGING


class Forces:
    """Sums of forces on particles, of which some change in time.

    `name`: the array of a set that holds the sum; `terms`: factor in time, None for a constant
    force, and force (n, 3) [N] of each, in row order.
    """

    def __init__(self, name, terms):
        self.name = name
        self.forget()
        changes = [force.any(axis=1) for course, force in terms if course is not None]
        self.rows = np.flatnonzero(np.any(changes, axis=0))
        self.place = np.full(len(terms[0][1]), -1)
        self.place[self.rows] = np.arange(len(self.rows))
        self.terms = [(course, force[self.rows]) for course, force in terms]

    def forget(self):
        """Forget where the particles stand, which may be elsewhere now."""
        self._at = None

    def _found(self, solver):
        """Return each set with where in it particles stand whose force changes, and which."""
        if self._at is None:
            places = [self.place[s.row] for s in solver.sets]
            self._at = [(at := np.flatnonzero(p >= 0), p[at]) for p in places]
        return zip(solver.sets, self._at, strict=True)

    def apply(self, solver, t):
        """Give the particles their forces at time t [s]."""
        total = sum(force if f is None else f.at(t) * force for f, force in self.terms)
        for s, (at, place) in self._found(solver):
            getattr(s, self.name)[at] = total[place]

    def works(self, solver):
        """Return force times position [J] of each term with a factor, as if that were one."""
        x = np.empty((len(self.rows), 3))
        for s, (at, place) in self._found(solver):
            x[place] = s.x[at]
        return [float((force * x).sum()) for course, force in self.terms if course is not None]

    @property
    def courses(self):
        """Return the factors in time."""
        return [course for course, _ in self.terms if course is not None]


class Weight:
    """Gravity (3,) [m/s²] with a factor in time."""

    def __init__(self, value, course):
        self.value, self.courses = value, [course]

    def forget(self):
        """It is the same for all particles."""

    def apply(self, solver, t):
        """Give the solver its gravity at time t [s]."""
        factor = self.courses[0].at(t)
        solver.gravity = tuple(factor * g for g in self.value)

    def works(self, solver):
        """Return force times position [J], as if the factor were one."""
        return [sum(float((s.m * (s.x * self.value).sum(axis=1)).sum()) for s in solver.sets)]


class LoadsInTime(Effect):
    """Changes forces between steps; after the ledger, which sees those of the step.

    `loads`: what changes, a `Weight` or `Forces`.
    """

    name = "loads in time"

    def __init__(self, loads):
        self.loads = loads
        self._works = None  # of all factors, before a step with a ledger

    def changes(self, name):
        """Tell whether it changes an array of the sets, `force` or `pull`."""
        return any(getattr(load, "name", None) == name for load in self.loads)

    def join(self, solver):
        """Begin with the forces of the start."""
        self.resumed(solver)

    def resumed(self, solver):
        """Take the forces of the solver's time, whatever they were."""
        self._factors = None
        self.after_sort(solver)
        self._change(solver)

    restarted = resumed

    def after_sort(self, solver):
        """The particles stand elsewhere."""
        for load in self.loads:
            load.forget()

    @DIVERGING
    def begin(self, solver, h):
        """Note what a ledger needs from before the step."""
        if solver.ledger is not None:
            self._works = self._now(solver)

    @DIVERGING
    def end(self, solver):
        """Take the forces of the next step; tell a ledger what it counts too much."""
        before = self._factors
        self._change(solver)
        if solver.ledger is not None:
            middle = 0.5 * (self._works + self._now(solver))
            solver.ledger.put_in(-float(((self._factors - before) * middle).sum()))

    def _change(self, solver):
        """Give the solver the forces of its time, where they are others."""
        t = solver.load_time
        factors = np.array([course.at(t) for load in self.loads for course in load.courses])
        if self._factors is None or (factors != self._factors).any():
            self._factors = factors
            for load in self.loads:
                load.apply(solver, t)

    def _now(self, solver):
        return np.array([work for load in self.loads for work in load.works(solver)])
