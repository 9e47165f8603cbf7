"""Energy that appears in a run and that nobody put in: told once, with the likely cause."""

from math import inf

import numpy as np

from mpmgeo.run.diagnosis import too_long
from mpmgeo.run.watch import Watcher, is_due

SHARE = 0.5
"""Share of the energy within the bodies that has to have appeared.

Kinetic and elastic energy are of times half a step apart, so that their sum swings by ω Δt/2 of
itself: by less than a tenth for all that ten cells or more resolve.
"""

OF_TURNOVER = 0.05
"""Share of what was dissipated or put in at nodes that has to have appeared."""

ROUND_OFF = 1e-9
"""The same of the size of the energies that are summed."""

LASTING = 50
"""Steps over which all checks have to agree.

In the first steps of an impact the elastic energy, half a step ahead, is there before the kinetic
energy has fallen for it: too much by a share of about one over the number of these steps.
"""

SMALL = 0.1
"""Share of the critical time step with which a vibration in flight hardly grows."""

FLIGHT = 0.02
"""Share of the wave speed above which flight through the cells is the likely cause."""


class Surplus(Watcher):
    """Compares the energy with the least one so far, when the guard checks.

    `outputs`: when they are, see `run.outputs`.
    """

    def __init__(self, outputs):
        self.outputs = outputs
        self.least, self._since, self._changed = inf, None, None

    def begin(self, simulation):
        """Begin with the energy that there is."""
        self._look(simulation)

    def after_step(self, simulation):
        """Look at the energy if a check is due, and tell of it."""
        if is_due(simulation, self.outputs):
            appeared, within = self._look(simulation)
            if self._since is not None and simulation.steps - self._since >= LASTING:
                simulation.tell("energy", lambda: [message(simulation, appeared, within)])

    def _look(self, simulation):
        """Return what has appeared and what is within the bodies [J]; note when it is much."""
        now = simulation.solver.energies()
        if now is None:
            return 0.0, 0.0
        if simulation.changed != self._changed:  # what was before does not count
            self._changed, self.least = simulation.changed, inf
        self.least = min(self.least, now.total)
        appeared = now.total - self.least
        enough = SHARE * now.within + OF_TURNOVER * now.turnover + ROUND_OFF * now.size
        if not appeared > enough:
            self._since = None
        elif self._since is None:
            self._since = simulation.steps
        return appeared, now.within


def message(simulation, appeared, within):
    """Return what to tell, with the likely cause."""
    return (
        f"after {simulation.time:.6g} s there are {appeared:.3g} J more than were put in; the "
        f"bodies hold {within:.3g} J, in strain and in motion against their centres of mass; "
        f"{_cause(simulation)}"
    )


def _cause(simulation):
    case, dt, stable = simulation.case, simulation.time_step, simulation.stable_time_step
    if 0 < stable < dt:
        return too_long(simulation)
    if case.stress_scheme_update == "USL" and case.shape_function == "linear":
        return "likely cause: linear with USL, where nodes of little mass strain too much; try MUSL"
    speed = np.linalg.norm(simulation.field("velocity"), axis=1).max(initial=0.0)
    wave = min(law.sound_speed() for law in case.materials)
    if case.stress_scheme_update != "USL" and speed > FLIGHT * wave:
        return (
            f"likely cause: {case.stress_scheme_update}, which lets a body that flies through the "
            f"cells vibrate more and more (its speed is {speed:.3g} m/s); try a time step of "
            f'{SMALL * simulation.critical_time_step:.2g} s, or "transfer": "tpic" as in "method": '
            '"recommended", with which bodies in flight gain nothing'
        )
    return f"likely causes: the time step of {dt:.4g} s, or a law whose flow creates energy"
