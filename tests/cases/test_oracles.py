"""Particle by particle, results agree with those of the C++ program MPM-Geomechanics."""

from functools import cache
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial import cKDTree

import mpmgeo
from mpmgeo.case.reading.text import read

ORACLES = Path(__file__).parents[2].parent / "shared" / "oracles"
TOLERANCE = {  # of the largest absolute value of a field
    "boussinesq": 1e-3,
    "bouncing_cuboid_musl": 1e-3,
    "external_force": 1e-3,
    "free_fall": 1e-3,
    "initial_velocity": 1e-3,
    "newtonian_column": 1e-3,
    "seismic_column": 1e-3,
    "vibrating_base": 1e-3,
    "slope_kinetic_damping": 1e-3,
    "slope_local_damping": 2e-2,
    "polygon": 1e-3,
    "softening_impact": 1e-3,
    "slope_failure": 1e-2,
}
PLASTIC = ("slope_failure", "undrained_strength")
FIELDS = ("displacement", "velocity", "stress", "plastic_strain")
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
        "stress": law.density * law.sound_speed() ** 2,
        "plastic_strain": 1.0,
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


@pytest.mark.parametrize("field", FIELDS)
@pytest.mark.parametrize("name", PLASTIC)
def test_plastic_flow_agrees(name, field):
    """Equal principal stresses leave single particles of the C++ program to round-off."""
    found, expected, _ = results(name)[field]
    found, expected = (a.reshape(*a.shape[:2], -1) for a in (found, expected))
    largest = np.abs(expected).max()
    error = np.abs(found - expected).max(axis=2) / largest
    assert (error <= 1e-2).mean(axis=1).min() > 0.99
    assert np.abs(found.mean(axis=1) - expected.mean(axis=1)).max() <= 1e-3 * largest


@pytest.mark.parametrize("field", FIELDS)
def test_impact_with_softening_agrees(field):
    """Every particle up to the first yield, then means and kinetic energy."""
    name = "softening_impact"
    found, expected, round_off = results(name)[field]
    plastic = results(name)["plastic_strain"][1].max(axis=1) > 0
    largest = np.abs(expected).max()
    assert plastic.tolist() == [False] * 4 + [True]
    assert np.abs(found - expected)[~plastic].max() <= max(1e-3 * largest, round_off)
    mean = np.abs(found.mean(axis=1) - expected.mean(axis=1))
    assert mean.max() <= 1e-2 * largest
    if field == "velocity":
        energies = [(v**2).sum(axis=(1, 2)) for v in (found, expected)]
        assert energies[0] == pytest.approx(energies[1], rel=1e-2)


def test_stress_is_admissible_without_the_switch():
    """The proper return leaves no stress outside the surface; the old one does."""
    folder = ORACLES / "slope_failure"
    case = read(folder / "case.json") | {"time": 0.02}
    beyond = []
    for keys in ({}, {"compatibility": "mpm-geomechanics"}):
        simulation = mpmgeo.Simulation(mpmgeo.load_case(case | keys)).run()
        law = simulation.case.materials[0].symbols
        stress = simulation.field("stress")[:, [[0, 3, 5], [3, 1, 4], [5, 4, 2]]]
        s = np.linalg.eigvalsh(stress)
        beyond.append((law.N * s[:, 2] - s[:, 0] - law.σc).max() / np.abs(s).max())
    assert beyond[0] < 1e-12
    assert beyond[1] > 1e-3
