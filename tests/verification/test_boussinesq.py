"""A point force on a cube: the half-space formula near the force, finite elements further away."""

from functools import cache
from pathlib import Path

import numpy as np
import pytest
from box_elements import BoxUnderForce
from scenes import initial_position

import mpmgeo
from mpmgeo.case.reading.text import read
from mpmgeo.verify.convergence import Convergence, relative_error
from mpmgeo.verify.half_space import HalfSpace

CASE = Path(__file__).parents[2] / "inputs" / "boussinesq" / "case.json"
GROUND = HalfSpace(young=200e6, poisson=0.25, force=1.0)
FORCE_AT = np.array([0.5, 0.5, 1.0])
FAR = 3.0  # cells


@cache
def elements():
    return BoxUnderForce(GROUND, side=(1.0, 1.0), depth=1.0, elements=8)


@cache
def settled(cells):
    """Return positions relative to the force and displacements (n, 3) [m] in cells³ cells."""
    # The static state is the same with larger steps.
    case = read(CASE) | {"time": 0.02, "critical_time_step_multiplier": 0.5}
    case["mesh"] |= {"cells_number": 3 * [cells], "cells_dimension": 3 * [1 / cells]}
    simulation = mpmgeo.Simulation(mpmgeo.load_case(case)).run()
    assert simulation.kinetic_energy() < 1e-15  # at its peak 1e-8 J
    return initial_position(simulation) - FORCE_AT, simulation.field("displacement")


def cell_means(cells, values):
    """Return the means (m, 3) over the eight particles of each cell, which follow each other."""
    return values.reshape(cells**3, 8, 3).mean(axis=1)


def far(position, cells):
    return np.linalg.norm(position, axis=1) > FAR / cells


def errors(value, exact):
    """Return the length of the error of every vector (n,)."""
    return np.linalg.norm(value - exact, axis=1)


def test_the_elements_have_converged():
    """Doubling the elements changes the reference solution by less than 0.3 % anywhere."""
    position, _ = settled(10)
    coarse = BoxUnderForce(GROUND, side=(1.0, 1.0), depth=1.0, elements=4)
    fine = elements().displacement(position)
    change = errors(coarse.displacement(position), fine)
    assert change.max() < 0.003 * np.linalg.norm(fine, axis=1).max()


@pytest.mark.parametrize("cells", [10, 20])
def test_settlement_beside_the_force(cells):
    """The four nearest particles settle as in a half-space, within 6 %.

    The displacement there scales with 1/h, as the formula does, so that the difference stays the
    same under refinement: 2.9 % with ten cells, where the walls take 4 % off, 4.9 % with twenty.
    """
    position, u = settled(cells)
    nearest = np.argsort(np.linalg.norm(position, axis=1))[:4]
    exact = GROUND.displacement(position[nearest])
    assert u[nearest, 2] == pytest.approx(exact[:, 2], rel=0.06)


def test_displacement_away_from_the_force():
    """Beyond three cells, at h = 0.05 m, within 5 % of finite elements in each of three norms."""
    cells = 20
    position, u = settled(cells)
    exact = elements().displacement(position)
    beyond = far(position, cells)
    assert relative_error(u[beyond], exact[beyond]) < 0.015
    largest = np.linalg.norm(exact[beyond], axis=1).max()
    assert errors(u[beyond], exact[beyond]).max() < 0.05 * largest
    centre, mean, exact_mean = (cell_means(cells, values) for values in (position, u, exact))
    beyond = far(centre, cells)
    relative = errors(mean, exact_mean) / np.linalg.norm(exact_mean, axis=1)
    assert relative[beyond].max() < 0.05


def test_displacement_converges_away_from_the_force():
    """Where all meshes are more than three cells away, the error falls with order two."""
    cells = np.array([10, 14, 20])
    found = []
    for n in cells:
        position, u = settled(n)
        beyond = np.linalg.norm(position, axis=1) > FAR / cells[0]
        found.append(relative_error(u[beyond], elements().displacement(position[beyond])))
    study = Convergence(1 / cells, np.array(found))
    assert study.order > 1.8, study
    assert study.error[-1] < 0.006, study
