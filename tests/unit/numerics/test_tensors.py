"""Principal values against LAPACK, above all where they are nearly equal."""

import numpy as np
import pytest
from numba import njit
from scipy.stats import ortho_group

from mpmgeo.numerics.tensors import invariants, on_same_axes, principal

FULL = np.array([[0, 3, 5], [3, 1, 4], [5, 4, 2]])
SIX = ([0, 1, 2, 0, 1, 0], [0, 1, 2, 1, 2, 2])


@njit
def values_and_same(a):
    """Return the principal values of tensors (n, 6), and the tensors put together again."""
    values, same = np.empty((len(a), 3)), np.empty(a.shape)
    for p in range(len(a)):
        frame = principal((a[p, 0], a[p, 1], a[p, 2], a[p, 3], a[p, 4], a[p, 5]))
        again = on_same_axes(frame, frame[0], frame[1], frame[2])
        for i in range(3):
            values[p, i] = frame[i]
        for i in range(6):
            same[p, i] = again[i]
    return values, same


@njit
def mapped(a, low, middle, high):
    """Return the tensor with other principal values."""
    return on_same_axes(principal((a[0], a[1], a[2], a[3], a[4], a[5])), low, middle, high)


def tensors(values, seed=0):
    """Return tensors (n, 6) of principal values (n, 3), in random directions."""
    Q = ortho_group.rvs(3, size=len(values), random_state=seed)
    full = np.einsum("nij,nj,nkj->nik", Q, values, Q)
    return full[:, SIX[0], SIX[1]]


def assert_exact(a, accuracy=1e-14):
    """LAPACK's values are good to about 1e-15 of the largest."""
    expected = np.linalg.eigvalsh(a[:, FULL])
    size = np.abs(expected).max(axis=1, keepdims=True)
    values, same = values_and_same(a)
    assert (np.diff(values, axis=1) >= 0).all()
    assert (np.abs(values - expected) <= accuracy * size).all()
    assert (np.abs(same - a) <= accuracy * size).all()


def test_random():
    assert_exact(np.random.default_rng(1).normal(size=(200_000, 6)))


@pytest.mark.parametrize("gap", [10.0**-n for n in range(18)] + [0.0])
@pytest.mark.parametrize("pair", ["lower", "upper", "all"])
def test_nearly_equal(gap, pair):
    """The trigonometric formula would lose half the digits here."""
    random = np.random.default_rng(2)
    far = random.normal(size=2000)
    near = far + random.uniform(1, 3, 2000) * {"lower": 1, "upper": -1, "all": gap}[pair]
    values = np.stack([near, far, far + gap * random.uniform(-1, 1, 2000)], axis=1)
    assert_exact(tensors(values))


@pytest.mark.parametrize("scale", [1e-100, 1e-30, 1e30, 1e100])
def test_scales(scale):
    assert_exact(scale * np.random.default_rng(3).normal(size=(1000, 6)))


def test_large_mean():
    """Accurate to round-off of the largest value, even where the others are far smaller."""
    assert_exact(np.random.default_rng(4).normal(size=(1000, 6)) + [1e9, 1e9, 1e9, 0, 0, 0])


@pytest.mark.parametrize(
    "a",
    [
        (0, 0, 0, 0, 0, 0),
        (2, 2, 2, 0, 0, 0),
        (-3, -1, -1, 0, 0, 0),
        (-1, -1, -3, 0, 0, 0),
        (0, 0, 0, 1, 0, 0),
        (0, 0, 0, 1, 1, 1),
        (0, 0, 0, -1, -1, -1),
        (1, 2, 3, 0, 0, 0),
        (1e-140, 0, 0, 0, 0, 1e-140),
    ],
)
def test_special(a):
    assert_exact(np.array([a], float))


def test_nan_comes_out():
    values, _ = values_and_same(np.full((1, 6), np.nan))
    assert np.isnan(values).all()


def test_other_values_on_the_same_axes():
    random = np.random.default_rng(5)
    values = random.uniform(-1, 1, size=(500, 3)) + [-3, 0, 3]
    Q = ortho_group.rvs(3, size=500, random_state=6)
    for q, (s1, s2, s3) in zip(Q, values, strict=True):
        a, b = ((q * v @ q.T)[SIX] for v in ([s1, s2, s3], [3 * s1, s2 - 1, s3 + 5]))
        assert np.array(mapped(a, 3 * s1, s2 - 1, s3 + 5)) == pytest.approx(b, abs=1e-12)


def test_axes_of_equal_values_do_not_matter():
    """What round-off makes of equal values changes the result by round-off only."""
    a = np.array([-3.0, -1.0, -1.0, 0.0, 0.0, 0.0])
    random = np.random.default_rng(7)
    plain = np.array(mapped(a, -2.5, -1.5, -1.5))
    for _ in range(1000):
        noisy = a + 1e-15 * random.normal(size=6)
        assert np.array(mapped(noisy, -2.5, -1.5, -1.5)) == pytest.approx(plain, abs=1e-14)


def test_invariants():
    @njit
    def both(a):
        return invariants((a[0], a[1], a[2], a[3], a[4], a[5]))

    a = np.array([1.0, -2.0, 4.0, 0.5, -1.5, 2.5])
    d = a[FULL] - np.eye(3)
    m, s = both(a)
    assert m == pytest.approx(1.0)
    assert 3 * s**2 == pytest.approx(np.sum(d * d) / 2)
