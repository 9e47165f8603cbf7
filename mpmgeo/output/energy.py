"""The kinetic energy over time as a csv file."""

from pathlib import Path

from mpmgeo.output.earlier import earlier
from mpmgeo.output.whole_file import append, whole_file

HEADER = "time,energy\n"


class EnergySeries:
    """A csv file with the columns time [s] and kinetic energy [J], begun anew when created.

    `rows`: lines with which it begins. Every row is in the file as soon as it is added. Raises
    OSError if it cannot be written.
    """

    def __init__(self, path: Path | str, rows: list[str] = ()):
        self.path = Path(path)
        with whole_file(self.path) as file:
            file.write("".join([HEADER, *rows]).encode())

    def add(self, time: float, energy: float) -> None:
        """Append the kinetic energy [J] at a time [s], both with all their digits."""
        append(self.path, f"{float(time)!r},{float(energy)!r}\n")


def earlier_rows(path: Path | str, time: float, is_due: bool) -> list[str]:
    """Return the lines of an earlier part of the run up to `time` [s], none if there is no file.

    `is_due`: whether there is a row for that time.
    """
    try:
        header, *lines = Path(path).read_text(encoding="ascii").splitlines(keepends=True)
        rows = [(float(line.split(",")[0]), line) for line in lines if line.endswith("\n")]
    except (OSError, ValueError):
        return []
    return [line for _, line in earlier(rows, time, is_due)] if header == HEADER else []
