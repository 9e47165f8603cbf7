"""Files of other runs in the folder of a run."""

from pathlib import Path

from mpmgeo.state.stress_file import NAME as STRESS_FILE

TERRAIN, SNAPSHOTS, ENERGY = "centroid_points_stl_contact", "snapshots", "energy.csv"
PLACES = (
    (SNAPSHOTS, "snapshot_*.npz"),
    ("probes", "*.csv"),
    ("reactions", "*.csv"),
    (TERRAIN, "*.vtu"),
    (".", STRESS_FILE),
    (".", ENERGY),
)
"""Folder and names of files that a run writes only if its case asks for them."""


class Leftovers:
    """Watches a run and says which files of others stay in its `folder`.

    `histories`: those that the run writes.
    """

    def __init__(self, folder: Path, histories):
        self.folder, self.histories = folder, histories

    def begin(self, simulation):
        """Say what is there that this run will not replace, unless it goes on."""
        if simulation.goes_on:
            return
        own = self._own(simulation)
        for place, pattern in PLACES:
            folder = self.folder / place
            found = sorted(path for path in folder.glob(pattern) if path not in own)
            if found and folder not in own:
                simulation.say(
                    f"{folder} holds {len(found)} of the files of an earlier run, which stay: "
                    f"{found[0].name}{' and others' if len(found) > 1 else ''}"
                )

    def _own(self, simulation):
        """Return files that the run writes, and folders in which it looks after all files."""
        case = simulation.case
        asked = (
            (case.save_state, STRESS_FILE),
            (case.snapshot is not None, SNAPSHOTS),
            (simulation.solver.ground is not None, TERRAIN),
        )
        own = {history.path for history in self.histories}
        return own | {self.folder / name for is_asked, name in asked if is_asked}
