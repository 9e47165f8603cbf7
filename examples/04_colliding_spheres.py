"""Two elastic spheres collide off centre and fly apart: momentum and energy over time.

Momentum stays to round-off. Part of the kinetic energy becomes strain energy during the contact and
comes back, less what stays in vibrations of the spheres and what the grid smooths away.
"""

import numpy as np

from mpmgeo import Simulation, load_case

CASE = {
    "title": "Two elastic spheres collide",
    "time": 0.2,
    "critical_time_step_multiplier": 0.3,
    "stress_scheme_update": "USF",
    "mesh": {"cells_number": [24, 14, 14], "cells_dimension": [0.1, 0.1, 0.1]},
    "materials": [{"type": "elastic", "id": 1, "density": 1000, "young": 1e6, "poisson": 0.3}],
    "body": [
        {
            "type": "sphere",
            "center": [0.8, 0.7, 0.7],
            "diameter": 0.6,
            "material_id": 1,
            "initial_velocity": [2.0, 0.0, 0.0],
        },
        {
            "type": "sphere",
            "center": [1.6, 0.7, 0.8],
            "diameter": 0.6,
            "material_id": 1,
            "initial_velocity": [-2.0, 0.0, 0.0],
        },
    ],
}
YOUNG, POISSON = 1e6, 0.3


def strain_energy(simulation):
    """Return the elastic energy [J] that the stresses hold: V ((1 + ν) σ:σ − ν tr²σ)/(2E)."""
    stress, volume = simulation.field("stress"), simulation.field("volume")
    squares = (stress[:, :3] ** 2).sum(axis=1) + 2 * (stress[:, 3:] ** 2).sum(axis=1)
    trace = stress[:, :3].sum(axis=1)
    return volume @ ((1 + POISSON) * squares - POISSON * trace**2) / (2 * YOUNG)


simulation = Simulation(load_case(CASE))
mass = simulation.field("mass")
first_momentum = mass @ simulation.field("velocity")

rows = [(0.0, simulation.kinetic_energy(), 0.0)]
while simulation.time < CASE["time"]:
    simulation.step(5)
    rows.append((simulation.time, simulation.kinetic_energy(), strain_energy(simulation)))
time, kinetic, elastic = np.array(rows).T
momentum_change = np.abs(mass @ simulation.field("velocity") - first_momentum).max()
momentum_scale = mass.sum() * 2.0


def plot():
    import matplotlib.pyplot as plt

    plt.plot(time, kinetic, label="kinetic")
    plt.plot(time, elastic, label="elastic")
    plt.plot(time, kinetic + elastic, "k--", label="sum")
    plt.xlabel("time [s]")
    plt.ylabel("energy [J]")
    plt.legend()
    plt.show()


if __name__ == "__main__":
    plot()
