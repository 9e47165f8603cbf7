"""A cube that vibrates while it flies through the mesh: nothing acts on it, its energy stays.

Along each axis it begins as the first mode of a free bar does where it passes through rest,
v = A sin(πx/L), x from the middle, with noise beside it. The energy of the vibration is

    E = ½ Σ m (v − V)·(v′ − V) + Σ V ψ(σ),

v and v′ the velocities half a step before and after the stress, V their mean: of a linear
vibration a leapfrog keeps it exactly, whatever the step.
"""

import numpy as np

import mpmgeo

CELL = 0.1  # m
CELLS = 4
WAVE = 36.69  # speed of compression waves [m/s]
AMPLITUDE = 0.01  # of the velocity, in wave speeds
NOISE = 0.02  # of the amplitude
FREE = {f"plane_{plane}": "free" for plane in ("X0", "Xn", "Y0", "Yn", "Z0", "Zn")}


def case(speed: float, per_direction: int, share: float, steps: int, **keys) -> dict:
    """Return the case of a cube of four cells that flies at `speed` [wave speeds] along x.

    `per_direction`: particles along an edge of a cell; `share`: time step in those in which a wave
    crosses a cell; `steps`: how many there are.
    """
    low, high = 3 * [CELL], 3 * [(1 + CELLS) * CELL]
    way = int(speed * share * steps) + CELLS + 4
    return {
        "time": share * steps * CELL / WAVE,
        "time_step": share * CELL / WAVE,
        "mesh": {
            "cells_number": [way, CELLS + 2, CELLS + 2],
            "cells_dimension": 3 * [CELL],
            "boundary_conditions": FREE,
        },
        "materials": [{"type": "elastic", "id": 1, "density": 1000, "young": 1e6, "poisson": 0.3}],
        "body": [
            {
                "type": "cuboid",
                "point_p1": low,
                "point_p2": high,
                "material_id": 1,
                "particles_per_direction": 3 * [per_direction],
                "initial_velocity": [speed * WAVE, 0, 0],
            }
        ],
    } | keys


class Flight:
    """A case of `case` under way: the energies of its vibration, in shares of the first one."""

    def __init__(self, keys):
        self.simulation = mpmgeo.Simulation(keys, threads=1)
        x, v = self.simulation.field("position"), self.simulation.field("velocity").copy()
        noise = np.random.default_rng(1).standard_normal(v.shape)
        x = x - x.mean(axis=0)
        mode = np.sin(np.pi * x / (CELLS * CELL)) + NOISE * noise
        self.simulation.assign("velocity", v + AMPLITUDE * WAVE * (mode - mode.mean(axis=0)))
        self.before = self._relative()
        self.first = self._kinetic(self.before, self.before)

    def _relative(self):
        """Return the velocities (n, 3) against their mean, all particles having one mass."""
        v = self.simulation.field("velocity")
        return v - v.mean(axis=0)

    def _kinetic(self, v, w):
        return 0.5 * float((self.simulation.field("mass")[:, None] * v * w).sum())

    def energy(self) -> float:
        """Make a step; return the energy at its beginning in shares of that at the start."""
        strain = float(self.simulation.solver.tally().strain.sum())
        self.before = self._relative()
        self.simulation.step()
        return (self._kinetic(self.before, self._relative()) + strain) / self.first

    def energies(self, steps: int, every: int = 5) -> np.ndarray:
        """Return the energies of every so many steps out of `steps`."""
        found = []
        for _ in range(steps // every):
            found.append(self.energy())
            self.simulation.step(every - 1)
        return np.array(found)
