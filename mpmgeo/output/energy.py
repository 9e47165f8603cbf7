"""The kinetic energy over time as a csv file."""

from pathlib import Path


class EnergySeries:
    """A csv file with the columns time [s] and kinetic energy [J], begun anew when created.

    Every row is in the file as soon as it is added. Raises OSError if it cannot be written.
    """

    def __init__(self, path: Path | str):
        self.path = Path(path)
        self.path.parent.mkdir(parents=True, exist_ok=True)
        self.path.write_text("time,energy\n", encoding="ascii")

    def add(self, time: float, energy: float) -> None:
        """Append the kinetic energy [J] at a time [s], both with all their digits."""
        with self.path.open("a", encoding="ascii") as file:
            file.write(f"{float(time)!r},{float(energy)!r}\n")
