"""Loops in chunks: who runs them changes nothing, and arguments may be nested."""

from typing import NamedTuple

import numba
import numpy as np
import pytest
from assembly import simulate, two_blocks
from llvmlite.binding import Linkage

from mpmgeo.numerics.chunks import ALONE, CHUNKS, blockwise, crew_of
from mpmgeo.numerics.jit import compiled


class Inner(NamedTuple):
    """Numbers inside numbers."""

    factor: float
    nothing: object


class Outer(NamedTuple):
    """What a loop is told."""

    inner: Inner
    offsets: tuple


@compiled
def power(x, n):
    """A function that is too long to disappear in its caller."""
    y = 1.0
    for _ in range(n):
        y *= x
    return y


@blockwise
def fill(c, told, bounds, arrays):
    """Write a formula of the index, and return how many are even."""
    x, none, (y, _) = arrays
    even = 0
    for p in range(bounds[c], bounds[c + 1]):
        x[p] = told.inner.factor * power(2.0, p % 5) + told.offsets[1]
        if none is None and told.inner.nothing is None:
            y[p, 2] = p
        even += 1 - p % 2
    return even


@blockwise
def double(c, bounds, x):
    """Double what is there."""
    for p in range(bounds[c], bounds[c + 1]):
        x[p] *= 2.0


def filled(crew, count):
    bounds = np.linspace(0, count, CHUNKS + 1).astype(np.int64)
    x, y = np.zeros(count), np.zeros((count, 3))
    told = Outer(Inner(3.0, None), (0.0, 0.25))
    even = fill(crew, told, bounds, (x, None, (y, 7.0)))
    assert double(crew, bounds, y[:, 2].copy()) is None
    return even, x, y


@pytest.mark.parametrize("crew", [ALONE, crew_of(1), crew_of(2)])
@pytest.mark.parametrize("count", [0, 1, 63, 1000])
def test_all_chunks_are_done_once(crew, count):
    even, x, y = filled(crew, count)
    p = np.arange(count)
    assert even == (count + 1) // 2
    assert (x == 3.0 * 2.0 ** (p % 5) + 0.25).all()
    assert (y[:, 2] == p).all() and not y[:, :2].any()


def test_more_threads_than_there_are_chunks():
    assert filled(crew_of(numba.config.NUMBA_NUM_THREADS), 500)[0] == 250


def test_one_thread_needs_nobody():
    assert crew_of(1) == ALONE == (0, 1)
    start, count = crew_of(2)
    assert start and count == 2


def test_no_machine_code_is_shared_with_other_kernels():
    """Namesakes would be those of the first kernel that was loaded, in an order that may differ."""
    filled(ALONE, 10)
    (overload,) = fill.overloads.values()
    found = {f.name: f.linkage for f in overload.library.get_defined_functions()}
    names = [n for n, kind in found.items() if kind not in (Linkage.external, Linkage.internal)]
    assert all(name.startswith("NRT_") for name in names), names


def test_the_user_hears_that_kernels_cannot_be_kept(monkeypatch):
    assert not any("bits" in text for text in simulate(two_blocks()).messages)
    monkeypatch.setattr(numba.config, "CACHE_DIR", "")
    (remark,) = [text for text in simulate(two_blocks()).messages if "bits" in text]
    assert "NUMBA_CACHE_DIR" in remark
