"""Histories of the forces of the boundary planes."""

from dataclasses import dataclass
from typing import ClassVar

from mpmgeo.naming import PLANES
from mpmgeo.output.probes.probe import VECTOR, Probe
from mpmgeo.parameters import parameter


@dataclass(frozen=True)
class PlaneProbe(Probe):
    """Forces of the boundary planes on the material."""

    type: ClassVar[str] = "planes"

    planes: tuple[str, ...] = parameter("The planes", choices=PLANES, default=PLANES)

    def problems(self):
        """Yield (key, message) if there is no plane or no usable name."""
        yield from super().problems()
        if not self.planes:
            yield "planes", "needs at least one plane"

    def sampler(self, simulation):
        """Return what takes the samples."""
        return Forces(simulation.solver, self.planes)


class Forces:
    """The forces of some planes in the last step, none before the first one."""

    def __init__(self, solver, planes):
        self.solver = solver
        self.columns = [f"{plane}.force_{axis}" for plane in planes for axis in VECTOR]
        self._at = [PLANES.index(plane) for plane in planes]

    def row(self):
        """Return the forces [N], or None before the first step."""
        forces = self.solver.reactions
        return None if forces is None else forces[self._at].ravel()
