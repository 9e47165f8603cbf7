"""A slope under its own weight finds its static state in three ways, and each run ends by itself.

The slope is that of example 05: a polygon extruded by one cell between sliding planes. A run ends
as soon as no node is pushed by more than a small share of the mean of the forces at nodes, and the
kinetic energy is a small share of the work of the weight. One run has the real inertia, one a
hundred times as much, so that its steps are ten times as long and its times have no meaning. In the
third the material is soft, stiffens where it is squeezed, and the steps follow.
"""

from mpmgeo import Simulation, load_case

GRAVITY = 9.81
CASE = {
    "title": "Three ways of a slope to rest",
    "time": 100.0,
    "until": {"unbalanced_force": 1e-4, "kinetic_energy": 1e-8},
    "critical_time_step_multiplier": 0.35,
    "gravity": [0.0, 0.0, -GRAVITY],
    "damping": {"type": "local", "value": 0.5},
    "mesh": {
        "cells_number": [20, 1, 10],
        "cells_dimension": [0.25, 0.25, 0.25],
        "boundary_conditions": {"plane_X0": "sliding", "plane_Z0": "fixed", "plane_Zn": "free"},
    },
    "materials": [{"type": "elastic", "id": 1, "density": 2000, "young": 1e6, "poisson": 0.3}],
    "body": [
        {
            "type": "polygon_2d",
            "points": [[0, 0, 0], [4, 0, 0], [2, 0, 2], [0, 0, 2]],
            "extrude_direction": "y",
            "extrude_displacement": 0.25,
            "material_id": 1,
        }
    ],
}
SOFT = {"type": "neo-hookean", "id": 1, "density": 2000, "young": 3e5, "poisson": 0.3}

WAYS = {
    "real inertia": {},
    "scaled inertia": {"density_scaling": 100.0},
    "steps that follow": {"time_step": "adaptive", "materials": [SOFT]},
}

rests = {way: Simulation(load_case(CASE | more)).run() for way, more in WAYS.items()}


def balance(simulation):
    """Return what the stresses carry, over the weight times its height; 1 at rest."""
    carried = -simulation.field("volume") @ simulation.field("stress")[:, 2]
    weight = GRAVITY * simulation.field("mass") @ simulation.field("position")[:, 2]
    return carried / weight


balances = {way: balance(simulation) for way, simulation in rests.items()}
settlements = {way: -s.field("displacement")[:, 2].min() for way, s in rests.items()}


def plot():
    import matplotlib.pyplot as plt

    for way, simulation in rests.items():
        x, _, z = simulation.field("position").T
        label = f"{way}: {simulation.steps} steps, {simulation.time:.3g} s"
        plt.plot(x, z, ".", markersize=3, label=label)
    plt.axis("equal")
    plt.legend()
    plt.xlabel("x [m]")
    plt.ylabel("z [m]")
    plt.show()


if __name__ == "__main__":
    plot()
