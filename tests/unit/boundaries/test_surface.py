"""Triangles in any order and state become one surface whose outside is known."""

import numpy as np
import pytest
import terrains

from mpmgeo.boundaries.surface import surface_of
from mpmgeo.numerics.triangle_tree import EDGE_12, FACE

BOX = terrains.box([0, 0, 0], [2, 1, 3])
HILL = terrains.patch(lambda x, y: np.cos(x) * np.sin(y), -3.0, 3.0, 12)


def surface(corner, resolution=0.0):
    return surface_of(corner, np.zeros((len(corner), 3)), resolution)


def turned(corner, which):
    corner = corner.copy()
    corner[which] = corner[which][:, [0, 2, 1]]
    return corner


def test_a_box_has_its_normals_outside():
    found = surface(BOX)
    middle = found.corner.mean(axis=1)
    assert ((middle - [1, 0.5, 1.5]) * found.normal[:, FACE]).sum(axis=1).min() > 0.4
    assert not found.rim.any()
    assert found.notes == ()
    outward = np.sign(found.corner - [1, 0.5, 1.5]) / np.sqrt(3)
    assert found.normal[:, :3] == pytest.approx(outward)  # weighted by angle: all faces alike


def test_edges_have_the_mean_of_their_faces():
    found = surface(terrains.patch(lambda x, y: np.abs(x), -1.0, 1.0, 2))
    ridge = (found.corner[:, :2, 0] == 0).all(axis=1)
    assert found.normal[ridge, EDGE_12] == pytest.approx(np.tile([0, 0, 1], (ridge.sum(), 1)))


def test_the_border_is_found():
    found = surface(HILL)
    edges = np.stack([found.corner, np.roll(found.corner, -1, axis=1)], axis=2)[..., :2]
    on_border = ((edges == edges[:, :, :1]) & (np.abs(edges) == 3)).all(axis=2).any(axis=2)
    assert (found.rim[:, EDGE_12:FACE] == on_border).all()
    assert (found.rim[:, :3] == (np.abs(found.corner[..., :2]) == 3).any(axis=2)).all()


@pytest.mark.parametrize("corner", [BOX, HILL], ids=["box", "hill"])
def test_single_precision_and_any_order_change_nothing(corner):
    random = np.random.default_rng(0)
    order = random.permutation(len(corner))
    spread = 1e3 * (1 + random.uniform(-1, 1, corner.shape) * 5e-8)
    single = np.finfo(np.float32).eps * 1e3 * np.abs(corner).max()
    found, wanted = surface(spread[order] * corner[order], single), surface(corner)
    assert found.normal == pytest.approx(wanted.normal[order], abs=1e-5)
    assert (found.rim == wanted.rim[order]).all()


@pytest.mark.parametrize("corner", [BOX, HILL], ids=["box", "hill"])
def test_some_triangles_the_wrong_way_round_are_turned(corner):
    which = np.random.default_rng(1).random(len(corner)) < 0.3
    found, wanted = surface(turned(corner, which)), surface(corner)
    assert found.normal[:, FACE] == pytest.approx(wanted.normal[:, FACE])
    assert found.notes == (f"{which.sum()} triangles turned round to agree with the others",)


def test_separate_pieces_are_turned_by_themselves():
    pieces = np.concatenate([HILL, turned(HILL, slice(None)) + [0, 0, 50]])
    found = surface(pieces)
    assert found.notes == ()
    assert (found.normal[: len(HILL), FACE, 2] > 0).all()
    assert (found.normal[len(HILL) :, FACE, 2] < 0).all()


def test_triangles_without_area_are_left_out():
    a, b = HILL[0, 0], HILL[0, 1]
    flat = [[a, a, b], [a, b, 2 * b - a], [a, b, a]]
    found, wanted = surface(np.concatenate([flat, HILL])), surface(HILL)
    assert found.normal == pytest.approx(wanted.normal)
    assert found.notes == (f"3 of {len(HILL) + 3} triangles without area left out",)
    with pytest.raises(ValueError, match="none of the 3 triangles has an area"):
        surface(np.array(flat))


def test_opposing_normals_of_a_file_are_told():
    own = surface(HILL).normal[:, FACE]
    assert surface_of(HILL, own).notes == ()
    assert "oppose the order of the corners" in surface_of(HILL, -own).notes[0]


def test_triangles_that_share_an_edge_of_three_are_no_border():
    a, b = [0.0, 0, 0], [1.0, 0, 0]
    fins = [[a, b, [0.5, y, z]] for y, z in ((1, 0), (-1, 0.2), (0, 1))]
    assert not surface(np.array(fins)).rim[:, EDGE_12].any()


def test_corners_as_near_as_doubles_tell_are_joined_by_the_triangle_not_by_the_place():
    """Far from (0, 0, 0) a small hill keeps its triangles; noise of a few ulp opens no crack."""
    small, place = 0.1 * HILL, np.array([5e5, 4.5e6, 0.0])
    resolution = 4 * np.spacing(4.5e6)
    noise = np.random.default_rng(3).integers(-1, 2, small.shape) * np.spacing(place)
    found, wanted = surface(small + place + noise, resolution), surface(small)
    assert found.notes == ()
    assert (found.rim == wanted.rim).all()
    assert found.normal == pytest.approx(wanted.normal, abs=1e-6)


def test_corners_a_millionth_of_a_triangle_apart_are_two():
    apart = HILL.copy()
    apart[5, 0] += [2e-6, 0.0, 0.0]
    assert surface(apart).rim.sum() > surface(HILL).rim.sum()
    apart = HILL.copy()
    apart[5, 0] += [1e-10, 0.0, 0.0]
    assert surface(apart).rim.sum() == surface(HILL).rim.sum()
