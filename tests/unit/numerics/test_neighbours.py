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
    monkeypatch.setattr(neighbours, "PAIRS", 5)
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


@pytest.mark.parametrize("far", [1e4, 1e9, 1e15, 1e30, 1e100])
def test_a_stray_point_or_place_changes_nothing(far):
    random = np.random.default_rng(5)
    points, x = random.uniform(0, 1, (300, 3)), random.uniform(0, 1, (200, 3))
    near, stray = expected(points, 0.1, x), np.array([[far, -far, far]])
    assert found(np.append(points, stray, axis=0), 0.1, np.append(x, -stray, axis=0)) == near
    both = found(np.append(points, stray, axis=0), 0.1, np.append(x, stray, axis=0))
    assert both == [*near, (200, 300)]


def test_a_stray_point_costs_nothing():
    """Once all points came into one cell: 4·10⁸ pairs, 47 s and 6 GB."""
    random = np.random.default_rng(6)
    points = random.uniform(0, 100, (20_000, 3))
    x = random.uniform(0, 100, (20_000, 3))
    points[-1] = 1e12
    near = Neighbours(points, 0.5)
    assert len(near._keys) > 15_000
    assert len(near._around(near._cells(x))[0]) < 10 * len(x)


def test_memory_is_limited_where_all_points_are_near():
    """Pairs come in pieces, however many each place has."""
    points = np.random.default_rng(7).uniform(0, 1, (3000, 3))
    sizes = [len(place) for place, _, _ in Neighbours(points, 10.0).pairs(points)]
    assert sum(sizes) == 3000**2 and max(sizes) <= neighbours.PAIRS and len(sizes) > 2
