"""The scenes of the benchmarks: blocks of an elastic solid, eight particles a cell."""

import numpy as np

import mpmgeo

CELL = 0.1  # m
TIME_STEP = 2e-4  # s, 0.44 of the time in which a wave crosses a cell
SPEED = CELL / (20 * TIME_STEP)  # m/s: one cell in 20 steps
MARGIN = 8  # cells between a block and the lower planes, a multiple of the grid's blocks
SOLID = {"type": "elastic", "id": 1, "density": 2500.0, "young": 1e8, "poisson": 0.25}
WATER = {
    "density_fluid": 1000.0,
    "porosity": 0.4,
    "bulk_fluid": 1e7,  # Pa, so soft that the time step suits it too
    "hydraulic_conductivity": [1e-4, 1e-4, 1e-4],
}
PLANES = ("X0", "Y0", "Z0", "Xn", "Yn", "Zn")


def side_of(particles):
    """Return the cells along the edge of a cube of about that many particles."""
    return max(1, round((particles / 8) ** (1 / 3)))


def _block(side, corner, cells, **keys):
    """Return the case of a cube of `side` cells whose corner is at the node `corner` (3,)."""
    low = [c * CELL for c in corner]
    body = {
        "type": "cuboid",
        "point_p1": low,
        "point_p2": [c + side * CELL for c in low],
        "material_id": 1,
        "initial_velocity": keys.pop("velocity", [0.0, 0.0, 0.0]),
    }
    mesh = {
        "cells_number": list(cells),
        "cells_dimension": 3 * [CELL],
        "boundary_conditions": {
            f"plane_{plane}": keys["planes"].get(plane, "free") for plane in PLANES
        },
    }
    del keys["planes"]
    case = {"time": 1.0, "time_step": TIME_STEP, "mesh": mesh, "materials": [SOLID], "body": [body]}
    return case | keys


def standing(side, **keys):
    """Return a block that stands on a fixed plane under gravity."""
    cells = [side + 2 * MARGIN, side + 2 * MARGIN, side + MARGIN]
    keys = {"gravity": [0.0, 0.0, -9.81], "planes": {"Z0": "fixed"}} | keys
    return _block(side, [MARGIN, MARGIN, 0], cells, **keys)


def saturated(side, **keys):
    """Return the standing block with water in its pores."""
    return standing(side, n_phases=2, materials=[SOLID | WATER], **keys)


def floating(side, **keys):
    """Return a block in free space, with room to move for thousands of steps."""
    return _block(side, 3 * [MARGIN], [side + 400, side + 400, side + 400], planes={}, **keys)


def lost_in_space(side):
    """Return the floating block in the middle of 400 million cells."""
    return _block(side, [480, 480, 180], [1000, 1000, 400], planes={})


def simulation(case):
    """Return the simulation of a case given as a dict."""
    return mpmgeo.Simulation(mpmgeo.load_case(case))


def restless(side):
    """Return the simulation of a floating block whose particles all go their own way at SPEED.

    They begin anywhere around their places, so that some cross between blocks in every step.
    """
    result = simulation(floating(side))
    random = np.random.default_rng(1)
    way = random.normal(size=(result.solver.count, 3))
    result.assign("velocity", SPEED * way / np.linalg.norm(way, axis=1)[:, None])
    for particles in result.solver.sets:
        particles.x += random.uniform(-CELL / 4, CELL / 4, particles.x.shape)
    return result
