"""Every case in inputs/ runs and gives the numbers that it expects."""

from pathlib import Path

import pytest

import mpmgeo
from mpmgeo.verify.expected import compare

INPUTS = sorted((Path(__file__).parents[2] / "inputs").glob("*/case.json"))
LONG = {"column_collapse"}  # compared in a test of its own, which looks at more than these numbers
SHORT = [path for path in INPUTS if path.parent.name not in LONG]


@pytest.mark.parametrize("path", SHORT, ids=lambda path: path.parent.name)
def test_case_gives_what_it_expects(path):
    case = mpmgeo.load_case(path, strict=True)
    simulation = mpmgeo.Simulation(case)
    comparisons = compare(simulation, case)
    assert comparisons
    for comparison in comparisons:
        assert comparison.agrees, str(comparison)
    assert simulation.field("active").all()
