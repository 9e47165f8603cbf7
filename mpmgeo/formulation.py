"""What a formulation of mechanics has to offer to be run, watched, written, kept and resumed.

`Simulation`, the time loop's watchers, probes, files and snapshots ask a solver for nothing else.
The material point method of `mpm/` is the first formulation; a test keeps to this list.
"""

from typing import Any, NamedTuple, Protocol

import numpy as np


class Terrain(Protocol):
    """A surface that particles touch, as it lies now."""

    def distance(self, x: np.ndarray) -> np.ndarray:
        """Return the signed distances (n,) [m] of points (n, 3) [m]."""

    def triangles(self) -> tuple[np.ndarray, np.ndarray]:
        """Return centres (n, 3) [m] and normals (n, 3) of its triangles."""

    def level(self, s: Any, at: Any) -> np.ndarray:
        """Return the distances (n,) [m] of the particles `at` of a set that files show."""

    def density(self, solver: "Formulation") -> tuple[np.ndarray, np.ndarray]:
        """Return node indices (n, 3), and the share (n,) of their volume that particles fill."""

    def density_at(self, solver: "Formulation", x: np.ndarray) -> np.ndarray:
        """Return that share (n,) at points (n, 3) [m]."""


class Energies(NamedTuple):
    """What tells whether energy has appeared [J].

    `total`: what there is less what was put in, as far as both are known: it may only fall;
    `within`: of strain and of motion apart from that of the bodies' centres of mass; `turnover`:
    what was dissipated or put in at nodes; `size` of the sums, whose round-off is in the total.
    """

    total: float
    within: float
    turnover: float
    size: float


class Formulation(Protocol):
    """A solver: its state, and what it does with it. SI units."""

    time: float
    steps: int  # number of steps done
    time_step: float
    gravity: tuple[float, float, float]
    count: int  # of all particles, those that left included
    active: int  # of the particles that have not left
    sets: list  # of `state.particles.ParticleSet`, one or more for each material
    population: Any  # `state.particles.Population`, what is fixed about all particles
    grid: Any  # `state.grid.Grid`, None for a formulation without one, which writes no grid files
    cutoff: float  # [kg] mass up to which a node counts as empty
    ground: Terrain | None
    reactions: np.ndarray | None  # (6 + prescribed velocities, 3) [N] when last measured
    ledger: Any  # of energy: `row()` are the last figures; None if the case asks for none
    peak_energy: float | None  # [J] before the particles were stopped in the last step, if so
    departures: list  # `Departure` of particles that left the mesh
    clock: Any  # `numerics.clock.Clock`, seconds by stage

    def step(self) -> None:
        """Advance by one time step; raises Unsound when particles diverge."""

    def check(self) -> None:
        """Raise Unsound if a particle is no longer sound."""

    def arrange(self) -> None:
        """Bring the particles in the order that looking for them by place needs; as `step`."""

    def energies(self) -> Energies | None:
        """Return what tells whether energy has appeared, None if work is done that nobody sees."""

    def kinetic_energy(self) -> float:
        """Return the kinetic energy of the active particles [J]."""

    def effect(self, name: str) -> Any:
        """Return what joins the steps under a name, None without."""

    def news(self) -> Any:
        """Yield (topic, messages) for what the user should be told of, `messages` a function."""

    def owners(self) -> dict[str, Any]:
        """Return all that hold a part of the state, by the name that their part has.

        Each has `held()`, which returns its part by name, and `take(held)`, which goes on with it;
        KeyError for what is missing, ValueError for what cannot be.
        """

    def keep(self, kept: dict | None = None) -> dict:
        """Return a copy of the whole state, in the arrays of the copy `kept` if there is one."""

    def restore(self, kept: dict) -> None:
        """Go back to the state that `keep` returned."""

    def solver_of(self, state: dict) -> "Formulation":
        """Return the solver that a state, or the entries of a snapshot, is one of."""

    def assigned(self) -> None:
        """Take note that somebody has given particles other values."""

    def restart(self) -> None:
        """Count time and displacements from now on, at rest, with the present stresses."""
