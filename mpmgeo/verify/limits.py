"""Small problems with known answers that the plain material point method gets wrong.

A column of two layers under its own weight (σzz = −ρg (H − z)), a bar that is drawn out slowly
(σ = E ln(1 + ε)), a square that spins freely (its angular momentum stays), a cube that vibrates in
flight (its energy stays).
"""

import numpy as np

from mpmgeo.run.watch import StopRun, Watcher

CELL = 0.1
DENSITY = 1000.0
GRAVITY = 9.81
SOFT = 1e6
FREE = {f"plane_{plane}": "free" for plane in ("X0", "Xn", "Y0", "Yn", "Z0", "Zn")}


def _elastic(number, young, poisson=0.0):
    return {
        "type": "elastic",
        "id": number,
        "density": DENSITY,
        "young": young,
        "poisson": poisson,
    }


def _mesh(cells, planes, fine=1):
    return {
        "cells_number": [fine * n for n in cells],
        "cells_dimension": 3 * [CELL / fine],
        "boundary_conditions": planes,
    }


def _cuboid(low, high, material=1, **keys):
    return {"type": "cuboid", "point_p1": low, "point_p2": high, "material_id": material} | keys


def layers(ratio: float, stiff: str = "lower", **keys) -> dict:
    """Return the case of a column of ten cells whose `stiff` half is `ratio` times as stiff."""
    lower, upper = (2, 1) if stiff == "lower" else (1, 2)
    slides = dict.fromkeys(FREE, "sliding")
    return {
        "time": 0.6,
        "gravity": [0, 0, -GRAVITY],
        "mesh": _mesh([1, 1, 12], slides),
        "materials": [_elastic(1, SOFT), _elastic(2, ratio * SOFT)],
        "body": [
            _cuboid([0, 0, 0], [CELL, CELL, 0.5], lower),
            _cuboid([0, 0, 0.5], [CELL, CELL, 1.0], upper),
        ],
        "damping": {"type": "local", "value": 0.3},
    } | keys


def error_in_layers(simulation) -> dict[str, float]:
    """Return the largest error of σzz in the soft and in the stiff layer, relative to ρgH."""
    z = simulation.field("position")[:, 2]
    weight = DENSITY * GRAVITY
    error = np.abs(simulation.field("stress")[:, 2] + weight * (1.0 - z)) / weight
    stiff = simulation.field("material") == 2
    return {"soft": float(error[~stiff].max()), "stiff": float(error[stiff].max())}


def bar(per_direction: int = 2, **keys) -> dict:
    """Return the case of a bar of ten cells, drawn out by a body of two more at 0.2 m/s."""
    lattice = {"particles_per_direction": 3 * [per_direction]}
    return {
        "time": 3.5,
        "mesh": _mesh([24, 1, 1], {"plane_X0": "fixed"}),
        "materials": [_elastic(1, SOFT)],
        "body": [
            _cuboid([0, 0, 0], [1.0, CELL, CELL], **lattice),
            _cuboid([1.0, 0, 0], [1.2, CELL, CELL], **lattice),
        ],
        "prescribed_velocity": {"grip": {"body": 2, "velocity": [0.2, None, None]}},
    } | keys


def share_of_stress(simulation) -> float:
    """Return the mean axial stress of the bar in relation to E ln(1 + ε)."""
    stress = simulation.field("stress")[simulation.field("body") == 1, 0].mean()
    return float(stress / (SOFT * np.log1p(0.2 * simulation.time)))


def block(offset: float = 0.0, **keys) -> dict:
    """Return the case of a cube of 27 cells that falls by 0.3 m, `offset` [m] from the lattice."""
    low, high = 0.3 + offset, 0.6 + offset
    body = _cuboid(3 * [low], 3 * [high], initial_velocity=[0.2, 0.1, 0.0])
    return {
        "time": 1.0,
        "gravity": [0, 0, -GRAVITY],
        "mesh": _mesh([10, 10, 10], FREE | {"plane_Z0": "fixed"}),
        "materials": [_elastic(1, SOFT, 0.3)],
        "body": [body],
    } | keys


def square(turns: float = 3.0, fine: int = 1, **keys) -> dict:
    """Return the case of a square of 4 × 4 × 1 cells, `fine` times as many along each axis.

    `spin` sets it in motion, the case lasts for some turns of 5 rad/s.
    """
    law = _elastic(1, SOFT, 0.3) | {"objective_rate": "hughes-winget"}
    return {
        "time": turns * 2 * np.pi / 5.0,
        "mesh": _mesh([12, 12, 3], FREE, fine),
        "materials": [law],
        "body": [_cuboid([0.4, 0.4, 0.1], [0.8, 0.8, 0.2])],
    } | keys


def spin(simulation) -> float:
    """Make a square spin about its middle at 5 rad/s; return its angular momentum [kg m²/s]."""
    x, y, _ = (simulation.field("position") - [0.6, 0.6, 0.0]).T
    simulation.assign("velocity", 5.0 * np.column_stack([-y, x, 0 * x]))
    return angular_momentum(simulation)


def angular_momentum(simulation) -> float:
    """Return the angular momentum about the middle of the square [kg m²/s]."""
    x, y, _ = (simulation.field("position") - [0.6, 0.6, 0.0]).T
    u, v, _ = simulation.field("velocity").T
    return float(simulation.field("mass") @ (x * v - y * u))


def radius(simulation) -> float:
    """Return the distance of particles from the middle of the square in the mean [m]."""
    return float(np.linalg.norm(simulation.field("position")[:, :2] - 0.6, axis=1).mean())


WAVE = 36.69  # speed of compression waves in the cube that flies [m/s], ν = 0.3
CROSSINGS = 1000  # times that a wave could cross a cell during its flight


def flight(share: float, count: int = 2, **keys) -> dict:
    """Return the case of a cube of four cells that flies at a `share` of its wave speed.

    `count`: particles along an edge of a cell; `vibrate` makes it vibrate. Nothing acts on it.
    """
    cells = int(share * CROSSINGS) + 8
    return {
        "time": CROSSINGS * CELL / WAVE,
        "mesh": _mesh([cells, 6, 6], FREE),
        "materials": [_elastic(1, SOFT, 0.3)],
        "body": [
            _cuboid(3 * [CELL], 3 * [5 * CELL])
            | {"initial_velocity": [share * WAVE, 0, 0], "particles_per_direction": 3 * [count]}
        ],
    } | keys


def vibrate(simulation) -> float:
    """Make the cube vibrate along its way, by 1/1000 of its wave speed; return `vibration`."""
    x, v = simulation.field("position")[:, 0], simulation.field("velocity").copy()
    v[:, 0] += 1e-3 * WAVE * np.sin(np.pi * (x - x.mean()) / np.ptp(x))
    simulation.assign("velocity", v)
    return vibration(simulation)


def vibration(simulation) -> float:
    """Return the energy of strain and of motion against the centre of mass [J]."""
    return simulation.solver.tally().within


class Heard(Watcher):
    """Notes the energy of the vibration, `at` [J], when the guard tells of energy from nowhere.

    `stops`: whether the run ends then.
    """

    def __init__(self, stops=False):
        self.stops = stops
        self.at = None

    def after_step(self, simulation):
        """Look whether it has been told."""
        if self.at is None and any(map(is_surplus, simulation.messages)):
            self.at = vibration(simulation)
            if self.stops:
                raise StopRun("energy from nowhere")


def is_surplus(message: str) -> bool:
    """Tell whether a message tells of energy from nowhere."""
    return "J more than were put in" in message
