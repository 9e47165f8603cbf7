"""Local maximum-entropy functions against a general solution by Newton's method, and by numbers."""

from itertools import product

import numpy as np
import pytest

from mpmgeo.shapes.lme import LocalMaxEnt
from mpmgeo.shapes.shape import stencil, width

GAMMAS = (0.8, 1.8, 3.0, 4.0, 8.0)
GAMMA = pytest.mark.parametrize("gamma", GAMMAS)
FREE = (0.0, 0.0)


def of(gamma, **more):
    return LocalMaxEnt(gamma=gamma, **more).shape


def row(shape, s, cut=FREE):
    """Return weights, slopes and places (S,) of the nodes of a row, from its middle."""
    values, S = np.array(stencil(shape, s, 0.25, cut)), width(shape)
    return values[:S], values[S:], np.arange(S) - 0.5 * (S - 1)


def general(γ, place, node):
    """Return weights (n,) and slopes (n, d) at `place` (d,) of nodes (n, d) anywhere.

    Newton's method with steps that are capped and halved until ln Z or the residual falls.
    """
    l = place - node

    def at(λ):
        f = -γ * (l**2).sum(axis=1) + l @ λ
        e = np.exp(f - f.max())
        N = e / e.sum()
        return N, N @ l, np.log(e.sum()) + f.max()

    λ = np.zeros(len(place))
    N, r, lnZ = at(λ)
    for _ in range(100):
        if np.abs(r).max() < 1e-13:
            break
        J = (N[:, None] * l).T @ l - np.outer(r, r)
        step, t = np.clip(-np.linalg.solve(J, r), -4, 4), 1.0
        new = at(λ + step)
        while new[2] > lnZ and np.linalg.norm(new[1]) > np.linalg.norm(r) and t > 1e-6:
            t /= 2
            new = at(λ + t * step)
        λ, (N, r, lnZ) = λ + t * step, new
    J = (N[:, None] * l).T @ l - np.outer(r, r)
    return N, -N[:, None] * np.linalg.solve(J, (l - r).T).T


@GAMMA
@pytest.mark.parametrize("axes", [1, 2, 3])
def test_products_of_rows_are_the_general_solution(gamma, axes):
    """Also in boxes that walls cut, along each axis in another way."""
    shape, random = of(gamma), np.random.default_rng(axes)
    S = width(shape)
    for number in range(6):
        cuts = ([FREE] * 3, [FREE, (1.0, 0.0), (0.0, 1.0)])[number % 2][:axes]
        kept = [np.arange(S)[int(low) : S - int(high)] for low, high in cuts]
        ends = np.array(
            [(max(j[0] - 0.5 * (S - 1), -0.5), min(j[-1] - 0.5 * (S - 1), 0.5)) for j in kept]
        )
        place = ends @ [0.5, 0.5] + random.uniform(-0.45, 0.45, axes) * (ends @ [-1, 1])
        rows = [row(shape, s, cut) for s, cut in zip(place, cuts, strict=True)]
        nodes = np.array(list(product(*(r[2][k] for r, k in zip(rows, kept, strict=True)))))
        N, G = general(gamma, place, nodes)
        weights = [r[0][k] for r, k in zip(rows, kept, strict=True)]
        slopes = [r[1][k] for r, k in zip(rows, kept, strict=True)]
        found = np.array([np.prod(w) for w in product(*weights)])
        assert np.abs(found - N).max() < 1e-10
        for a in range(axes):
            of_axis = [slopes[k] if k == a else weights[k] for k in range(axes)]
            assert np.abs([np.prod(w) for w in product(*of_axis)] - G[:, a]).max() < 1e-10


@pytest.mark.parametrize(
    "gamma, at_node, between",
    [
        (0.8, 0.504622, 0.413157),
        (1.8, 0.750699, 0.486692),
        (3.0, 0.909433, 0.498764),
        (4.0, 0.964663, 0.499832),
    ],
)
def test_values_of_an_infinite_row(gamma, at_node, between):
    """The width is even or odd, so the middle of the row is a node or the middle of a cell."""
    shape = of(gamma, support_tolerance=1e-9)
    even = width(shape) % 2 == 0
    node, middle = (-0.5, 0.0) if even else (0.0, 0.5)
    assert row(shape, node)[0].max() == pytest.approx(at_node, abs=1e-6)
    assert row(shape, middle)[0].max() == pytest.approx(between, abs=1e-6)


@pytest.mark.parametrize("gamma, nodes", [(0.8, 9), (1.8, 6), (3, 5), (4, 4), (8, 3), (50, 3)])
def test_width(gamma, nodes):
    assert LocalMaxEnt(gamma=gamma).width == nodes


def test_too_wide():
    [(key, message)] = LocalMaxEnt(gamma=0.2).problems()
    assert key == "gamma" and "0.2 " in message and "above 0.2819" in message
    assert not list(LocalMaxEnt(gamma=0.283).problems())


def test_large_gamma_has_hats():
    shape = of(17.0)
    for s in np.linspace(-0.5, 0.5, 41):
        weights, _, node = row(shape, s)
        assert np.abs(weights - np.maximum(0, 1 - np.abs(s - node))).max() < 1e-6


@GAMMA
def test_the_rest_of_the_row_is_below_the_tolerance(gamma):
    """Against a row of many more nodes."""
    for s in np.linspace(-0.5, 0.5, 21):
        weights, _, node = row(of(gamma), s)
        all_nodes = node[0] - 10 + np.arange(len(node) + 20.0)
        N, _ = general(gamma, np.array([s]), all_nodes[:, None])
        assert np.abs(weights - N[10:-10]).max() < 3e-5
        assert N[:10].sum() + N[-10:].sum() < 3e-5


@GAMMA
def test_a_table_and_a_search_agree(gamma):
    """One that is cut far away is searched for; without the last node it is the same, nearly."""
    shape = of(gamma)
    searches = shape._replace(table=None)
    for s in np.linspace(-0.5, 0.5, 57):
        for found, expected in zip(row(searches, s), row(shape, s), strict=True):
            assert np.abs(found - expected).max() < 1e-11


@GAMMA
def test_near_a_wall(gamma):
    """Weights there are those of the two nodes of the cell: r grows without bound."""
    shape = of(gamma)
    S = width(shape)
    below = (S - 1) // 2 if S % 2 else S // 2 - 1
    for ξ in (1e-3, 1e-6, 1e-10, 1e-14):
        s = below - 0.5 * (S - 1) + ξ
        weights, slopes, node = row(shape, s, (float(below), 0.0))
        assert weights[below] == pytest.approx(1 - ξ, abs=3 * ξ**2 + 1e-14)
        assert weights[below + 1] == pytest.approx(ξ, rel=0.01 + 1e-15 / ξ, abs=3 * ξ**2)
        assert slopes @ node == pytest.approx(1, abs=1e-12)
