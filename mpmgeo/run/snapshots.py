"""Snapshots of a run: when they are written, and how many are kept."""

import re

from mpmgeo.run.watch import Watcher

FOLDER = "snapshots"


class Snapshots(Watcher):
    """Watches a run and writes its state every so many steps, and where the run stops.

    `histories` are completed before, so that they hold all that comes before the state.
    """

    def __init__(self, folder, plan, histories):
        self.folder = folder / FOLDER
        self.plan = plan
        self.histories = histories
        self._written = None

    def begin(self, simulation):
        """Remove the snapshots of an earlier run that are later than the state, and say so."""
        later = [path for step, path in self._files() if step > simulation.steps]
        for path in later:
            path.unlink()
        if later:
            simulation.say(
                f"{self.folder} held {len(later)} later snapshots of an earlier run, which were "
                f"removed: {later[-1].name}{' and others' if len(later) > 1 else ''}"
            )

    def after_step(self, simulation):
        """Write a snapshot if one is due, and remove the oldest."""
        if simulation.steps % self.plan.every == 0:
            self._write(simulation)

    def end(self, simulation, error):
        """Write the state in which the run stopped."""
        if error is None and self._written != simulation.steps:
            self._write(simulation)

    def _write(self, simulation):
        simulation.check()
        for history in self.histories:
            history.flush()
        simulation.save(self.folder / f"snapshot_{simulation.steps}.npz")
        self._written = simulation.steps
        for _, path in self._files()[: -self.plan.keep]:
            path.unlink()

    def _files(self):
        """Return (step, path) of all snapshots in the folder, the earliest first."""
        names = ((re.fullmatch(r"snapshot_(\d+)\.npz", p.name), p) for p in self.folder.glob("*"))
        return sorted((int(match[1]), path) for match, path in names if match)
