"""Mass that is counted twice is told of: bodies that overlap, particles at one place."""

import numpy as np
import pytest

import mpmgeo
from mpmgeo.case.building.lint import lint
from mpmgeo.case.load import load_case

BLOCK = {"type": "cuboid", "point_p1": [0, 0, 0], "point_p2": [1, 1, 1], "material_id": 1}
BALL = {"type": "sphere", "center": [1, 1, 1], "diameter": 1, "material_id": 1}
WEDGE = {
    "type": "polygon_2d",
    "points": [[0, 0, 0], [2, 0, 0], [0, 0, 2]],
    "extrude_direction": "y",
    "extrude_displacement": 1,
    "material_id": 1,
}


def warnings_of(case, **bodies):
    case["body"] = bodies
    return lint(mpmgeo.Simulation(load_case(case)))


def listed(*positions):
    particles = {"position": list(positions), "volume": len(positions) * [0.01]}
    return {"type": "particles", "particles": particles, "material_id": 1}


def test_the_same_body_twice(case):
    assert warnings_of(case, a=BLOCK, b=BLOCK) == [
        "body 1 (cuboid) and body 2 (cuboid) overlap: 64 particles of body 2 lie in the other one, "
        "2000 kg are counted twice"
    ]


@pytest.mark.parametrize("shift", [0.5, 0.3])
def test_a_part_of_a_body(case, shift):
    """What is there twice is what the boxes have in common, to a layer of particles."""
    other = BLOCK | {"point_p1": [shift, 0, 0], "point_p2": [1 + shift, 1, 1]}
    (warning,) = warnings_of(case, a=BLOCK, b=other)
    mass = float(warning.partition("other one, ")[2].partition(" kg")[0])
    assert mass == pytest.approx(2000 * (1 - shift), abs=2000 * 0.25 * 0.51)


def test_bodies_of_different_kinds(case):
    ball_in_block, ball_in_wedge, wedge_in_block = warnings_of(case, a=BLOCK, b=BALL, c=WEDGE)
    assert ball_in_block.startswith("body 1 (cuboid) and body 2 (sphere) overlap: 4 particles of")
    assert wedge_in_block.startswith("body 2 (sphere) and body 3 (polygon_2d) overlap: ")
    assert ball_in_wedge.startswith("body 1 (cuboid) and body 3 (polygon_2d) overlap: ")


def test_a_list_in_a_body_before_or_behind_it(case):
    lump = listed([0.3, 0.4, 0.5], [1.5, 1.5, 1.5])
    for bodies in ({"a": BLOCK, "b": lump}, {"a": lump, "b": BLOCK}):
        (warning,) = warnings_of(case, **bodies)
        assert "1 particles of body" in warning and "20 kg are counted twice" in warning


def test_bodies_that_touch_do_not_overlap(case):
    """Also where the cells of one of them do not end at its edge, and far from (0, 0, 0)."""
    above = BLOCK | {"point_p1": [0, 0, 1.0], "point_p2": [1, 1, 1.5]}
    left = WEDGE | {"points": [[1, 0, 0], [1.5, 0, 0], [1, 0, 0.7]]}
    right = WEDGE | {"points": [[1.5, 0, 0], [1.5, 0, 0.7], [1, 0, 0.7]]}
    assert warnings_of(case, a=BLOCK, b=above, c=left, d=right) == []
    origin = [500_000.1, 4_500_000.1, 100.1]
    case["mesh"]["origin"] = origin
    moved = [
        body | {key: (np.array(body[key]) + origin).tolist() for key in ("point_p1", "point_p2")}
        for body in (BLOCK, above)
    ]
    assert warnings_of(case, a=moved[0], b=moved[1]) == []


def test_particles_at_one_place(case):
    place, other = [0.3, 0.4, 0.5], [0.7, 0.4, 0.5]
    assert warnings_of(case, a=listed(place, other, place, place)) == [
        "2 particles lie where others do, the first of them row 2 at (0.3, 0.4, 0.5) m: "
        "40 kg are counted twice"
    ]
    (warning,) = warnings_of(case, a=listed(place, other), b=listed([0.3, 0.4, 0.5 + 1e-9]))
    assert warning.startswith("1 particles lie where others do, the first of them row 2")
    assert warnings_of(case, a=listed(place), b=listed([0.3, 0.4, 0.51])) == []
