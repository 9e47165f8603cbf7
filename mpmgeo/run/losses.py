"""Particles that a run has lost."""

import numpy as np

from mpmgeo.run.watch import Watcher


class Losses(Watcher):
    """Watches a run and tells at its end how many particles have left the mesh."""

    def end(self, simulation, error):
        """Say how many have left since the case began, when the last, and with what mass."""
        departures = simulation.solver.departures
        rows = np.concatenate([d.rows for d in departures]) if departures else ()
        if len(rows):
            mass = simulation.field("mass")
            simulation.say(
                f"{len(rows)} particles left the mesh, the last of them after "
                f"{departures[-1].time:.6g} s: {mass[rows].sum():.4g} kg of {mass.sum():.4g} kg"
            )
