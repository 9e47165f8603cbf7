"""What every shape function keeps, the ready ones and those that only tests know."""

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from models import Spline6, Spline10

from mpmgeo.shapes import SHAPES
from mpmgeo.shapes.shape import stencil, width

ALL = SHAPES | {"spline6": Spline6(), "spline10": Spline10()}
SHAPE = pytest.mark.parametrize("shape", ALL.values(), ids=ALL)
EDGES = (-0.5, 0.5)

within_cell = st.floats(-0.5, 0.5)
half_size = st.floats(1e-3, 0.5)


def parts(shape, s, l):
    """Return weights (S,), slopes (S,) and node positions (S,) from the middle, in cells."""
    values = np.array(stencil(shape, s, l, None))
    S = width(shape)
    assert values.shape == (2 * S,) and np.isfinite(values).all()
    return values[:S], values[S:], np.arange(S) - (S - 1) / 2


@SHAPE
def test_shape_is_declared_completely(shape):
    assert isinstance(shape, tuple) and hasattr(shape, "_fields")
    assert isinstance(type(shape).width, int) and type(shape).width >= 2


@pytest.mark.parametrize("name", SHAPES)
def test_shape_names_its_source(name):
    doc = __import__(type(SHAPES[name]).__module__, fromlist=["_"]).__doc__
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


@SHAPE
@given(s=st.floats(-0.4999, 0.4999), l=st.floats(0.01, 0.5))
def test_slopes_are_those_of_the_weights(shape, s, l):
    d = 1e-6
    _, slopes, _ = parts(shape, s, l)
    high, low = parts(shape, s + d, l)[0], parts(shape, s - d, l)[0]
    # GIMP's slope has a kink of 1 / (2 l) where a particle's edge passes a node
    assert np.abs((high - low) / (2 * d) - slopes).max() < 1e-9 + d / l


@SHAPE
@given(s=within_cell, l=half_size)
def test_mirrored_particle_has_mirrored_stencil(shape, s, l):
    weights, slopes, _ = parts(shape, s, l)
    mirrored, turned, _ = parts(shape, -s, l)
    assert np.abs(mirrored[::-1] - weights).max() < 1e-14
    assert np.abs(turned[::-1] + slopes).max() < 1e-12


@SHAPE
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


@SHAPE
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
