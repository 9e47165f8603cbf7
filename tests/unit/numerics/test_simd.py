"""Every vector instruction against numpy."""

import numba
import numpy as np
import pytest
from numba import njit

from mpmgeo.numerics import simd
from mpmgeo.numerics.simd import (
    add,
    aligned,
    along,
    axpy,
    lane,
    load,
    load_column,
    load_row,
    pack,
    pack4,
    quarter,
    scale,
    splat,
    store,
    store_row,
    truncate,
    with_velocity,
    within,
)

A = np.array([1.5, -2.25, 3.0, 1e300, -1e-300, 0.0, 7.0, -8.125])
B = np.array([-4.0, 0.5, 1e-3, 2.0, 3.0, -1.0, 1.0 / 3.0, 9.0])
GUARD = -99.0


def eight(expression):
    """Return a function of two arrays of eight that stores a vector made of their vectors."""

    @njit
    def run(a, b):
        out = np.full(24, GUARD)
        store(out, 8, expression(load(a, 0), load(b, 0)))
        return out

    expression = njit(expression)

    def checked(a=A, b=B):
        out = run(a, b)
        assert (out[:8] == GUARD).all() and (out[16:] == GUARD).all()
        return out[8:16]

    return checked


def test_aligned_begins_on_a_cache_line():
    for count in (1, 8, 9, 1000):
        a = aligned(count)
        assert a.shape == (count,) and a.dtype == float and not a.any()
        assert a.ctypes.data % simd.LINE == 0


def test_load_and_store_at_any_index():
    @njit
    def move(a, i, out, j):
        store(out, j, load(a, i))

    a, out = np.arange(30.0), np.full(30, GUARD)
    move(a, 5, out, 11)
    assert (out[11:19] == a[5:13]).all()
    assert (np.delete(out, np.s_[11:19]) == GUARD).all()


@pytest.mark.parametrize(
    "wrong", [np.zeros(8, np.float32), np.zeros(8, np.int64), np.zeros(16)[::2]]
)
def test_other_arrays_are_refused(wrong):
    """Their bytes are no row of doubles; they must not compile."""

    @njit
    def read(a):
        return lane(load(a, 0), 0)

    with pytest.raises(numba.TypingError):
        read(wrong)


def test_splat_scale_add():
    assert (eight(lambda a, b: splat(2.5))() == 2.5).all()
    assert (eight(lambda a, b: scale(-1.5, a))() == -1.5 * A).all()
    assert (eight(lambda a, b: add(a, b))() == A + B).all()


def test_axpy_rounds_once():
    a = np.full(8, 1.0 + 2.0**-30)
    twice = a * a - (1.0 + 2.0**-29)
    once = eight(lambda a, b: axpy(1.0 + 2.0**-30, a, b))(a, np.full(8, -(1.0 + 2.0**-29)))
    assert (once == 2.0**-60).all() and (twice == 0.0).all()


def test_pack_and_lane():
    @njit
    def turn(a):
        v = pack(a[7], a[6], a[5], a[4], a[3], a[2], a[1], a[0])
        out = np.empty(8)
        for i in range(8):
            out[i] = lane(v, i)
        return out

    assert (turn(A) == A[::-1]).all()


def test_pack4_and_quarter():
    @njit
    def parts(a):
        v, low, high = load(a, 0), pack4(a[3], a[2], a[1], a[0]), quarter(load(a, 0), 3)
        out = np.empty((4, 4))
        for i in range(4):
            out[0, i], out[1, i] = lane(low, i), lane(high, i)
            out[2, i], out[3, i] = lane(quarter(v, 0), i), lane(quarter(v, 4), i)
        return out

    low, high, first, last = parts(A)
    assert (low == A[3::-1]).all() and (high == A[3:7]).all()
    assert (first == A[:4]).all() and (last == A[4:]).all()


def test_with_velocity():
    v = eight(lambda a, b: with_velocity(a, quarter(b, 0)))()
    assert (v == [A[0], *B[:3], *A[4:]]).all()


def test_rows_of_three():
    """The last row too: nothing beyond the array is read or written."""

    @njit
    def copy(a, p, out, q):
        row = load_row(a, p)
        store_row(out, q, row)
        return lane(row, 3)

    a, out = np.arange(12.0).reshape(4, 3) + 1.0, np.full((4, 3), GUARD)
    assert copy(a, 3, out, 2) == 0.0
    assert (out[2] == a[3]).all() and (np.delete(out, 2, axis=0) == GUARD).all()


def test_columns_of_a_symmetric_tensor():
    @njit
    def columns(a, p):
        out = np.empty((3, 8))
        for i in range(8):
            out[0, i] = lane(load_column(a, p, 0), i)
            out[1, i] = lane(load_column(a, p, 1), i)
            out[2, i] = lane(load_column(a, p, 2), i)
        return out

    a = np.arange(12.0).reshape(2, 6) + 1.0
    xx, yy, zz, xy, yz, xz = a[1]
    tensor = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
    out = columns(a, 1)
    assert (out[:, 4:7] == tensor.T).all()
    assert not out[:, [0, 1, 2, 3, 7]].any()


def test_along_takes_one_lane_of_each_vector():
    @njit
    def second(a):
        return along((load(a, 0), 4.5, load(a, 8), 2.0 * load(a, 0)), 1)

    assert second(np.concatenate([A, B])) == (A[1], 4.5, B[1], 2.0 * A[1])


def test_truncate():
    values = np.array([0.0, 0.999, 1.0, -0.5, -1.5, 1e15 + 0.5, 3.9999999, -7.0])
    assert (eight(lambda a, b: truncate(a))(values) == np.trunc(values)).all()


@pytest.mark.parametrize(
    "expression",
    [
        lambda a, b: a + b,
        lambda a, b: a - b,
        lambda a, b: a * b,
        lambda a, b: 2.5 - a,
        lambda a, b: b * 3.0,
        lambda a, b: 1.0 + b,
        lambda a, b: -b,
    ],
)
def test_operators(expression):
    np.testing.assert_array_equal(eight(expression)(), expression(A, B))


@pytest.mark.parametrize("expression", [lambda a, b: a / b, lambda a, b: 1.0 / b])
def test_division(expression):
    b = np.where(B == 0, 1.0, B)
    np.testing.assert_allclose(eight(expression)(A, b), expression(A, b), rtol=4e-16)


def test_minimum_and_maximum():
    low, high = eight(lambda a, b: min(a, b)), eight(lambda a, b: max(a, b))
    assert (low() == np.minimum(A, B)).all() and (high() == np.maximum(A, B)).all()
    assert (eight(lambda a, b: min(max(a, 0.0), 3.0))() == np.clip(A, 0.0, 3.0)).all()


def test_a_clamp_turns_nan_into_a_bound():
    """The place of a particle's node is clamped in this way, so NaN cannot become an index."""
    clamped = eight(lambda a, b: min(max(a, 0.0), 3.0))(np.full(8, np.nan))
    assert (clamped == 0.0).all()


def test_within_needs_every_lane():
    @njit
    def inside(v, low, high):
        return within(load_row(v, 0), load_row(low, 0), load_row(high, 0))

    low, high = np.array([[-1.0, 0.0, 2.0]]), np.array([[1.0, 0.5, 2.0]])
    assert inside(np.array([[-1.0, 0.5, 2.0]]), low, high)
    for axis in range(3):
        for bad in (-5.0, 5.0, np.nan, np.inf, -np.inf):
            v = np.array([[0.0, 0.25, 2.0]])
            v[0, axis] = bad
            assert not inside(v, low, high)
