import json

import numpy as np
import pytest
from scipy.spatial import cKDTree

from mpmgeo.loads import HydroMechanicalCoupling

RANDOM = np.random.default_rng(5)


@pytest.fixture
def coupling(tmp_path):
    """A function that makes a coupling of points with pressures."""

    def make(position, pressure, **keys):
        file = tmp_path / "pressures.json"
        pairs = zip(position, pressure, strict=True)
        file.write_text(json.dumps([{"position": list(x), "pressure": p} for x, p in pairs]))
        return HydroMechanicalCoupling(enabled=True, pore_pressure_field=file, **keys)

    return make


def test_nearest_point_within_half_a_cell(coupling):
    points, x = RANDOM.uniform(0, 3, (400, 3)), RANDOM.uniform(-1, 4, (300, 3))
    found = coupling(points.tolist(), range(400)).pressures(x, cell=0.6)
    distance, nearest = cKDTree(points).query(x)
    np.testing.assert_array_equal(found.known, distance < 0.3)
    np.testing.assert_array_equal(found.pressure, np.where(distance < 0.3, nearest, 0.0))
    near, _ = cKDTree(x).query(points)
    np.testing.assert_array_equal(found.matched, near < 0.3)


def test_last_point_of_the_file_counts_for_comparison(coupling):
    points = [[0, 0, 0], [0.1, 0, 0], [0.3, 0, 0], [9, 9, 9]]
    given = coupling(points, [1, 2, 3, 4])
    x = np.array([[0.0, 0, 0]])
    assert given.pressures(x, cell=1).pressure == [1]
    assert given.pressures(x, cell=1, last=True).pressure == [3]


def test_of_equally_near_points_the_last_one_counts(coupling):
    given = coupling([[1, 0, 0], [-1, 0, 0], [0, 1, 0]], [1, 2, 3])
    assert given.pressures(np.zeros((1, 3)), cell=3).pressure == [3]


def test_linear_fields_are_reproduced_between_points(coupling):
    grid = np.stack(np.meshgrid(*[np.arange(5.0)] * 3, indexing="ij"), -1).reshape(-1, 3)
    x = RANDOM.uniform(0, 4, (100, 3))
    field = lambda at: 9810 * (4 - at[:, 2]) + 20 * at[:, 0]  # noqa: E731
    given = coupling(grid.tolist(), field(grid).tolist(), interpolation="linear")
    found = given.pressures(x, cell=1)
    assert found.known.all()
    assert found.matched.all()
    np.testing.assert_allclose(found.pressure, field(x), rtol=1e-10)


def test_linear_stays_within_the_values_of_its_points(coupling):
    given = coupling([[0, 0, 0], [1, 0, 0]], [10, 20], interpolation="linear", radius=5.0)
    x = np.array([[-3.0, 0, 0], [0.5, 2, 0], [4.0, 0, 0]])
    assert given.pressures(x, cell=1).pressure == pytest.approx([10, 15, 20])


def test_radius_is_what_is_said(coupling):
    given = coupling([[0, 0, 0]], [7], radius=2.0)
    x = np.array([[1.9, 0, 0], [2.0, 0, 0]])
    assert given.pressures(x, cell=0.1).known.tolist() == [True, False]


def test_thousands_of_points(coupling):
    """No all-pairs search: 40,000 points and 60,000 particles in a moment."""
    points, x = RANDOM.uniform(0, 10, (40_000, 3)), RANDOM.uniform(0, 10, (60_000, 3))
    found = coupling(points.tolist(), range(40_000)).pressures(x, cell=0.5)
    distance, nearest = cKDTree(points).query(x)
    np.testing.assert_array_equal(found.pressure, np.where(distance < 0.25, nearest, 0.0))
