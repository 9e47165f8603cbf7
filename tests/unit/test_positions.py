"""What doubles resolve of positions, and how messages show them."""

import numpy as np
import pytest

from mpmgeo.positions import mean_edge, resolution, shown


def test_resolution_is_that_of_the_largest_coordinate_that_users_write():
    found = resolution((500_000.0, 0.0, -8.0), (1.0, 3.0, 7.0), [(-2.0, 5.0, 1.0), (0, 0, 0)])
    assert found.tolist() == (4 * np.spacing([500_001.0, 5.0, 8.0])).tolist()


@pytest.mark.parametrize(
    ("position", "zero", "text"),
    [
        ((0.125, -2.5, 1e-7), (0, 0, 0), "(0.125, -2.5, 1e-07) m"),
        ((0.123456789, 12.3456789, 999.123456), (0, 0, 0), "(0.123457, 12.3457, 999.123) m"),
        ((0.25, 0.3, 1.0), (500_000.0, 4_500_000.0, 0.0), "(500000.25, 4500000.3, 1) m"),
        ((0.12345, np.nan, np.inf), (4_500_000.0, 0, 0), "(4500000.123, nan, inf) m"),
        ((1e300, -1e12, 0.0), (0, 0, 0), "(1e+300, -1e+12, 0) m"),
    ],
)
def test_messages_show_millimetres_of_large_coordinates(position, zero, text):
    assert shown(position, zero) == text


def test_points_show_their_unit():
    assert shown([0.5, 1, 2e-9]) == "(0.5, 1, 2e-09) m"


def test_few_digits_of_small_ones():
    assert shown((0.123456, 9.87654, 123.456), digits=4) == "(0.1235, 9.877, 123.456) m"


@pytest.mark.parametrize("edge", [0.1, 0.3, 0.7, 1.1, 1 / 3])
def test_the_mean_edge_of_a_cube_is_its_edge(edge):
    assert mean_edge(3 * [edge]) == edge
    assert mean_edge([edge, edge, 4 * edge]) == pytest.approx(2 * edge)
