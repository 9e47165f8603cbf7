"""A body force that a script gives as a function of time and of where particles began.

As with loads in time, a step from t to t + Δt takes the forces of time t, in Newmark's method those
of t + Δt. The ledger, which counts F·x before and after a step, counts too much where they change
by ΔF: ΔF · ½ (x + x′).
"""

import numpy as np

from mpmgeo.effect import Effect
from mpmgeo.mpm.effects.ledger import DIVERGING


class BodyForce(Effect):
    """Adds m b to the forces on particles, `acceleration(t, X)` being b (n, 3) [m/s²].

    X (n, 3) [m]: where the particles began, in the user's coordinates and in row order. After the
    ledger, which sees the forces of the step. Raises ValueError for values of another shape or that
    are not finite, and beside loads on particles that change in time.
    """

    name = "body force"

    def __init__(self, acceleration):
        self.acceleration = acceleration
        self._x = None  # positions before a step with a ledger

    def join(self, solver):
        """Begin with the forces of the start, beside those that do not change."""
        in_time = solver.effect("loads in time")
        if in_time is not None and in_time.changes("force"):
            raise ValueError(
                "body_force does not go with loads on particles that change in time; "
                "let body_force say these"
            )
        population = solver.population
        self.constant = 0.0 if population.force is None else population.force
        for s in solver.sets:
            s.force = np.zeros((len(s.row), 3)) if s.force is None else s.force
        self._mass = self._in_rows(solver, "m")
        self.resumed(solver)

    def resumed(self, solver):
        """Take the forces of the solver's time, of where particles began or were restarted."""
        self.X = solver.population.position + solver.population.zero
        self._force = self._at(solver.load_time)
        self._give(solver)

    restarted = resumed

    @DIVERGING
    def begin(self, solver, h):
        """Note what a ledger needs from before the step."""
        if solver.ledger is not None:
            self._x = self._in_rows(solver, "x", 3)

    @DIVERGING
    def end(self, solver):
        """Take the forces of the next step; tell a ledger what it counts too much."""
        before, self._force = self._force, self._at(solver.load_time)
        if solver.ledger is not None:
            middle = 0.5 * (self._x + self._in_rows(solver, "x", 3))
            solver.ledger.put_in(-float(((self._force - before) * middle).sum()))
        self._give(solver)
        solver.clock.lap(self.name)

    def _at(self, t):
        """Return the force (n, 3) [N] on all particles at time t [s]."""
        b = np.asarray(self.acceleration(t, self.X.copy()), float)
        if b.shape != self.X.shape:
            raise ValueError(f"body_force returns the shape {b.shape}; accepted: {self.X.shape}")
        if not np.isfinite(b).all():
            row = int(np.argmin(np.isfinite(b).all(axis=1)))
            raise ValueError(f"body_force returns {b[row]} m/s² in row {row} at {t:g} s")
        return self._mass[:, None] * b + self.constant

    def _give(self, solver):
        for s in solver.sets:
            s.force[:] = self._force[s.row]

    def _in_rows(self, solver, name, *width):
        """Return an array (n, *width) of all sets in row order."""
        out = np.empty((solver.count, *width))
        for s in solver.sets:
            out[s.row] = getattr(s, name)
        return out
