"""GIMP without cases against its six cases, as the literature and MPM-Geomechanics write them."""

import numpy as np
import pytest

from mpmgeo.shapes.gimp import Gimp
from mpmgeo.shapes.shape import stencil


def weight_and_slope(x, l):
    """Return the weight and slope at a distance x from a node, particle half-size l, in cells."""
    if abs(x) >= 1 + l:
        return 0.0, 0.0
    if x <= -1 + l:
        return (1 + l + x) ** 2 / (4 * l), (1 + l + x) / (2 * l)
    if x <= -l:
        return 1 + x, 1.0
    if x <= l:
        return 1 - (x * x + l * l) / (2 * l), -x / l
    if x <= 1 - l:
        return 1 - x, -1.0
    return (1 + l - x) ** 2 / (4 * l), -(1 + l - x) / (2 * l)


@pytest.mark.parametrize("l", [0.5, 0.499, 0.25, 0.1, 1e-3])
@pytest.mark.parametrize("s", [*np.linspace(-0.5, 0.5, 21), -0.25, 0.25, 0.1, -0.1])
def test_all_cases(s, l):
    expected = [weight_and_slope(s - node, l) for node in (-1, 0, 1)]
    result = np.reshape(stencil(Gimp(), s, l, None), (2, 3)).T
    np.testing.assert_allclose(result, expected, rtol=1e-12, atol=1e-13)


def test_particle_of_a_cell_on_a_node():
    """Check values of MPM-Geomechanics' own test."""
    assert stencil(Gimp(), 0.0, 0.5, None)[:3] == (0.125, 0.75, 0.125)
