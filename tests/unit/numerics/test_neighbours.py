import numpy as np
import pytest
from scipy.spatial import cKDTree

from mpmgeo.numerics import neighbours
from mpmgeo.numerics.neighbours import Neighbours


def found(points, radius, x):
    """Return all pairs (place, point) in the order in which they come."""
    pairs = []
    for place, point, _ in Neighbours(points, radius).pairs(x):
        pairs += zip(place.tolist(), point.tolist(), strict=True)
    return pairs


def expected(points, radius, x):
    near = cKDTree(points).query_ball_point(x, radius)
    return [(p, q) for p, inside in enumerate(near) for q in sorted(inside)]


@pytest.mark.parametrize("radius", [0.01, 0.2, 3.0])
@pytest.mark.parametrize("scale", [(1, 1, 1), (1, 0, 1), (100, 1, 0.01)])
def test_pairs_are_those_of_a_tree(radius, scale):
    random = np.random.default_rng(3)
    points = random.uniform(-1, 1, (200, 3)) * scale
    x = random.uniform(-2, 2, (150, 3)) * scale
    assert found(points, radius, x) == expected(points, radius, x)


def test_pieces_are_put_together(monkeypatch):
    random = np.random.default_rng(4)
    points, x = random.uniform(0, 1, (50, 3)), random.uniform(0, 1, (40, 3))
    whole = found(points, 0.3, x)
    monkeypatch.setattr(neighbours, "PIECE", 7)
    assert found(points, 0.3, x) == whole


def test_distance_must_be_less_than_the_radius():
    points = np.zeros((1, 3))
    x = np.array([[0.5, 0, 0], [0.4999, 0, 0]])
    ((place, _, distance),) = Neighbours(points, 0.5).pairs(x)
    assert place.tolist() == [1]
    assert distance.tolist() == [0.4999]


def test_tiny_radii_and_far_places_are_no_problem():
    points = np.array([[0.0, 0, 0], [1e9, 1e9, 1e9]])
    x = np.array([[1e9, 1e9, 1e9], [-1e30, 0, 1e30], [0, 0, 0]])
    assert found(points, 1e-6, x) == [(0, 1), (2, 0)]
