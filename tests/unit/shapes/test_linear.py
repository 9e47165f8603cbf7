from mpmgeo.shapes.linear import Linear
from mpmgeo.shapes.shape import stencil


def test_weights_are_the_distances():
    assert stencil(Linear(), 0.25, 0.1, None) == (0.25, 0.75, -1.0, 1.0)
    assert stencil(Linear(), -0.5, 0.1, None) == (1.0, 0.0, -1.0, 1.0)
    assert stencil(Linear(), 0.5, 0.1, None) == (0.0, 1.0, -1.0, 1.0)
