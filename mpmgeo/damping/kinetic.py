"""Kinetic damping: all particles stop whenever the kinetic energy has passed a peak (Cundall 1982).

Each stop takes what has become of the work of the forces; what is left swings less about a state of
rest.
"""

from dataclasses import dataclass
from typing import ClassVar

from mpmgeo.damping.damping import Damping
from mpmgeo.effect import Effect
from mpmgeo.state.checked import number_from, truth_from


@dataclass(frozen=True)
class KineticDamping(Damping):
    """All velocities set to zero whenever the kinetic energy has passed a peak (Cundall 1982)."""

    type: ClassVar[str] = "kinetic"

    def effect(self):
        """Return what stops the particles."""
        return Stops()

    def effect_as_mpm_geomechanics(self):
        """Return what stops the particles after files have shown them."""
        return StopsLater()


class Stops(Effect):
    """Stops all particles at peaks of the kinetic energy."""

    name = "kinetic damping"
    does_work = False

    def __init__(self):
        self.last = 0.0  # kinetic energy after the last step [J]

    def end(self, solver):
        """Compare the kinetic energy with that of the step before."""
        energy = solver.peak_energy = solver.kinetic_energy()
        if energy < self.last:
            solver.stop()
            energy = 0.0
        self.last = energy
        solver.clock.lap(self.name)

    def restarted(self, solver):
        """Compare with rest."""
        self.last = 0.0

    def held(self):
        """Return the energy to compare with."""
        return {"last_energy": self.last}

    def take(self, state):
        """Go on with what `held` once returned."""
        self.last = number_from(state, "last_energy")


class StopsLater(Stops):
    """Stops all particles as MPM-Geomechanics does, when the next step begins."""

    def __init__(self):
        super().__init__()
        self.due = False

    def begin(self, solver, h):
        """Stop the particles if the energy has passed a peak."""
        if self.due:
            solver.stop()
            self.due = False

    def end(self, solver):
        """Compare the kinetic energy with that of the step before."""
        energy = solver.peak_energy = solver.kinetic_energy()
        self.due = energy < self.last
        self.last = 0.0 if self.due else energy
        solver.clock.lap(self.name)

    def restarted(self, solver):
        """Compare with rest; nothing is to be stopped."""
        super().restarted(solver)
        self.due = False

    def held(self):
        """Return the energy to compare with, and whether the particles are to be stopped."""
        return super().held() | {"due": bool(self.due)}

    def take(self, state):
        """Go on with what `held` once returned."""
        super().take(state)
        self.due = truth_from(state, "due")
