"""The JSON Schema: valid itself, up to date in the repository, and of one mind with the loader."""

import json
from pathlib import Path

import pytest
from jsonschema import Draft202012Validator

from mpmgeo.bodies import BODIES
from mpmgeo.case.canonical import plain
from mpmgeo.case.kinds import declared
from mpmgeo.case.load import load_case, resolved
from mpmgeo.case.reading.aliases import ALIASES
from mpmgeo.case.reading.schema import CONTAINERS, case_schema
from mpmgeo.case.spec import Case
from mpmgeo.case.tables import MARK, schema_text, tables
from mpmgeo.damping import DAMPINGS
from mpmgeo.materials import LAWS

ROOT = Path(__file__).parents[4]


def is_valid(case):
    return Draft202012Validator(case_schema()).is_valid(case)


def test_schema_is_a_schema():
    Draft202012Validator.check_schema(case_schema())


def test_committed_schema_is_up_to_date():
    committed = (ROOT / "schemas" / "case.schema.json").read_text(encoding="utf-8")
    assert committed == schema_text(), "run: python -m mpmgeo.case.tables"


def test_manual_is_up_to_date():
    page = (ROOT / "manual" / "input.md").read_text(encoding="utf-8")
    assert page.partition(MARK)[2] == tables(), "run: python -m mpmgeo.case.tables"


def test_manuals_example_is_a_case():
    page = (ROOT / "manual" / "input.md").read_text(encoding="utf-8")
    example = json.loads(page.split("```json")[1].split("```")[0])
    assert is_valid(example)
    assert load_case(example, strict=True).title == example["title"]


def test_every_registered_class_has_a_definition():
    definitions = case_schema()["$defs"]
    for place, classes in {"materials": LAWS, "body": BODIES, "damping": DAMPINGS}.items():
        for cls in classes:
            part = definitions[f"{place}_{cls.type}"]
            assert {item.key for item in declared(cls)} <= part["properties"].keys()


def test_every_key_is_described():
    definitions = case_schema()["$defs"]
    for part in (case_schema(), *definitions.values()):
        for key, value in part["properties"].items():
            assert key == "type" or value["description"]


def test_containers():
    assert {("materials",), ("body",), ("nodal_point_load",), ("results", "probes")} < {*CONTAINERS}


def test_old_spellings_are_known_to_editors(case):
    case["material"] = case.pop("materials")
    case |= {"time_step_multiplier": 0.3, "results": {"fields": ["stress"]}}
    case["damping"] = {"type": "local", "alpha": 0.1}
    assert is_valid(case)
    top = case_schema()["properties"]
    assert top["time_step_multiplier"]["deprecated"]
    assert "deprecated" not in top["material"]
    assert all(alias.old in json.dumps(case_schema()) for alias in ALIASES)


@pytest.mark.parametrize(
    "keys",
    [{"tme": 1}, {"time": 0}, {"body": []}, {"mesh": {}}, {"gravity": [0, 0]}, {"time": True}],
)
def test_editors_flag_errors(case, keys):
    assert is_valid(case)
    assert not is_valid(case | keys)


def test_one_of_material_and_materials_is_required(case):
    del case["materials"]
    assert not is_valid(case)


def test_resolved_case_is_valid_and_loads_to_the_same_case(case):
    case |= {
        "nodal_point_load": [[[1, 1, 1], [0, 0, -1]]],
        "load_distributed_box": [{"point_p1": [0, 0, 0], "point_p2": [1, 1, 1], "load": [1, 2, 3]}],
        "damping": {"type": "local", "value": 0.1},
        "compatibility": "mpm-geomechanics",
        "expected": {"any": [1, {"thing": None}]},
    }
    loaded = load_case(case)
    text = json.loads(json.dumps(resolved(loaded)))
    assert is_valid(text)
    assert load_case(text, strict=True) == loaded
    assert text["nodal_point_load"] == [[[1.0, 1.0, 1.0], [0.0, 0.0, -1.0]]]


def test_defaults_are_in_the_schema_and_filled_in(case):
    loaded = resolved(load_case(case))
    for key, _, item in declared(Case):
        schema = case_schema()["properties"][key]
        if "default" in schema and key not in case:
            assert loaded[key] == schema["default"] == plain(item.default)
