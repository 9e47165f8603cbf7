"""Bodies from lists, files and meshes are those of the C++ program, row by row."""

from functools import cache
from pathlib import Path

import numpy as np
import pytest

import mpmgeo

ORACLES = Path(__file__).parents[2].parent / "shared" / "oracles"
CASES = ("all_bodies", "particle_file")
PRINTED = 5e-5  # five digits

pytestmark = pytest.mark.skipif(not ORACLES.is_dir(), reason="needs ../shared/oracles")


@cache
def simulation(name):
    return mpmgeo.Simulation(mpmgeo.load_case(ORACLES / name / "case.json"))


@pytest.mark.parametrize("name", CASES)
def test_positions_and_materials_in_row_order(name):
    expected = np.load(ORACLES / name / "expected.npz")
    made = simulation(name)
    np.testing.assert_allclose(made.field("position"), expected["position0"], rtol=PRINTED)
    np.testing.assert_array_equal(made.field("material"), expected["material"][0])


def test_bodies_are_numbered_group_by_group():
    """Two groups of the mesh become bodies 6 and 7, in alphabetical order of their names."""
    counts = np.bincount(simulation("all_bodies").field("body"))
    assert counts.tolist() == [0, 224, 160, 112, 3, 3, 111, 1342]


def test_listed_particles_are_created_first():
    made = simulation("all_bodies")
    body, number = made.field("body"), made.field("id")
    assert number[(body == 4) | (body == 5)].tolist() == [0, 1, 2, 3, 4, 5]
    others = number[(body != 4) & (body != 5)]
    np.testing.assert_array_equal(others, np.arange(6, len(body)))


def test_mass_is_that_of_the_elements():
    """The mesh is a box of 2 × 2 × 4 m, which the C++ program weighs right with one point only."""
    made = simulation("all_bodies")
    mass = made.field("mass")[made.field("body") > 5].sum()
    assert mass == pytest.approx(2600 * 16.0, rel=1e-6)
