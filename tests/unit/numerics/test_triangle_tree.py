"""The tree finds the triangle that a look at all of them finds."""

import numpy as np
import pytest

from mpmgeo.numerics.triangle_tree import (
    DEPTH,
    FACE,
    LEAF,
    build,
    closest,
    first_of_nearest,
    nearest,
)


def distance(corner, t, x):
    *point, _ = closest(corner, t, *x)
    return np.linalg.norm(np.array(point) - x)


def soup(count, seed=0, stretch=(1.0, 1.0, 1.0)):
    """Return triangles of all sizes anywhere in a box."""
    random = np.random.default_rng(seed)
    middle = random.uniform(-1, 1, (count, 1, 3))
    size = 10 ** random.uniform(-3, 0.5, (count, 1, 1))
    return (middle + size * random.normal(size=(count, 3, 3))) * stretch


@pytest.mark.parametrize("count", [1, 2, LEAF, LEAF + 1, 37, 300])
@pytest.mark.parametrize("stretch", [(1, 1, 1), (100, 1, 0)])
def test_nearest_is_the_nearest(count, stretch):
    tree = build(soup(count, stretch=stretch))
    waiting = np.empty(DEPTH, np.int64)
    guess = 0
    for x in np.random.default_rng(1).uniform(-3, 3, (60, 3)):
        guess = nearest(tree, *x, guess, waiting)
        least = min(distance(tree.corner, t, x) for t in range(count))
        assert distance(tree.corner, guess, x) == least


def test_the_tree_holds_every_triangle_once_inside_its_boxes():
    corner = soup(1000)
    tree = build(corner)
    assert sorted(tree.number) == list(range(1000))
    assert (tree.corner == corner[tree.number]).all()
    leaves = len(tree.first) - 1
    assert np.diff(tree.first).max() <= LEAF
    assert np.diff(tree.first).min() >= 1
    for leaf in range(leaves):
        inside = tree.corner[tree.first[leaf] : tree.first[leaf + 1]].reshape(-1, 3)
        i = leaves - 1 + leaf
        while True:
            assert (inside >= tree.box[i, :3]).all()
            assert (inside <= tree.box[i, 3:]).all()
            if i == 0:
                break
            i = (i - 1) // 2


def test_of_several_nearest_triangles_the_first_one_counts():
    corner = np.array(
        [[[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 0, 0], [0, 1, 0], [-1, 0, 0]]], float
    )
    for order in ([0, 1], [1, 0]):
        tree = build(corner[order])
        for guess in (0, 1):
            found = nearest(tree, 0.0, 0.5, 1.0, guess, np.empty(DEPTH, np.int64))
            assert tree.number[found] == 0


def test_above_an_edge_the_first_one_counts_where_round_off_decides():
    """The edge of a ridge, seen from both sides in skew coordinates; the third one is farther."""
    random = np.random.default_rng(3)
    waiting, decided = np.empty(DEPTH, np.int64), 0
    for _ in range(200):
        a, b = random.uniform(-1, 1, (2, 3))
        along = (b - a) / np.linalg.norm(b - a)
        up = np.cross(along, random.uniform(-1, 1, 3))
        side = np.cross(along, up)
        left, right = (a + q * side - up for q in (-1, 1))
        x = a + random.uniform(0.2, 0.8) * (b - a) + 0.3 * up
        far = np.array([a, left, b]) - 0.1 * up
        tree = build(np.array([far, [a, b, left], [right, b, a]]))
        order = list(tree.number)
        for guess in range(3):
            t = nearest(tree, *x, guess, waiting)
            decided += order[t] == 2
            assert order[first_of_nearest(tree, *x, t, waiting)] == 1
    assert decided > 0


@pytest.mark.parametrize(
    ("x", "point", "part"),
    [
        ((-1, -1, 1), (0, 0, 0), 0),
        ((3, -1, 0), (2, 0, 0), 1),
        ((-1, 5, 0), (0, 2, 0), 2),
        ((1, -1, 2), (1, 0, 0), 3),
        ((2, 2, -3), (1, 1, 0), 4),
        ((-2, 1, 1), (0, 1, 0), 5),
        ((0.5, 0.5, -4), (0.5, 0.5, 0), FACE),
    ],
)
def test_parts_of_a_triangle(x, point, part):
    corner = np.array([[[0, 0, 0], [2, 0, 0], [0, 2, 0]]], float)
    *found, where = closest(corner, 0, *map(float, x))
    assert found == pytest.approx(point)
    assert where == part
