"""Particles: one set of arrays for each material, sorted by block; what never changes stays apart.

A set's arrays are permuted whenever particles change blocks; `row` says which row of the case each
entry is. Rows are in body order and, within a body, in order of creation; files are written in row
order. Particles that left the mesh stand behind the others, from `start[-1]` on.
"""

from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from mpmgeo.state.checked import array_from, demand
from mpmgeo.state.grid import cut

ARRAYS = (
    *("row", "x", "v", "C", "m", "V", "stress", "half", "force", "state"),
    *("pressure", "strain", "work", "F", "a", "mf", "vf", "pf", "free", "pull"),
    *("due", "contact", "domain"),
)
"""Fields of a set that are arrays, if they are there, with a row for each particle."""

IDENTITY = (1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0)
"""Deformation gradient at rest, as F holds it: xx xy xz yx yy yz zx zy zz."""

OPENING = "opening"
"""Variable of laws that let tension open the material: the strain by which it is open."""


def column_of_opening(law):
    """Return which of a law's variables that is, None for a law that never opens."""
    return law.STATE.index(OPENING) if OPENING in law.STATE else None


class Population(NamedTuple):
    """What is fixed about all particles of a case, in row order."""

    position: np.ndarray  # (n, 3) initial position in the mesh [m]
    size: np.ndarray  # (n, 3) edge lengths [m]
    body: np.ndarray  # (n,) body number, from 1
    material: np.ndarray  # (n,) material id
    force: np.ndarray | None  # (n, 3) constant load beside gravity [N]
    id: np.ndarray | None = None  # (n,) number in order of creation; None: the row
    zero: tuple = (0.0, 0.0, 0.0)  # where the positions count from, in the user's coordinates [m]


@dataclass
class ParticleSet:
    """The particles of one material."""

    law: NamedTuple  # symbols of the material law
    row: np.ndarray  # (n,)
    x: np.ndarray  # (n, 3) position in the mesh [m]
    v: np.ndarray  # (n, 3) velocity [m/s]
    m: np.ndarray  # (n,) mass [kg]
    V: np.ndarray  # (n,) volume without openings [m³]
    stress: np.ndarray  # (n, 6) effective stress [Pa]
    half: object  # half-sizes in cells: one triple, or (n, 3)
    C: np.ndarray | None = None  # (n, 3, 3) derivatives of velocity along x, y, z, if kept [1/s]
    rotation: object = None  # objective rate: how stress follows rotation
    force: np.ndarray | None = None  # (n, 3) constant load beside gravity [N]
    state: np.ndarray | None = None  # (n, k) variables of the law
    pressure: np.ndarray | None = None  # (n,) given pore pressure [Pa], compression positive
    strain: np.ndarray | None = None  # (n, 6) sum of the strain increments [-]
    F: np.ndarray | None = None  # (n, 9) deformation gradient, if the law wants it [-]
    work: np.ndarray | None = None  # (n, 2) done by stresses, and by pressure in opening [J]
    a: np.ndarray | None = None  # (n, 3) acceleration in the last step [m/s²]
    due: np.ndarray | None = None  # (n,) when to look for contact, see `mpm.touch`; −1 in contact
    contact: np.ndarray | None = None  # (n, …) forces and shift of contact, see `mpm.terrain`
    domain: np.ndarray | None = None  # (n, 6) second moments of domains, see `mpm.core.domain`
    least: tuple | None = None  # half-sizes in cells below which domains do not shrink
    tool: int | None = None  # number of the prescribed velocity that the particles have
    fluid: object = None  # symbols of the pore fluid; with it m is the solid's mass
    mf: np.ndarray | None = None  # (n,) mass of the fluid [kg]
    vf: np.ndarray | None = None  # (n, 3) its velocity [m/s]
    pf: np.ndarray | None = None  # (n,) its pressure [Pa], compression positive
    free: np.ndarray | None = None  # (n,) 0 where the pressure is prescribed, else 1
    pull: np.ndarray | None = None  # (n, 3) force on the fluid against the solid [N]
    start: np.ndarray = field(init=False)  # (blocks + 1,) first particle of each block
    chunk: np.ndarray = field(init=False)  # bounds of the chunks of blocks

    def __post_init__(self):
        self.place = None  # for loops, see `lie_in`
        self.start = np.array([0, len(self.row)])  # one heap, until the first sort
        self.chunk = cut(self.start)

    @property
    def material(self):
        """Return what an update needs: V, stress, m, state, strain, work, pressure, F.

        The masses only where they bound what tension opens, that is for `GRAINS`, the pressure
        where it works on what opens, and the work is kept.
        """
        m = self.m if getattr(self.law, "GRAINS", False) else None
        pressure = self.pressure if self.work is not None and opens_under_pressure(self) else None
        return self.V, self.stress, m, self.state, self.strain, self.work, pressure, self.F

    @property
    def follower(self):
        """Return what lets half-sizes follow the material, None if they stay: domain, least."""
        return None if self.domain is None else (self.domain, self.least)

    def volume(self, at=slice(None)):
        """Return the volumes [m³] of the particles `at`, with what tension has opened."""
        column = column_of_opening(self.law)
        return self.V[at] if column is None else self.V[at] * np.exp(self.state[at, column])

    def lie_in(self, grid):
        """Note where the particles lie in the blocks of a grid, for loops over them.

        `place`: bounds of the chunks of blocks, first particle of each and the one after its last,
        corners of the blocks.
        """
        self.place = self.chunk, self.start[:-1], self.start[1:], grid.corner

    def arrays(self):
        """Return the arrays that are permuted together, by name."""
        return {name: a for name in ARRAYS if isinstance(a := getattr(self, name), np.ndarray)}

    def held(self):
        """Return what a run that goes on needs of the set, by name."""
        return self.arrays() | {"start": self.start, "chunk": self.chunk}

    def take(self, state):
        """Go on with what `held` once returned; ValueError for arrays of other particles."""
        given = {n: array_from(state, n, a.dtype, a.shape) for n, a in self.arrays().items()}
        start = array_from(state, "start", self.start.dtype, (None,))
        chunk = array_from(state, "chunk", self.chunk.dtype, self.chunk.shape)
        rows = np.sort(given["row"]), np.sort(self.row)
        demand(np.array_equal(*rows), "row holds other particles than those of the case")
        is_sound = len(start) > 0 and start[0] == 0 and start[-1] <= len(self.row)
        is_sound = is_sound and (start[1:] >= start[:-1]).all()  # differences may overflow
        demand(is_sound, "start holds no bounds of the particles")
        demand(np.array_equal(chunk, cut(start)), "chunk does not fit start")
        for name, found in given.items():
            np.copyto(getattr(self, name), found)
        self.start, self.chunk = start.copy(), chunk.copy()

    def assign(self, name, values):
        """Set an array from values in row order; where velocities are set, gradients vanish."""
        getattr(self, name)[:] = values[self.row]
        if name == "v" and self.C is not None:
            self.C[:] = 0.0

    def stop(self):
        """Stop the active particles, both phases of them."""
        self.v[: self.active] = 0.0
        if self.a is not None:
            self.a[: self.active] = 0.0
        if self.C is not None:
            self.C[: self.active] = 0.0
        if self.fluid is not None:
            self.vf[: self.active] = 0.0

    @property
    def active(self) -> int:
        """Number of particles that have not left the mesh."""
        return int(self.start[-1])


def opens_under_pressure(s):
    """Tell whether given pore pressures work on what tension opens in a set."""
    return s.pressure is not None and column_of_opening(s.law) is not None
