"""Files of other runs in the folder of a run."""

from pathlib import Path

from mpmgeo.state.stress_file import NAME as STRESS_FILE

TERRAIN, SNAPSHOTS = "centroid_points_stl_contact", "snapshots"
PLACES = (
    (SNAPSHOTS, "snapshot_*.npz"),
    ("probes", "*.csv"),
    ("reactions", "*.csv"),
    (TERRAIN, "*.vtu"),
    (".", STRESS_FILE),
)
"""Folder and names of files that a run writes only if its case asks for them."""


class Leftovers:
    """Watches a run and says which files of others stay in its `folder`.

    `written`: files that this run writes itself, or folders in which it looks after all files.
    """

    def __init__(self, folder: Path, written: list[Path]):
        self.folder, self.written = folder, set(written)

    def begin(self, simulation):
        """Say what is there that this run will not replace, unless it goes on."""
        for place, pattern in () if simulation.goes_on else PLACES:
            folder = self.folder / place
            found = sorted(path for path in folder.glob(pattern) if path not in self.written)
            if found and folder not in self.written:
                simulation.say(
                    f"{folder} holds {len(found)} of the files of an earlier run, which stay: "
                    f"{found[0].name}{' and others' if len(found) > 1 else ''}"
                )

    def after_step(self, simulation):
        """Do nothing."""

    def end(self, simulation, error):
        """Do nothing."""
