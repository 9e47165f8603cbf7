"""What a case may say of its time steps, and of when it ends before its time."""

from collections.abc import Iterator
from dataclasses import dataclass

from mpmgeo.parameters import parameter

ADAPTIVE = "adaptive"


@dataclass(frozen=True)
class Rest:
    """A state of rest at which the run ends; of several figures all have to be reached."""

    unbalanced_force: float | None = parameter(
        "Largest resultant at a node over the mean of the forces that act on nodes",
        above=0,
        default=None,
    )
    kinetic_energy: float | None = parameter(
        "Kinetic energy over the work of the loads so far", above=0, default=None
    )
    every: int = parameter("Steps between two looks at the figures", minimum=1, default=50)

    def problems(self) -> Iterator[tuple[str, str]]:
        """Yield (key, message) if there is no figure to be reached."""
        if self.unbalanced_force is None and self.kinetic_energy is None:
            yield "unbalanced_force", 'this or "kinetic_energy" is needed, or both'


@dataclass(frozen=True)
class Stepping:
    """How long the steps are, and when there are enough of them."""

    time_step: float | None = parameter(
        "Time step; absent or 0: chosen from the critical one at the start; adaptive: from that of "
        "the speeds as they are",
        unit="s",
        minimum=0,
        words=(ADAPTIVE,),
        default=None,
    )
    critical_time_step_multiplier: float = parameter(
        "Share of the critical time step to use when none is given", above=0, default=0.25
    )
    density_scaling: float = parameter(
        "Factor of the inertia, not of weight and loads, for longer steps on the way to rest; "
        "with local or kinetic damping",
        minimum=1,
        default=1.0,
    )
    until: Rest | None = parameter(
        "State of rest at which the run ends, before its time; absent: none", default=None
    )

    @property
    def is_adaptive(self) -> bool:
        """Return whether the steps follow from the speeds."""
        return self.time_step == ADAPTIVE
