"""What every shape function keeps, the ready ones and those that only tests know."""

from math import floor, inf

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from models import Spline6, Spline10

from mpmgeo.shapes import SHAPES, shape_of
from mpmgeo.shapes.lme import LocalMaxEnt
from mpmgeo.shapes.shape import cut_of, cuts, stencil, width

READY = {name: shape_of(name) for name in SHAPES}
LME = {f"LME {γ:g}": LocalMaxEnt(gamma=γ).shape for γ in (0.3, 0.8, 1.8, 3, 4, 6, 8, 17, 50)}
ALL = READY | LME | {"spline6": Spline6(), "spline10": Spline10()}
WITHOUT_KINK = {name: shape for name, shape in ALL.items() if name not in ("LME 17", "LME 50")}
VANISHING = {name: shape for name, shape in ALL.items() if "LME" not in name}
SHAPE = pytest.mark.parametrize("shape", ALL.values(), ids=ALL)
EDGES = (-0.5, 0.5)

within_cell = st.floats(-0.5, 0.5)
half_size = st.floats(1e-3, 0.5)


def parts(shape, s, l):
    """Return weights (S,), slopes (S,) and node positions (S,) from the middle, in cells."""
    values = np.array(stencil(shape, s, l, cut_of(shape, None, 0)))
    S = width(shape)
    assert values.shape == (2 * S,) and np.isfinite(values).all()
    return values[:S], values[S:], np.arange(S) - (S - 1) / 2


@SHAPE
def test_shape_is_declared_completely(shape):
    assert isinstance(shape, tuple) and hasattr(shape, "_fields")
    assert isinstance(type(shape).width, int) and type(shape).width >= 2


@pytest.mark.parametrize("name", SHAPES)
def test_shape_names_its_source(name):
    doc = __import__(type(READY[name]).__module__, fromlist=["_"]).__doc__
    assert "Source:" in doc


@SHAPE
@given(s=within_cell, l=half_size)
@example(s=-0.5, l=0.5)
@example(s=0.5, l=0.5)
@example(s=0.0, l=1e-6)
def test_partition_of_unity(shape, s, l):
    weights, slopes, _ = parts(shape, s, l)
    assert abs(weights.sum() - 1) < 1e-14
    assert abs(slopes.sum()) < 1e-13
    assert weights.min() > -1e-15


@SHAPE
@given(s=within_cell, l=half_size)
@example(s=-0.5, l=0.5)
@example(s=0.5, l=0.5)
def test_linear_fields_are_reproduced(shape, s, l):
    """Value and slope of the field that is the position itself."""
    weights, slopes, node = parts(shape, s, l)
    assert abs(weights @ node - s) < 1e-13
    assert abs(slopes @ node - 1) < 1e-12


@pytest.mark.parametrize("shape", WITHOUT_KINK.values(), ids=WITHOUT_KINK)
@given(s=st.floats(-0.4999, 0.4999), l=st.floats(0.01, 0.5))
def test_slopes_are_those_of_the_weights(shape, s, l):
    d = 1e-6
    _, slopes, _ = parts(shape, s, l)
    high, low = parts(shape, s + d, l)[0], parts(shape, s - d, l)[0]
    # GIMP's slope has a kink of 1 / (2 l) where a particle's edge passes a node
    assert np.abs((high - low) / (2 * d) - slopes).max() < 1e-9 + d / l


@pytest.mark.parametrize("shape", WITHOUT_KINK.values(), ids=WITHOUT_KINK)
@given(s=within_cell, l=half_size)
def test_mirrored_particle_has_mirrored_stencil(shape, s, l):
    weights, slopes, _ = parts(shape, s, l)
    mirrored, turned, _ = parts(shape, -s, l)
    assert np.abs(mirrored[::-1] - weights).max() < 1e-14
    assert np.abs(turned[::-1] + slopes).max() < 1e-12


@pytest.mark.parametrize("shape", VANISHING.values(), ids=VANISHING)
@pytest.mark.parametrize("l", [0.5, 0.25, 0.01])
def test_weights_are_continuous_where_the_first_node_changes(shape, l):
    """At s = ½ the stencil moves on by one node; the one left behind has no weight any more."""
    before, after = parts(shape, 0.5, l)[0], parts(shape, -0.5, l)[0]
    assert before[0] == pytest.approx(0.0, abs=1e-15)
    assert after[-1] == pytest.approx(0.0, abs=1e-15)
    assert before[1:] == pytest.approx(after[:-1], abs=1e-15)
    if width(shape) > 2:
        before, after = parts(shape, 0.5, l)[1], parts(shape, -0.5, l)[1]
        assert before[1:] == pytest.approx(after[:-1], abs=1e-12)


@pytest.mark.parametrize("shape", VANISHING.values(), ids=VANISHING)
@pytest.mark.parametrize("l", [0.5, 0.25])
def test_power_with_which_the_weight_vanishes(shape, l):
    """Half as far over the edge of its support, a particle has 2^−edge of the weight there."""
    low, high = -0.5, 0.5
    while high - low > 1e-15:
        middle = (low + high) / 2
        low, high = (middle, high) if parts(shape, middle, l)[0][0] > 1e-300 else (low, middle)
    far, near = (parts(shape, high - d, l)[0][0] for d in (2e-3, 1e-3))
    assert np.log2(far / near) == pytest.approx(type(shape).edge, abs=0.01)


@SHAPE
@pytest.mark.parametrize("edge", EDGES)
def test_a_hair_beyond_the_edge_does_no_harm(shape, edge):
    """Round-off may put a particle there; sums must hold as inside."""
    weights, slopes, node = parts(shape, edge * (1 + 1e-12), 0.25)
    assert abs(weights.sum() - 1) < 1e-14 and abs(slopes.sum()) < 1e-13
    assert weights @ node == pytest.approx(edge, abs=1e-11)


ENDING = {name: shape for name, shape in ALL.items() if cuts(shape)}
AROUND = 14
CELLS = pytest.mark.parametrize("cells", [1, 2, 3, 7])
WALLS = pytest.mark.parametrize("walls", [(0, 0), (0, 1), (1, 0), (1, 1)], ids=str)
ENDS = pytest.mark.parametrize("shape", ENDING.values(), ids=ENDING)


def between(shape, x, cells, walls=(1, 1)):
    """Return weights and slopes of nodes 0 … cells and AROUND beyond each side, at x [cells]."""
    S = width(shape)
    first = floor(x - (S - 2) / 2)
    places = (0.0 if walls[0] else -inf, float(cells) if walls[1] else inf)
    cut = cut_of(shape, places, first)
    values = np.array(stencil(shape, x - first - (S - 1) / 2, 0.25, cut))
    out = np.zeros((2, cells + 1 + 2 * AROUND))
    out[:, first + AROUND : first + AROUND + S] = values.reshape(2, S)
    return out


def places(cells):
    """Return places all over the mesh, the nodes and the walls to the last bit among them."""
    near = [0.0, 1e-300, 1e-17, 1e-15, 1e-9, 0.25, 0.5, np.nextafter(0.5, 0)]
    near += [cells - x for x in near] + [np.nextafter(cells, 0)]
    return [*near, *np.arange(cells), *np.linspace(0, cells, 16 * cells + 1)]


@ENDS
@CELLS
@WALLS
def test_walls_keep_constant_and_linear_fields(shape, cells, walls):
    """And no node has a negative weight; those beyond a wall have none, and no slope."""
    node = np.arange(cells + 1.0 + 2 * AROUND) - AROUND
    for x in places(cells):
        weights, slopes = between(shape, x, cells, walls)
        assert abs(weights.sum() - 1) < 1e-14 and abs(slopes.sum()) < 1e-13
        assert abs(weights @ node - x) < 1e-14 * max(1, cells) and abs(slopes @ node - 1) < 1e-12
        assert weights.min() >= 0.0
        beyond = (node < 0) * walls[0] + (node > cells) * walls[1] > 0
        assert not weights[beyond].any() and not slopes[beyond].any()


@ENDS
@CELLS
def test_nothing_but_the_node_on_a_wall_acts_there(shape, cells):
    for x, at in ((0.0, AROUND), (float(cells), cells + AROUND)):
        weights, _ = between(shape, x, cells)
        assert weights[at] == pytest.approx(1.0, abs=1e-14)
        assert 0 < np.delete(weights, at).sum() < 1e-14


@ENDS
@CELLS
def test_slopes_at_walls_are_those_of_the_weights(shape, cells):
    d = 1e-6
    for x in np.linspace(1e-5, cells - 1e-5, 40 * cells):
        slopes = between(shape, x, cells)[1]
        high, low = between(shape, x + d, cells)[0], between(shape, x - d, cells)[0]
        assert np.abs((high - low) / (2 * d) - slopes).max() < 1e-9 + d


@ENDS
def test_one_cell_between_walls_has_hats(shape):
    for x in places(1):
        weights, slopes = between(shape, x, 1)
        assert weights[AROUND : AROUND + 2] == pytest.approx([1 - x, x], abs=1e-14)
        assert slopes[AROUND : AROUND + 2] == pytest.approx([-1, 1], abs=1e-14)


@ENDS
def test_walls_do_not_act_from_afar(shape):
    S = width(shape)
    for x in np.linspace(S / 2, S / 2 + 3, 31):
        np.testing.assert_array_equal(between(shape, x, S + 3), between(shape, x, S + 3, (0, 0)))


@ENDS
def test_mirrored_walls(shape):
    for x in np.linspace(0, 3, 50):
        weights, slopes = between(shape, x, 3)
        mirrored, turned = between(shape, 3 - x, 3)
        assert np.abs(mirrored[::-1] - weights).max() < 1e-14
        assert np.abs(turned[::-1] + slopes).max() < 1e-13


@pytest.mark.parametrize("name", sorted(set(ALL) - set(ENDING)))
def test_other_shapes_are_told_of_no_walls(name):
    assert cut_of(ALL[name], (0.0, 7.0), 0) is None
