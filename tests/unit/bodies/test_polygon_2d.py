import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mpmgeo.bodies import Polygon2D
from mpmgeo.bodies.polygon_2d import contains

SQUARE = ((0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0))


def polygon(points, direction="y", displacement=1.0, **keys):
    return Polygon2D(
        material_id=1,
        points=tuple(points),
        extrude_direction=direction,
        extrude_displacement=displacement,
        **keys,
    )


def along_y(points):
    """Points (x, z) in the plane y = 0."""
    return [(x, 0.0, z) for x, z in points]


def crossings(corners, h, v):
    """The even-odd rule for one point, as a textbook loop."""
    inside = False
    for (h0, v0), (h1, v1) in zip(corners, corners[-1:] + corners[:-1], strict=True):
        if (v0 > v) != (v1 > v) and h < h0 + (h1 - h0) * (v - v0) / (v1 - v0):
            inside = not inside
    return inside


coordinate = st.floats(-2, 2).map(lambda x: round(x, 3))
corner = st.tuples(coordinate, coordinate)


@given(st.lists(corner, min_size=3, max_size=8))
def test_contains_agrees_with_the_rule_for_single_points(corners):
    h = np.linspace(-2.1, 2.1, 23)[:, None] + 1e-5 * np.e
    v = np.linspace(-2.1, 2.1, 19)[None, :] + 1e-5 * np.pi
    inside = contains(np.array(corners), h, v, nudge=0.0)
    expected = [[crossings(corners, x, y) for y in v[0]] for x in h[:, 0]]
    np.testing.assert_array_equal(inside, expected)


@given(st.tuples(st.integers(1, 7), st.integers(1, 7)))
def test_polygons_with_common_edges_share_no_point_and_lose_none(meeting):
    # The four triangles meet in a point of the lattice, and their edges run through others.
    h, v = np.ix_(np.arange(9.0), np.arange(9.0))
    square = [(0.0, 0.0), (8.0, 0.0), (8.0, 8.0), (0.0, 8.0)]
    centre = tuple(map(float, meeting))
    count = sum(
        contains(np.array([square[n - 1], square[n], centre]), h, v, nudge=1e-9).astype(int)
        for n in range(4)
    )
    whole = contains(np.array(square), h, v, nudge=1e-9)
    np.testing.assert_array_equal(count, whole)
    assert whole[:8, :8].all()
    assert not whole[8, :].any()
    assert not whole[:, 8].any()


def test_left_and_lower_edges_belong_to_the_polygon_right_and_upper_ones_do_not():
    # Positions are 0.125, 0.375, ...; the box starts at 0 through the lowest corner.
    points = along_y([(0.0, 0.0), (0.125, 0.125), (0.625, 0.125), (0.625, 0.625), (0.125, 0.625),
                      (0.125, 0.125)])  # fmt: skip
    cloud = polygon(points, displacement=0.25, discretization_length=0.5).generate(np.ones(3))
    inside = np.unique(cloud.position[:, [0, 2]], axis=0)
    assert inside.tolist() == [[0.125, 0.125], [0.125, 0.375], [0.375, 0.125], [0.375, 0.375]]


@pytest.mark.parametrize("edge", [0.1, 0.05, 0.3, 1 / 3])
def test_round_off_does_not_decide_on_a_slope_through_the_positions(edge):
    n = 12
    triangle = along_y([(0.0, 0.0), (n * edge, 0.0), (0.0, n * edge)])
    cloud = polygon(triangle, displacement=edge, discretization_length=edge).generate(np.ones(3))
    i, k = np.round(cloud.position[:, [0, 2]] * 2 / edge - 0.5).T
    assert (i + k + 1 < 2 * n).all()
    assert len(cloud.position) == 2 * sum(range(2 * n))


@pytest.mark.parametrize(("direction", "axis"), [("x", 0), ("y", 1), ("z", 2)])
def test_every_direction_of_extrusion(direction, axis):
    first, second = (a for a in range(3) if a != axis)
    points = np.zeros((4, 3))
    points[:, [first, second]] = [(1, 2), (4, 2), (4, 4), (1, 4)]
    points[:, axis] = [7, 5, 6, 5]
    body = polygon(map(tuple, points), direction, 2.0, discretization_length=0.5)
    cloud = body.generate(np.ones(3))
    assert cloud.notes == ()
    assert len(cloud.position) == 3 * 2 * 2 * 64
    assert cloud.size.prod(axis=1).sum() == pytest.approx(12.0)
    low, high = cloud.position.min(axis=0), cloud.position.max(axis=0)
    assert (low[axis], high[axis]) == (5.125, 6.875)
    assert (low[first], high[first], low[second], high[second]) == (1.125, 3.875, 2.125, 3.875)


@pytest.mark.parametrize(("direction", "axis"), [("x", 0), ("y", 1), ("z", 2)])
def test_horizontal_and_vertical_are_the_next_two_axes(direction, axis):
    # A step in the horizontal direction only: wrong axes would turn it round.
    horizontal, vertical = (axis + 1) % 3, (axis + 2) % 3
    points = np.zeros((6, 3))
    points[:, [horizontal, vertical]] = [(0, 0), (3, 0), (3, 1), (1, 1), (1, 2), (0, 2)]
    cloud = polygon(map(tuple, points), direction).generate(np.ones(3))
    assert len(cloud.position) == 8 * 4
    assert cloud.position[:, horizontal].max() == 2.75
    assert cloud.position[:, vertical].max() == 1.75


def test_order_is_that_of_the_cuboid():
    cloud = polygon(along_y([(0, 0), (2, 0), (2, 2), (0, 2)]), displacement=3).generate(np.ones(3))
    assert np.floor(cloud.position[::8]).tolist() == [list(i) for i in np.ndindex(2, 3, 2)]
    assert cloud.position[1].tolist() == [0.75, 0.25, 0.25]
    assert cloud.position[2].tolist() == [0.25, 0.75, 0.25]


def test_particles_per_direction():
    body = polygon(along_y(SQUARE), particles_per_direction=(1, 2, 4))
    cloud = body.generate(np.ones(3))
    assert len(cloud.position) == 8
    assert cloud.size[0].tolist() == [1.0, 0.5, 0.25]
    assert cloud.position[:, 2].tolist() == [0.125, 0.125, 0.375, 0.375] + [
        0.625,
        0.625,
        0.875,
        0.875,
    ]


@pytest.mark.parametrize("length", [None, 0.0])
def test_the_default_edge_is_the_mean_of_the_cell(length):
    body = polygon(along_y(SQUARE), discretization_length=length)
    cloud = body.generate(np.array([0.125, 0.25, 0.375]))
    assert cloud.size[0].tolist() == [0.125] * 3
    assert len(cloud.position) == 8**3


def test_turning_the_points_round_changes_nothing():
    points = along_y([(0, 0), (3, 0.2), (2.2, 1), (2.7, 3), (1, 1.4), (0.3, 2.8)])
    forward = polygon(points, discretization_length=0.2).generate(np.ones(3))
    backward = polygon(points[::-1], discretization_length=0.2).generate(np.ones(3))
    np.testing.assert_array_equal(forward.position, backward.position)


def test_a_closing_point_changes_nothing():
    body = polygon(along_y([*SQUARE, SQUARE[0]]), discretization_length=0.1)
    assert len(body.generate(np.ones(3)).position) == 8000


def test_notes():
    body = polygon(along_y(SQUARE), displacement=1.3)
    (note,) = body.generate(np.ones(3)).notes
    assert "along y, 1.3 m" in note
    coarse = polygon(along_y(SQUARE), displacement=1.0, discretization_length=1.0)
    (note,) = coarse.generate(np.array([1.0, 1.0, 0.4])).notes
    assert "0.5 m wide, are larger than the cells" in note


def test_a_polygon_without_area_has_no_particles():
    flat = polygon([(0, 0, 0), (1, 0, 0), (2, 0, 0)])
    assert flat.generate(np.ones(3)).position.shape == (0, 3)
    vertical = polygon([(0, 0, 0), (0, 0, 1), (0, 0, 2)])
    assert vertical.generate(np.ones(3)).position.shape == (0, 3)


def test_edges_that_are_almost_horizontal_add_no_particle_outside():
    top = 0.625 - 1e-9 * 0.5
    for rise in (5e-324, 1e-310, 1e-16, 1e-12, 1e-10):
        points = along_y([(-1, 0.0), (1, 0.0), (0.5, top), (-0.5, top + rise)])
        body = polygon(points, displacement=0.5, discretization_length=0.5)
        x, _, z = body.generate(np.ones(3)).position.T
        assert (np.abs(x) < 1 - 0.5 * z / 0.625).all()
        assert len(x) in (2 * (8 + 6), 2 * (8 + 6 + 4))


def test_too_few_points_are_a_problem():
    ((key, message),) = polygon([(0, 0, 0), (1, 0, 0)]).problems()
    assert (key, message) == ("points", "has 2 points and needs at least 3")
    assert list(polygon(along_y(SQUARE)).problems()) == []


STAR = [(0.5, 1.0), (0.79, 0.1), (0.02, 0.65), (0.98, 0.65), (0.21, 0.1)]
BOW = [(0.0, 0.0), (1.0, 1.0), (1.0, 0.0), (0.0, 1.0)]
FRAME = [(0, 0), (3, 0), (3, 3), (0, 3), (0, 0), (1, 1), (1, 2), (2, 2), (2, 1), (1, 1)]


@pytest.mark.parametrize("direction", ["x", "y", "z"])
@pytest.mark.parametrize(
    ("outline", "message"),
    [
        (STAR, "the edge from points[0] to points[1] crosses the one from points[2] to points[3]"),
        (BOW, "the edge from points[0] to points[1] crosses the one from points[2] to points[3]"),
        (
            SQUARE * 2,
            "the edge from points[0] to points[1] is there once more from points[4] to points[5]",
        ),
    ],
)
def test_an_outline_that_crosses_itself_is_told_of(direction, outline, message):
    axis = "xyz".index(direction)
    points = [tuple(np.insert(point, axis, 0.0)) for point in outline]
    ((key, text),) = polygon(points, direction).remarks()
    assert key == "points" and text.startswith(message) and "even-odd rule" in text


@pytest.mark.parametrize("outline", [SQUARE, SQUARE[::-1], FRAME, (*SQUARE, SQUARE[0])])
@pytest.mark.parametrize("scale", [1e-3, 1.0, 1e6])
@pytest.mark.parametrize("turn", [0.0, 0.3])
def test_outlines_that_touch_themselves_do_not_cross(outline, scale, turn):
    """A square, a frame with a slit to its hole, a corner given twice."""
    c, s = np.cos(turn), np.sin(turn)
    points = along_y(scale * (np.array(outline, float) @ [[c, s], [-s, c]]))
    assert list(polygon(points).remarks()) == []
