"""Inputs of every kind for which use found that results differed from MPM-Geomechanics."""

from functools import cache
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial import cKDTree

import mpmgeo
from mpmgeo.case.reading.text import read

FAILING = Path(__file__).parents[2].parent / "shared" / "failing"
NAMES = (
    "seismic_usl_edges",
    "mc_noise",
    "output_interval_automatic_step",
    "ignored_alias_time_step_multiplier",
    "terrain_ridge_tie",
)
FIELDS = ("displacement", "velocity", "stress", "plastic_strain")
TOLERANCE = 1e-4  # of the largest absolute value of a field; the files have five digits
FILES = (("terrain_contact", "stl_mesh"), ("earthquake", "file"))

pytestmark = pytest.mark.skipif(not FAILING.is_dir(), reason="needs ../shared/failing")


def case_of(name):
    folder = FAILING / name
    case = read(folder / "case.json") | {"compatibility": "mpm-geomechanics"}
    for key, file in FILES:
        if key in case:
            case[key] |= {file: str(folder / case[key][file])}
    return case


@cache
def results(name):
    """Return the labels of both programs (T,), and per field their results (T, N, …), matched."""
    expected = np.load(FAILING / name / "expected.npz")
    simulation = mpmgeo.Simulation(mpmgeo.load_case(case_of(name)))
    position = simulation.field("position")
    distance, row = cKDTree(position).query(expected["position0"])
    assert distance.max() < 1e-4 * np.ptp(position, axis=0).max()
    assert len(set(row)) == len(distance)
    found = {field: [] for field in ("time", *FIELDS)}
    for state in range(len(expected["time"])):
        simulation.step(state * simulation.output_interval - simulation.steps)
        found["time"].append(simulation.label)
        for field in FIELDS:
            found[field].append(simulation.field(field)[row])
    return {field: (np.array(values), expected[field]) for field, values in found.items()}


@pytest.mark.parametrize("name", NAMES)
def test_outputs_are_at_the_same_times(name):
    found, expected = results(name)["time"]
    assert found == pytest.approx(expected, rel=1e-5)


@pytest.mark.parametrize("field", FIELDS)
@pytest.mark.parametrize("name", NAMES)
def test_every_particle_agrees(name, field):
    found, expected = results(name)[field]
    assert np.abs(found - expected).max() <= TOLERANCE * np.abs(expected).max()
