"""Particle by particle, a slope with pore pressures agrees with the program MPM-Geomechanics."""

from pathlib import Path

import numpy as np
import pytest
from scipy.spatial import cKDTree

import mpmgeo
from mpmgeo.case.reading.text import read

FOLDER = Path(__file__).parents[2].parent / "shared" / "oracles" / "pore_pressure_slope"

pytestmark = pytest.mark.skipif(not FOLDER.is_dir(), reason="needs ../shared/oracles")


@pytest.fixture(scope="module")
def both():
    """Per field the results of both programs (T, N, …), rows matched."""
    expected = np.load(FOLDER / "expected.npz")
    case = read(FOLDER / "case.json") | {"compatibility": "mpm-geomechanics", "n_threads": 1}
    field = FOLDER / "pore-pressure-3d.json"
    case["hydro_mechanical_coupling"]["pore_pressure_field"] = str(field)
    simulation = mpmgeo.Simulation(mpmgeo.load_case(case))
    distance, row = cKDTree(simulation.field("position")).query(expected["position0"])
    assert distance.max() < 1e-3
    fields = ("pressure", "displacement", "velocity", "stress", "plastic_strain")
    found = {field: [] for field in fields}
    for label in expected["time"]:
        # a label is the time one step before the state that it stands for; the first state has 0
        steps = 0 if label == 0 else round(label / simulation.time_step) + 1
        simulation.step(steps - simulation.steps)
        for field in fields:
            found[field].append(simulation.field(field)[row])
    return {field: (np.array(found[field]), expected[field]) for field in fields}


def error(found, expected):
    """Return the largest component of every particle's error, relative to the largest value."""
    parts = np.abs(found - expected).reshape(*found.shape[:2], -1)
    return parts.max(axis=2) / np.abs(expected).max()


def test_pressures_are_the_same(both):
    assert error(*both["pressure"]).max() < 1e-4


@pytest.mark.parametrize(("field", "most"), [("displacement", 5e-3), ("velocity", 1e-2)])
def test_every_particle_moves_alike(both, field, most):
    errors = error(*both[field])
    assert errors.max() < most
    assert np.quantile(errors, 0.99, axis=1).max() < 6e-3


def test_stresses_agree(both):
    """Yielding in tension with equal lateral stresses, the C++ program takes either of them for the
    largest: what is lost by one is not by the other, and their sum tells."""
    found, expected = both["stress"]
    lateral = error(found[..., :2].sum(axis=2), expected[..., :2].sum(axis=2))
    vertical = error(found[..., 2], expected[..., 2])
    assert np.quantile(lateral, 0.99, axis=1).max() < 1e-2
    assert np.quantile(vertical, 0.99, axis=1).max() < 1e-2
    assert (error(found, expected) < 1e-2).mean(axis=1).min() > 0.95


@pytest.mark.parametrize("field", ["displacement", "velocity", "stress", "plastic_strain"])
def test_means_agree(both, field):
    found, expected = both[field]
    differences = np.abs(found.mean(axis=1) - expected.mean(axis=1))
    assert differences.max() < 1e-3 * np.abs(expected).max()
