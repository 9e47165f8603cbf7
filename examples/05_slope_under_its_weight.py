"""An elastic slope finds its static state under its own weight, with two kinds of damping.

The slope is a polygon extruded by one cell between two sliding planes (plane strain), on a fixed
floor at z = 0. Kinetic damping stops all motion whenever the kinetic energy has passed a peak,
local damping brakes every node by a share of its force; both lead to the same state. There the
stresses carry the weight: multiplying the equilibrium by the height z and adding up gives
ΣVσzz = −Σmgz, whatever the shape of the slope.
"""

from mpmgeo import Simulation, load_case

GRAVITY = 9.81
CASE = {
    "title": "Elastic slope under its own weight",
    "time": 4.0,
    "critical_time_step_multiplier": 0.35,
    "gravity": [0.0, 0.0, -GRAVITY],
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


def settle(damping):
    """Return the simulation of the slope at rest."""
    return Simulation(load_case(CASE | {"damping": damping})).run()


simulation = settle({"type": "kinetic"})
braked = settle({"type": "local", "value": 0.3})

displacement = simulation.field("displacement")
height = simulation.field("position")[:, 2]
vertical_stress = simulation.field("stress")[:, 2]
carried = -simulation.field("volume") @ vertical_stress
weight_moment = GRAVITY * simulation.field("mass") @ height
crest_settlement = -displacement[:, 2].min()
crest_settlement_braked = -braked.field("displacement")[:, 2].min()


def plot():
    import matplotlib.pyplot as plt

    x = simulation.field("position")[:, 0]
    points = plt.scatter(x, height, c=vertical_stress / 1e3, s=8)
    plt.colorbar(points, label="vertical stress [kPa]")
    plt.axis("equal")
    plt.xlabel("x [m]")
    plt.ylabel("z [m]")
    plt.show()


if __name__ == "__main__":
    plot()
