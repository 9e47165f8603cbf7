"""Parts that are switched off change nothing; a switch of another type is an error."""

import pytest

from mpmgeo.case.load import CaseError, load_case

NEUTRAL = [
    {"n_phases": 1},
    {"n_phases": 1.0},
    {"save_state": False, "load_state": False},
    {"terrain_contact": {"active": False, "stl_mesh": "none.stl", "friction": "any"}},
    {"terrain_contact": {}},
    {"hydro_mechanical_coupling": {"enabled": False, "type": "one_way"}},
    {"prescribed_pressure_box": {}, "initial_pressure_box": []},
    {"initial_pressure_material": [], "pressure_force_box": {}},
    {"results": {"stl_contact_mesh": "none"}},
    {"results": {"stl_contact_mesh": ["none"]}},
    {"terrain_contact": None, "n_phases": None},
    {"earthquake": {"active": False}},
    {"earthquake": {"active": False, "file": "missing.csv"}},
    {"earthquake": {}},
]


@pytest.mark.parametrize("keys", NEUTRAL, ids=str)
def test_neutral_values_change_nothing(case, keys):
    assert load_case(case | keys, strict=True) == load_case(case)


@pytest.mark.parametrize(
    "keys",
    [
        {"n_phases": 1.5},
        {"n_phases": True},
        {"save_state": "no"},
        {"terrain_contact": {"active": 0}},
        {"hydro_mechanical_coupling": True},
        {"earthquake": {"active": "yes"}},
    ],
)
def test_switches_have_their_types(case, keys):
    with pytest.raises(CaseError, match="is not accepted") as caught:
        load_case(case | keys)
    assert "not supported" not in str(caught.value)


def test_a_record_without_the_switch_is_warned_of(case):
    case["earthquake"] = {"file": "record.csv"}
    assert load_case(case).warnings == ('earthquake: without effect, since "active" is not true',)


def test_inactive_bodies_of_other_kinds_are_left_out(case):
    block = case["body"]["block"]
    case["body"] = [{"type": "gmsh", "active": False}, block | {"material_id": 9}]
    with pytest.raises(CaseError) as caught:
        load_case(case)
    assert caught.value.problems[0].startswith("body[1].material_id: 9")
    case["body"] = {"a": {"type": "particles", "active": False}, "b": block}
    loaded = load_case(case)
    assert [body.type for body in loaded.body] == ["cuboid"]
    assert loaded.notes == ("body.a: inactive",)
