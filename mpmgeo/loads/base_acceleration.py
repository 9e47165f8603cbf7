"""The motion of the base."""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from math import inf
from pathlib import Path
from typing import ClassVar

from mpmgeo.action import Action
from mpmgeo.loads.record import Record, read_record
from mpmgeo.parameters import parameter


@dataclass(frozen=True)
class BaseAcceleration(Action):
    """Acceleration of the base, read from a text file of time and three components."""

    key: ClassVar[str] = "earthquake"
    about: ClassVar[str] = (
        "Motion of the base: of the terrain if there is one, else of the lowest plane"
    )
    is_several: ClassVar[bool] = False
    switch: ClassVar[str | None] = "active"

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
        return self._record

    @cached_property
    def _record(self):
        return read_record(self.file, self.header)

    def complaints(self) -> Iterator[tuple[str, str]]:
        """Yield (key, message) if the file cannot be used."""
        try:
            _ = self._record if self.active else None
        except ValueError as error:
            yield "file", str(error)

    def remarks_on_file(self) -> Iterator[str]:
        """Yield what the user should know about the record."""
        yield from self._record.warnings if self.active else ()

    def ends(self) -> tuple[str, float]:
        """Return when the record ends [s]."""
        return "record", float(self._record.time[-1]) if self.active else inf
