"""A bar, fixed at x = 0 and free at the other end, that a force along it loads at once.

With σ = E ln(1 + ∂u/∂X), as the elastic law gives it without lateral strain (ν = 0),

    ∂²u/∂t² = c² ∂/∂X ln(1 + ∂u/∂X) + g,   c² = E/ρ,   u = 0 at X = 0,  σ = 0 at X = l.

At rest g = s c²/l would strain the fixed end by about s; the bar swings by twice as much, so that
particles cross cells. The reference is a leapfrog with many linear elements.
"""

from functools import cache

import numpy as np

import mpmgeo

LENGTH, YOUNG, DENSITY = 1.0, 1e5, 1e3
WAVE = (YOUNG / DENSITY) ** 0.5
PASSAGES = 2.0  # times that a wave runs along the bar
ELEMENTS = 512
SAMPLES = 40  # at least, of a run


def case(cells: int, strain: float, **keys) -> dict:
    """Return the case of the bar in `cells` cells of two particles, a quarter of the step."""
    h, time = LENGTH / cells, PASSAGES * LENGTH / WAVE
    steps = round(4 * PASSAGES * cells)
    planes = {"plane_X0": "fixed", "plane_Xn": "free"}
    planes |= dict.fromkeys(["plane_Y0", "plane_Yn", "plane_Z0", "plane_Zn"], "sliding")
    law = {"type": "elastic", "id": 1, "density": DENSITY, "young": YOUNG, "poisson": 0.0}
    body = {"type": "cuboid", "point_p1": [0, 0, 0], "point_p2": [LENGTH, h, h], "material_id": 1}
    return {
        "time": time,
        "time_step": time / steps,
        "gravity": [strain * WAVE**2 / LENGTH, 0, 0],
        "mesh": {
            "cells_number": [cells + int(1.5 * cells * strain) + 4, 1, 1],
            "cells_dimension": 3 * [h],
            "boundary_conditions": planes,
        },
        "materials": [law],
        "body": [body | {"particles_per_direction": [2, 1, 1]}],
    } | keys


@cache
def _reference(strain):
    """Return times (n,) [s] and nodal velocities (n, nodes) [m/s] of the reference."""
    h, g = LENGTH / ELEMENTS, strain * WAVE**2 / LENGTH
    dt, mass = 0.5 * h / WAVE, np.full(ELEMENTS + 1, h)
    mass[-1] /= 2
    u, v, found = np.zeros(ELEMENTS + 1), np.zeros(ELEMENTS + 1), []
    for step in range(round(2.1 * PASSAGES * ELEMENTS)):
        force = np.append(WAVE**2 * np.log1p(np.diff(u) / h), 0.0)  # per area and density
        a = np.diff(force, prepend=0.0) / mass + g
        a[0] = 0.0
        v = v + (dt if step else dt / 2) * a
        u = u + dt * v
        found.append(v)
    return (np.arange(len(found)) + 0.5) * dt, np.array(found)


def velocity(x: np.ndarray, time: float, strain: float) -> np.ndarray:
    """Return the velocities (n,) [m/s] of points that were at x (n,) [m] at the start."""
    times, found = _reference(strain)
    k = int(np.clip(np.searchsorted(times, time), 1, len(times) - 1))
    share = (time - times[k - 1]) / (times[k] - times[k - 1])
    at_nodes = (1 - share) * found[k - 1] + share * found[k]
    return np.interp(x, np.linspace(0.0, LENGTH, ELEMENTS + 1), at_nodes)


def error(cells: int, strain: float, **keys) -> float:
    """Return the error of the velocities over the run, relative to them, both root mean squares."""
    simulation = mpmgeo.Simulation(case(cells, strain, **keys), threads=1)
    x = simulation.field("position")[:, 0].copy()
    steps = round(simulation.case.time / simulation.time_step)
    every = max(1, steps // SAMPLES)
    differences, sizes = [], []
    for _ in range(steps // every):
        simulation.step(every)
        exact = velocity(x, simulation.time - simulation.time_step / 2, strain)
        differences.append(simulation.field("velocity")[:, 0] - exact)
        sizes.append(exact)
    return float(np.sqrt(np.mean(np.square(differences)) / np.mean(np.square(sizes))))
