"""Contact with a terrain: a surface of triangles from an STL file, rigid, with Coulomb friction.

    f_n = −m v_n/Δt n,    |f_t| ≤ μ |f_n|,    f_n += k δ n where the penalty is on, δ the overlap

What a case says about it; `mpm/contact.py` finds and applies the forces.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import ClassVar, NamedTuple

from mpmgeo.action import Action
from mpmgeo.boundaries.stl import read_stl
from mpmgeo.boundaries.surface import Surface, surface_of
from mpmgeo.parameters import Placed, parameter


class Symbols(NamedTuple):
    """Friction μ [-], stiffness of the penalty k [N/m], 0 without, radius of the search D [m]."""

    μ: float
    k: float
    D: float


@dataclass(frozen=True)
class TerrainContact(Action, Placed):
    """Contact with a terrain given by triangles, rigid, with Coulomb friction."""

    key: ClassVar[str] = "terrain_contact"
    about: ClassVar[str] = "Contact with a terrain"
    is_several: ClassVar[bool] = False
    switch: ClassVar[str | None] = "active"
    one_phase_only: ClassVar[str] = "a terrain does not hold the pore fluid; leave one of them out"

    active: bool = parameter("Whether there is contact", default=False)
    stl_mesh: Path | None = parameter(
        "STL file of the surface; its outside is where the corners of triangles run anticlockwise",
        file=True,
        default=None,
    )
    friction: float = parameter("Coefficient of Coulomb friction", minimum=0, default=0.0)
    distance_threshold: float = parameter(
        "Radius of the search for contact, in mean cell sizes", above=0, default=2.0
    )
    penalty_contact_active: bool = parameter(
        "Whether a spring pushes overlapping particles out", default=False
    )
    penalty_stiffness: float = parameter(
        "Stiffness of that spring for each particle", unit="N/m", minimum=0, default=0.0
    )

    def problems(self) -> Iterator[tuple[str, str]]:
        """Yield (key, message) if there is contact without a file."""
        if self.active and self.stl_mesh is None:
            yield "stl_mesh", "is required when active is true"

    def complaints(self) -> Iterator[tuple[str, str]]:
        """Yield (key, message) if the file cannot be used."""
        try:
            _ = self.surface if self.active else None
        except ValueError as error:
            yield "stl_mesh", str(error)

    @property
    def surface(self) -> Surface:
        """Return the surface of the file; raises ValueError if it cannot be used."""
        return self._content[0]

    @property
    def resolution(self) -> float:
        """Return how exactly the file holds coordinates [m]; raises ValueError as `surface`."""
        return self._content[1]

    @cached_property
    def _content(self):
        triangles = read_stl(self.stl_mesh)
        corner, known = triangles.corner - self.zero, triangles.resolution
        try:
            surface = surface_of(corner, triangles.normal, known)
        except ValueError as error:
            raise ValueError(f"{self.stl_mesh}: {error}") from None
        notes = (f"{self.stl_mesh}: {note}" for note in surface.notes)
        return surface._replace(notes=(*triangles.warnings, *notes)), known

    def symbols(self, cell: float) -> Symbols:
        """Return what the kernels use; `cell`: mean cell size [m]."""
        stiffness = self.penalty_stiffness if self.penalty_contact_active else 0.0
        return Symbols(self.friction, stiffness, self.distance_threshold * cell)
