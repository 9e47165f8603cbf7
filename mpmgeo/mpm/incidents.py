"""What may befall particles: they leave the mesh, or diverge."""

from typing import NamedTuple

import numpy as np

from mpmgeo.positions import NOWHERE, shown
from mpmgeo.state.checked import array_from, demand


class Departure(NamedTuple):
    """Particles that left the mesh in one step."""

    time: float  # [s]
    rows: np.ndarray
    position: np.ndarray  # (3,) of the first in the mesh [m]


class Departures(list):
    """All departures of a run; positions count from `zero` (3,) [m] in the user's coordinates."""

    def __init__(self, zero=NOWHERE):
        super().__init__()
        self.zero = zero
        self.all_of = None  # of some rows all those for which they stand; None: themselves

    def add(self, time, rows, position):
        """Note that particles in `rows` left at a time [s], the first of them at a position [m]."""
        rows = rows if self.all_of is None else self.all_of(rows)
        self.append(Departure(time, rows, position))

    def first(self):
        """Return what to tell of the first one, a list of messages."""
        first = self[0]
        where = shown(first.position, self.zero, digits=4)
        return [
            "particles leave the mesh and take no further part: the first is particle "
            f"{first.rows[0]}, at {where} after {first.time:.6g} s"
        ]

    def held(self):
        """Return the departures as arrays, by name."""
        if not self:
            return {}
        times, rows, positions = zip(*self, strict=True)
        return {
            "time": np.array(times),
            "count": np.array([len(r) for r in rows]),
            "rows": np.concatenate(rows),
            "position": np.array(positions),
        }

    def take(self, state):
        """Go on with what `held` once returned."""
        self.clear()
        if state:
            time = array_from(state, "time", np.float64, (None,))
            count = array_from(state, "count", np.int64, time.shape)
            rows = array_from(state, "rows", np.int64, (None,))
            position = array_from(state, "position", np.float64, (len(time), 3))
            is_sound = len(time) and (count > 0).all() and count.max() <= len(rows)
            demand(is_sound and count.sum() == len(rows), "count does not fit rows")
            parts = np.split(rows, np.cumsum(count)[:-1])
            self.extend(map(Departure, time.tolist(), parts, position))


class Unsound(Exception):
    """A particle's state is NaN, infinite or faster than a cell in a step."""

    def __init__(self, material, row, step, time, position, velocity, stress):
        super().__init__(f"particle in row {row} diverged in step {step}")
        self.material, self.row, self.step, self.time = material, row, step, time
        self.position, self.velocity, self.stress = position, velocity, stress
