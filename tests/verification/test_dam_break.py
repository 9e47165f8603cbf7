"""A collapsing column of water: how front and height are measured, and what finer cells give."""

import runpy
from pathlib import Path

import numpy as np
import pytest

from mpmgeo.verify.dam_break import CAPILLARY_LENGTH, DamBreak, delay, difference

EXAMPLE = Path(__file__).parents[2] / "examples" / "06_dam_break.py"
PROBLEM = DamBreak(width=0.05715, slenderness=2.0, gravity=9.81)
H = PROBLEM.width / 32


def water(depth):
    """Return positions and areas of particles, four to a cell, below a depth as function of x."""
    x, z = np.meshgrid(H / 4 + np.arange(640) * H / 2, H / 4 + np.arange(128) * H / 2)
    below = z < depth(x)
    position = np.stack([x[below], 0 * x[below], z[below]], axis=1)
    return position, np.full(len(position), H**2 / 4)


def test_column_at_rest():
    column = water(lambda x: np.where(x < PROBLEM.width, 2 * PROBLEM.width, 0))
    assert PROBLEM.front(*column) == pytest.approx(1.0, abs=1 / 32)
    assert PROBLEM.height(*column) == pytest.approx(1.0, rel=1e-12)


def test_front_of_a_wedge():
    """Where the wedge is a capillary length deep, to half a strip."""
    wedge = water(lambda x: 0.03 - 0.15 * x)
    expected = (0.03 - CAPILLARY_LENGTH) / 0.15 / PROBLEM.width
    assert PROBLEM.front(*wedge) == pytest.approx(expected, abs=1 / 32)


def test_drops_ahead_are_no_front():
    position, area = water(lambda x: np.where(x < 0.1, 0.01, 0))
    front = PROBLEM.front(position, area)
    position = np.append(position, [[0.3, 0, 0.01], [0.4, 0, 0.001]], axis=0)
    area = np.append(area, area[:2])
    assert PROBLEM.front(position, area) == front


def test_differences():
    curve = np.array([[0.0, 1.0], [1.0, 3.0]])
    measured = np.array([[0.5, 1.5], [0.75, 2.0]])
    assert difference(curve, measured) == pytest.approx([0.5, 0.5])
    assert delay(curve, measured) == pytest.approx([0.25, 0.25])


@pytest.mark.slow
def test_finer_cells():
    """At a/32 the same front as at a/16, ahead of the experiment by the opening of the gate."""
    example = runpy.run_path(str(EXAMPLE))
    found = example["compare"](example["collapse"]("fixed", cells=32))
    assert 0.05 < found["ahead"].mean() < 0.10
    assert found["ahead"].max() < 0.16
    assert found["late"][1:].std() < 0.04
    assert np.abs(found["off"]).max() < 0.03
