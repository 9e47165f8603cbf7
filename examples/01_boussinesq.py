"""A point force on an elastic cube: settlement below it, beside that of a half-space.

Runs the case of inputs/boussinesq and compares the particles nearest to the axis of the force
with Boussinesq's formula. Near the force they agree; towards the floor, which does not give way,
the cube settles less.
"""

from pathlib import Path

import numpy as np

import mpmgeo
from mpmgeo.verify.half_space import HalfSpace

CASE = Path(__file__).parents[1] / "inputs" / "boussinesq" / "case.json"
GROUND = HalfSpace(young=200e6, poisson=0.25, force=1.0)
FORCE_AT = np.array([0.5, 0.5, 1.0])

simulation = mpmgeo.Simulation(mpmgeo.load_case(CASE)).run()

displacement = simulation.field("displacement")
position = simulation.field("position") - displacement - FORCE_AT
from_axis = np.hypot(position[:, 0], position[:, 1])
column = from_axis < from_axis.min() + 1e-6  # four columns of particles around the axis

depth = -position[column, 2]
settlement = -displacement[column, 2]
half_space = -GROUND.displacement(position[column])[:, 2]


def plot():
    import matplotlib.pyplot as plt

    order = np.argsort(depth)
    plt.plot(half_space[order] * 1e9, depth[order], "k-", label="half-space (Boussinesq)")
    plt.plot(settlement * 1e9, depth, "o", label="cube, 10³ cells")
    plt.gca().invert_yaxis()
    plt.xlabel("settlement [nm]")
    plt.ylabel("depth [m]")
    plt.legend()
    plt.show()


if __name__ == "__main__":
    plot()
