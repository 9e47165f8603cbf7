"""Positions agree, row by row, with those of the C++ program."""

import json
from pathlib import Path

import numpy as np
import pytest

from mpmgeo.bodies import BODIES
from mpmgeo.bodies.body import Filled

ORACLES = Path(__file__).parents[3].parent / "shared" / "oracles"
TYPES = {body.type: body for body in BODIES}
CASES = [
    "all_bodies",
    "bouncing_cuboid_musl",
    "boussinesq",
    "external_force",
    "free_fall",
    "initial_velocity",
    "newtonian_column",
    "polygon",
    "pore_pressure_slope",
    "seismic_column",
    "seismic_terrain",
    "slope_failure",
    "slope_kinetic_damping",
    "slope_local_damping",
    "softening_impact",
    "terrain_slide",
    "undrained_strength",
    "vibrating_base",
]


def tuples(value):
    return tuple(map(tuples, value)) if isinstance(value, list) else value


@pytest.mark.parametrize("case", CASES)
def test_positions_are_those_of_the_cpp_program(case):
    folder = ORACLES / case
    if not folder.exists():
        pytest.skip("no oracles here")
    inputs = json.loads((folder / "case.json").read_text())
    expected = np.load(folder / "expected.npz")["position0"]
    bodies = inputs["body"]
    if isinstance(bodies, dict):
        bodies = [bodies[name] for name in sorted(bodies)]
    cell = np.array(inputs["mesh"]["cells_dimension"], dtype=float)

    clouds = []
    for body in bodies:
        if not issubclass(TYPES[body["type"]], Filled):
            break
        keys = {key: tuples(value) for key, value in body.items() if key not in ("type", "id")}
        clouds.append(TYPES[body["type"]](**keys).generate(cell))
    position = np.concatenate([cloud.position for cloud in clouds])

    if len(clouds) == len(bodies):
        assert len(position) == len(expected)
    np.testing.assert_allclose(position, expected[: len(position)], rtol=5e-5, atol=1e-12)
