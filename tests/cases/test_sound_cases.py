"""Nothing is said against a case that is sound: those that ship, and those of the C++ program."""

from pathlib import Path

import pytest

import mpmgeo
from mpmgeo.case.building.lint import lint

ROOT = Path(__file__).parents[2]
ORACLES = ROOT.parent / "shared" / "oracles"
CASES = sorted([*(ROOT / "inputs").glob("*/case.json"), *ORACLES.glob("*/case.json")])

LOCKING = ("undrained_strength",)
"""Cases that flow without dilation in cells of several particles, of a program without a cure."""


@pytest.mark.parametrize("path", CASES, ids=lambda path: "-".join(path.parts[-3:-1]))
def test_a_sound_case_is_not_warned_of(path):
    case = mpmgeo.load_case(path)
    warnings = [*case.warnings, *lint(mpmgeo.Simulation(case))]
    if path.parent.name in LOCKING:
        assert '"volumetric_locking": "cells" mends it' in warnings.pop()
    assert warnings == []
