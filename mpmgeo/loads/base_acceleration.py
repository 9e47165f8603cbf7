"""The motion of the base."""

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from mpmgeo.loads.record import Record, read_record
from mpmgeo.parameters import parameter


@dataclass(frozen=True)
class BaseAcceleration:
    """Acceleration of the base, read from a text file of time and three components."""

    active: bool = parameter("Whether the base moves", default=False)
    file: Path | None = parameter(
        "Text file with the columns time [s] and acceleration x, y, z [m/s²]",
        file=True,
        default=None,
    )
    header: bool = parameter("Whether the first line of the file is a heading", default=True)

    def problems(self) -> Iterator[tuple[str, str]]:
        """Yield (key, message) if the base moves without a record."""
        if self.active and self.file is None:
            yield "file", "is required when active is true"

    def record(self) -> Record:
        """Read the file; raises ValueError as `read_record` does."""
        return read_record(self.file, self.header)
