import numpy as np
import pytest

from mpmgeo.numerics.fit import linear_fit

RANDOM = np.random.default_rng(8)


def around(x, count=20):
    """Return neighbours (k, 3) of places x, which place they belong to, and weights."""
    group = np.repeat(np.arange(len(x)), count)
    y = x[group] + RANDOM.uniform(-1, 1, (len(group), 3))
    return y, group, RANDOM.uniform(0.1, 1, len(group))


def test_linear_fields_are_reproduced():
    x = RANDOM.uniform(-5, 5, (30, 3))
    y, group, w = around(x)
    field = lambda at: np.column_stack([at @ [1, -2, 3] + 4, at @ [0, 5, 0] - 1])  # noqa: E731
    fit = linear_fit(x, group, y, w, field(y))
    np.testing.assert_allclose(fit, field(x), rtol=1e-11, atol=1e-11)


def test_plane_clouds_are_continued_across_their_plane():
    x = np.array([[0.2, 0.3, 7.0]])
    y = np.column_stack([RANDOM.uniform(-1, 1, (9, 2)), np.zeros(9)])
    f = 2 * y[:, 0] - y[:, 1]
    fit = linear_fit(x, np.zeros(9, int), y, np.ones(9), f)
    assert fit == pytest.approx([0.4 - 0.3])


def test_one_neighbour_gives_its_value_and_none_gives_nan():
    x = np.zeros((2, 3))
    fit = linear_fit(x, np.zeros(1, int), np.ones((1, 3)), np.ones(1), np.array([[3.0, 4.0]]))
    assert fit[0].tolist() == [3, 4]
    assert np.isnan(fit[1]).all()


def test_nothing_at_all():
    fit = linear_fit(np.zeros((2, 3)), np.empty(0, int), np.empty((0, 3)), np.empty(0), np.empty(0))
    assert np.isnan(fit).all()
