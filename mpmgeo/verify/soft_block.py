"""A soft block under its own weight, which grows slowly: a column with rollers at its sides.

With no Poisson's ratio the section stays, so with ρ₀, E, the height H and the depth X at the start

    σ = −ρ₀ g X,    λ = e^(−ρ₀ g X/E),    u = H − E/(ρ₀ g) (1 − e^(−ρ₀ g H/E)) at the top,

since the stress is E ln λ where it follows the rate of strain.

Source: Andersen and Andersen (2010), Comput. Mech. 46, 165–177, for the block; derived.
"""

from dataclasses import dataclass
from math import ceil, exp, sqrt
from typing import NamedTuple

import numpy as np

from mpmgeo.verify.dyka_bar import GAUSS


class Means(NamedTuple):
    """Over the last two fifths of a run, and at its end."""

    settlement: float  # of the highest particles, in the mean [m]
    stress: float  # vertical, of the lowest particles, in the mean [Pa]
    profile: float  # error of the vertical stress at the end, in the mean square [Pa]


@dataclass(frozen=True)
class SoftBlock:
    """Block of height [m], density [kg/m³], young [Pa] in cells of `cell` [m] under gravity [m/s²].

    Gravity grows as a sine over half of `time` [s].
    """

    height: float = 10.0
    density: float = 6000.0
    young: float = 5e6
    gravity: float = 9.81
    cell: float = 2.0
    time: float = 20.0

    def stress(self, depth):
        """Return the vertical stress [Pa] at rest, of particles at a depth [m] at the start."""
        return -self.density * self.gravity * depth

    def settlement(self, depth: float) -> float:
        """Return the settlement [m] at rest, of particles at a depth [m] at the start."""
        k = self.density * self.gravity / self.young
        return (self.height - depth) - (exp(-k * depth) - exp(-k * self.height)) / k

    def case(self, scheme="NPC", shape="LME", courant=0.1, **keys) -> dict:
        """Return the case, one cell wide, with two particles a cell and direction.

        They lie at the points of Gauss's quadrature, with GIMP at the quarters of the cell.
        """
        cells, h = round(self.height / self.cell), self.cell
        places = (0.25, 0.75) if shape == "GIMP" else GAUSS
        up = (np.arange(cells)[:, None] + places).ravel()
        x, y, z = (h * a.ravel() for a in np.meshgrid(places, places, up, indexing="ij"))
        step = courant * h / sqrt(self.young / self.density)
        return {
            "title": f"Soft block, {self.height:g} m high, {scheme}, {shape}",
            "time": self.time,
            "time_step": self.time / ceil(self.time / step),
            "stress_scheme_update": scheme,
            "shape_function": shape,
            "gravity": {
                "value": [0.0, 0.0, -self.gravity],
                "ramp": {"type": "sine", "duration": self.time / 2},
            },
            "mesh": {
                "cells_number": [1, 1, cells + 2],
                "cells_dimension": [h, h, h],
                "boundary_conditions": {"plane_Z0": "fixed", "plane_Zn": "free"},
            },
            "materials": [
                {
                    "type": "elastic",
                    "id": 1,
                    "young": self.young,
                    "density": self.density,
                    "poisson": 0.0,
                }
            ],
            "body": [
                {
                    "type": "particles",
                    "material_id": 1,
                    "particles": {
                        "position": np.stack([x, y, z], axis=1).tolist(),
                        "volume": [h**3 / 8] * len(x),
                    },
                }
            ],
            "n_threads": 1,
        } | keys

    def run(self, simulation) -> Means:
        """Run a simulation of the case to its end and return what it gives."""
        depth = self.height - simulation.field("position")[:, 2]
        top, bottom = depth < depth.min() + 1e-9, depth > depth.max() - 1e-9
        settlements, stresses = [], []
        while simulation.time < self.time - 0.5 * simulation.time_step:
            simulation.step()
            if simulation.time > 0.6 * self.time:
                settlements.append(-simulation.field("displacement")[top, 2].mean())
                stresses.append(simulation.field("stress")[bottom, 2].mean())
        error = simulation.field("stress")[:, 2] - self.stress(depth)
        return Means(np.mean(settlements), np.mean(stresses), float(np.sqrt(np.mean(error**2))))
