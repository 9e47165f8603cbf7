"""Every kind of element: shape functions, quadrature, which points lie inside."""

from math import factorial

import numpy as np
import pytest

from mpmgeo.bodies.elements import ELEMENTS

KIND = pytest.mark.parametrize("kind", ELEMENTS)


def warped(kind, seed=0):
    """Return three elements of a kind whose nodes are a little out of place, (3, k, 3)."""
    nodes = ELEMENTS[kind].nodes * [1.0, 2.0, 0.5]
    return nodes + np.random.default_rng(seed).uniform(-0.04, 0.04, (3, *nodes.shape))


def inner(kind, count, seed=1):
    """Return points (count, 3) inside the reference element."""
    points = np.random.default_rng(seed).uniform(-0.95, 0.95, (count, 3))
    if kind.startswith("tetra"):
        points = np.abs(points)
        points /= np.maximum(points.sum(axis=1, keepdims=True) * 1.05, 1)
    return points


@KIND
def test_shape_functions_are_one_at_their_node_and_sum_to_one(kind):
    element = ELEMENTS[kind]
    np.testing.assert_allclose(element.shape(element.nodes), np.eye(len(element.nodes)), atol=1e-14)
    np.testing.assert_allclose(element.shape(inner(kind, 20)).sum(axis=1), 1, rtol=1e-13)


@KIND
def test_slopes_are_the_differences_of_the_shape_functions(kind):
    element, points, step = ELEMENTS[kind], inner(kind, 10), 1e-5
    for axis in range(3):
        shift = step * np.eye(3)[axis]
        slope = (element.shape(points + shift) - element.shape(points - shift)) / (2 * step)
        np.testing.assert_allclose(element.slopes(points)[:, axis], slope, atol=1e-9)


def monomial(kind, a, b, c):
    """Return the integral of x^a y^b z^c over the reference element."""
    if kind.startswith("tetra"):
        return factorial(a) * factorial(b) * factorial(c) / factorial(a + b + c + 3)
    return np.prod([(1 - (-1) ** (n + 1)) / (n + 1) for n in (a, b, c)])


@KIND
def test_volume_rule_is_exact_for_the_jacobian(kind):
    """Its degree is that of a product of three slopes."""
    element = ELEMENTS[kind]
    degree = element.exponents.max()
    if kind.startswith("tetra"):
        powers = [e for e in np.ndindex(4, 4, 4) if sum(e) <= 3 * (degree - 1)]
    else:
        powers = list(np.ndindex(*3 * [3 * degree]))
    points, weights = element.volume_rule
    for e in powers:
        found = (weights * np.prod(points**e, axis=1)).sum()
        assert found == pytest.approx(monomial(kind, *e), abs=1e-14)


@KIND
def test_volume_scales_with_the_determinant_of_a_linear_map(kind):
    element = ELEMENTS[kind]
    turn = np.array([[2.0, 0.3, 0.0], [0.1, 1.0, 0.2], [0.0, -0.4, 0.5]])
    nodes = (element.nodes @ turn.T)[None] + [5.0, -3.0, 1.0]
    reference = 1 / 6 if kind.startswith("tetra") else 8.0
    volume = element.shares(nodes, element.volume_rule).sum()
    assert volume == pytest.approx(reference * np.linalg.det(turn), rel=1e-13)


@KIND
def test_points_are_told_to_lie_inside_or_outside(kind):
    element, nodes, every = ELEMENTS[kind], warped(kind), np.arange(3)
    for ξ in inner(kind, 20):
        assert element.contains(nodes, every, element.points(nodes, ξ[None])[:, 0]).all()
    for ξ in ([1.2, 0.1, 0.1], [0.1, -1.2, 0.1], [0.4, 0.3, 1.1]):
        assert not element.contains(nodes, every, element.points(nodes, np.array([ξ]))[:, 0]).any()
    assert not element.contains(nodes, every, np.full((3, 3), 50.0)).any()
    assert element.contains(nodes, every, nodes[:, 0]).all()
    assert element.contains(nodes, every[::-1], nodes[::-1, 1]).all()


@KIND
def test_gauss_points_are_inside_one_near_each_corner(kind):
    element = ELEMENTS[kind]
    points, weights = element.gauss_rule
    corners = element.nodes[: len(points)]
    distance = np.linalg.norm(points[:, None] - corners, axis=-1)
    assert (distance.argmin(axis=1) == np.arange(len(points))).all()
    assert element.contains(element.nodes[None], np.zeros(len(points), int), points).all()
    assert weights.sum() == pytest.approx(element.volume_rule.weights.sum())
