"""The longest stable time step, found by trying: does the energy of a small block grow?

A block of 3 × 3 × 3 cells, free in its mesh, undamped, gets velocities of noise, which hold all its
motions. They are a billionth of the wave speed: nothing crosses a cell, so that a step is a linear
map, whose powers grow or do not. Without growth the energy, kinetic and elastic, falls (USL) or
swings (MUSL, USF, the more the nearer the limit, as velocities lie half a step before positions). A
step counts as too long if the energy is a thousand times the first one within a thousand steps:
growth of a third of a percent a step. The slow growth of bodies that cross cells is not looked for.
"""

import numpy as np

from mpmgeo.mpm.incidents import Unsound
from mpmgeo.simulation import Simulation

CELL = 0.1
OFFSETS = (0.0, 0.001, 0.02, 0.1, 0.249, 0.499)
"""Cells by which the block is shifted: the last two put particles beside faces of cells."""

SOIL = {"type": "elastic", "id": 1, "density": 2650.0, "young": 5e7}
WATER = {"density_fluid": 1000.0, "porosity": 0.4, "bulk_fluid": 2.2e9}
NOISE, GROWTH, STEPS, BETWEEN = 1e-9, 1e3, 1000, 20
FREE = {f"plane_{plane}": "free" for plane in ("X0", "Xn", "Y0", "Yn", "Z0", "Zn")}


def block(per_direction, poisson, edges=(1, 1, 1), offset=0.0, conductivity=None, **keys) -> dict:
    """Return the case of the block, with so many particles along each edge of a cell.

    `edges`: of the cells, relative to each other; `conductivity` [m/s]: saturated with water.
    """
    cell = CELL * np.array(edges, float)
    soil, fluid = SOIL | {"poisson": poisson}, {}
    if conductivity is not None:
        soil |= WATER | {"hydraulic_conductivity": 3 * [conductivity]}
        fluid = {"n_phases": 2}
    return {
        "time": 1.0,
        "mesh": {
            "cells_number": [7, 7, 7],
            "cells_dimension": cell.tolist(),
            "boundary_conditions": FREE,
        },
        "materials": [soil],
        "body": [
            {
                "type": "cuboid",
                "point_p1": ((2 + offset) * cell).tolist(),
                "point_p2": ((5 + offset) * cell).tolist(),
                "material_id": 1,
                "particles_per_direction": 3 * [per_direction],
            }
        ],
        **fluid,
    } | keys


class Trial:
    """A block whose time step can be tried; shares are those of its critical time step."""

    def __init__(self, case):
        self.simulation = s = Simulation(case, threads=1)
        self.critical = s.critical_time_step
        self.limit = s.stable_time_step / self.critical
        noise = np.random.default_rng(1).standard_normal((s.solver.count, 3))
        velocity = NOISE * min(s.case.mesh.cells_dimension) / self.critical * noise
        s.assign("velocity", velocity)
        if s.case.n_phases == 2:
            s.assign("velocity_fluid", velocity)
        s.keep()
        self.first = self.energy()

    def energy(self) -> float:
        """Return kinetic and elastic energy [J]."""
        law = self.simulation.case.materials[0]
        energy = self.simulation.kinetic_energy()
        for s in self.simulation.solver.sets:
            normal, shear = s.stress[:, :3], s.stress[:, 3:]
            square = (normal**2).sum(axis=1) + 2 * (shear**2).sum(axis=1)
            trace = normal.sum(axis=1)
            density = ((1 + law.poisson) * square - law.poisson * trace**2) / (2 * law.young)
            if s.fluid is not None:
                density += law.porosity * s.pf**2 / (2 * law.bulk_fluid)
            energy += float(s.V @ density)
        return energy

    def diverges(self, share, steps=STEPS) -> bool:
        """Tell whether the energy grows with a share of the critical time step."""
        solver = self.simulation.solver
        self.simulation.restore()
        solver.time_step = share * self.critical
        with np.errstate(all="ignore"):
            for _ in range(steps // BETWEEN):
                try:
                    for _ in range(BETWEEN):
                        solver.step()
                    solver.check()
                except Unsound:
                    return True
                if not 0 <= self.energy() < GROWTH * self.first:  # overturned volumes are negative
                    return True
        return False


def bisected(trials, low, high=4.0, accuracy=0.02) -> float:
    """Return the longest share of the critical step that is stable in all trials; 0 if not `low`.

    `high`: a share that is not.
    """
    for trial in trials:
        if not trial.diverges(high):
            continue
        below = low
        if trial.diverges(below):
            return 0.0
        while high > below * (1 + accuracy):
            middle = (below * high) ** 0.5
            below, high = (below, middle) if trial.diverges(middle) else (middle, high)
    return high / (1 + accuracy)
