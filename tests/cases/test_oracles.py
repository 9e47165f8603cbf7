"""Particle by particle, results agree with those of the C++ program MPM-Geomechanics."""

from functools import cache
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial import cKDTree

import mpmgeo
from mpmgeo.case.text import read

ORACLES = Path(__file__).parents[2].parent / "shared" / "oracles"
TOLERANCE = {  # of the largest absolute value of a field
    "boussinesq": 1e-3,
    "bouncing_cuboid_musl": 1e-3,
    "external_force": 1e-3,
    "initial_velocity": 1e-3,
    "seismic_column": 1e-3,
    "vibrating_base": 1e-3,
    "slope_kinetic_damping": 1e-3,
    "slope_local_damping": 2e-2,
}
FIELDS = ("displacement", "velocity", "stress")
ROUND_OFF = 1e-9  # relative to Young's modulus, the size of the body, the speed of a wave

pytestmark = pytest.mark.skipif(not ORACLES.is_dir(), reason="needs ../shared/oracles")


@cache
def results(name):
    """Return per field the results of both programs (T, N, c), matched, and what is round-off."""
    folder = ORACLES / name
    expected = np.load(folder / "expected.npz")
    case = mpmgeo.load_case(read(folder / "case.json") | _same(folder))
    simulation = mpmgeo.Simulation(case)
    position = simulation.field("position")
    distance, row = cKDTree(position).query(expected["position0"])
    assert distance.max() < 1e-4 * np.ptp(position, axis=0).max()
    assert len(set(row)) == len(position)
    found = {field: [] for field in FIELDS}
    for label in expected["time"]:
        # A label is the time one step before the state that it stands for; the first state has 0.
        steps = 0 if label == 0 else round(label / simulation.time_step) + 1
        simulation.step(steps - simulation.steps)
        for field in FIELDS:
            found[field].append(simulation.field(field)[row])
    law = case.materials[0]
    scale = {
        "displacement": np.ptp(position, axis=0).max(),
        "velocity": law.sound_speed(),
        "stress": law.young,
    }
    return {
        field: (np.array(found[field]), expected[field], ROUND_OFF * scale[field])
        for field in FIELDS
    }


def _same(folder):
    """Return the keys that make the run comparable: old behaviour, and files of the oracle."""
    case = read(folder / "case.json")
    keys = {"compatibility": "mpm-geomechanics"}
    if "earthquake" in case:
        file = str(folder / case["earthquake"]["file"])
        keys["earthquake"] = case["earthquake"] | {"file": file}
    return keys


@pytest.mark.parametrize("field", FIELDS)
@pytest.mark.parametrize("name", TOLERANCE)
def test_every_particle_agrees(name, field):
    found, expected, round_off = results(name)[field]
    largest = np.abs(expected).max()
    if largest < round_off:
        assert np.abs(found).max() < round_off
    else:
        assert np.abs(found - expected).max() <= TOLERANCE[name] * largest
