"""Contact with a terrain as the C++ program MPM-Geomechanics has it, particle by particle."""

from pathlib import Path

import numpy as np
import pytest
from scipy.spatial import cKDTree
from terrains import simulate

from mpmgeo.case.reading.text import read

ORACLES = Path(__file__).parents[2].parent / "shared" / "oracles"
TOLERANCE = 1e-4  # of the largest absolute value of a field; the files have five digits

pytestmark = pytest.mark.skipif(not ORACLES.is_dir(), reason="needs ../shared/oracles")


def of_oracle(name):
    """Return the simulation of an oracle's case, with the files of its folder."""
    folder = ORACLES / name
    case = read(folder / "case.json") | {"compatibility": "mpm-geomechanics"}
    for key, file in (("terrain_contact", "stl_mesh"), ("earthquake", "file")):
        if key in case:
            case[key] |= {file: str(folder / case[key][file])}
    return simulate(case), np.load(folder / "expected.npz")


@pytest.mark.parametrize("name", ["terrain_slide", "seismic_terrain"])
def test_every_particle_agrees(name):
    simulation, expected = of_oracle(name)
    distance, row = cKDTree(simulation.field("position")).query(expected["position0"])
    assert distance.max() < 1e-9
    for state, label in enumerate(expected["time"]):
        # A label is the time one step before the state that it stands for; the first state has 0.
        steps = 0 if label == 0 else round(label / simulation.time_step) + 1
        simulation.step(steps - simulation.steps)
        for field in ("displacement", "velocity", "stress"):
            error = np.abs(simulation.field(field)[row] - expected[field][state])
            assert error.max() <= TOLERANCE * np.abs(expected[field]).max()
