"""Materials and bodies by name where a number is wanted."""

import pytest

from mpmgeo.case.load import CaseError, load_case

BALL = {"type": "sphere", "center": [1, 1, 1], "diameter": 0.5, "material_id": 1}
MOVES = {"velocity": [0, 0, 1]}


def problems(case):
    with pytest.raises(CaseError) as caught:
        load_case(case)
    return caught.value.problems


@pytest.fixture
def rich(case):
    """A case of two materials and three bodies, the middle one of them switched off."""
    case["materials"]["rock"] = case["materials"]["soil"] | {"id": 7}
    case["body"] |= {"idle": BALL | {"active": False}, "stone": BALL | {"material_id": "rock"}}
    return case


def test_a_material_by_name(rich):
    assert [body.material_id for body in load_case(rich).body if body.active] == [1, 7]


def test_a_material_by_name_wherever_one_is_named(rich):
    listed = {"position": [[1, 1, 1]], "volume": [1.0]}
    rich["body"] = {
        "a": {"type": "particles", "particles": listed, "material_id": "rock"},
        "b": {"type": "particles", "particles": listed | {"material_id": "rock"}},
    }
    rich["initial_pressure_material"] = [{"material_id": "rock", "pressure": 1.0}]
    loaded = load_case(rich)
    assert [body.material_id for body in loaded.body] == [7, 7]
    assert loaded.initial_pressure_material[0].material_id == 7


@pytest.mark.parametrize(("name", "number"), [("block", 1), ("stone", 2)])
def test_a_body_by_name_has_the_number_that_counts_active_ones(rich, name, number):
    rich["prescribed_velocity"] = {"ram": MOVES | {"body": name}}
    assert load_case(rich).prescribed_velocity[0].body == number


def test_bodies_after_one_of_several_groups(rich):
    groups = {"x": "rock", "y": 1, "z": 0}
    rich["body"] |= {"mesh": {"type": "gmsh", "mesh_file": "m.msh", "physical_to_material": groups}}
    rich["prescribed_velocity"] = [MOVES | {"body": "stone"}, MOVES | {"body": "mesh"}]
    several = '"mesh" stands for several bodies; write the number of one of them: 2, 3'
    assert f"prescribed_velocity[1].body: {several}" in problems(rich)
    rich["prescribed_velocity"].pop()
    assert not any("prescribed_velocity" in problem for problem in problems(rich))


def test_unknown_names_get_the_known_ones(rich):
    rich["body"]["block"]["material_id"] = "sol"
    rich["prescribed_velocity"] = [MOVES | {"body": "idle"}]
    assert problems(rich) == [
        'body.block.material_id: "sol" is not accepted; accepted: a whole number, without quotes, '
        'or a name out of materials: "rock", "soil"; did you mean "soil"?',
        'prescribed_velocity[0].body: "idle" is not accepted; accepted: a whole number, without '
        'quotes, or a name out of body: "block", "stone"',
    ]


def test_entries_of_a_list_have_no_names(case):
    case["materials"] = [case["materials"]["soil"]]
    case["body"]["block"]["material_id"] = "soil"
    assert problems(case) == [
        'body.block.material_id: "soil" is not accepted; accepted: a whole number, without quotes'
    ]


@pytest.mark.parametrize("id", [None, "x", 1.5, True, [1], float("inf")])
def test_a_material_without_a_usable_number_has_no_name(case, id):
    case["materials"]["soil"]["id"] = id
    case["body"]["block"]["material_id"] = "soil"
    assert any(problem.startswith("body.block.material_id: ") for problem in problems(case))
