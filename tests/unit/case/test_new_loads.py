"""Loads, probes and fields: names of entries, remarks on what does not act, canonical form."""

import json

import pytest
from jsonschema import Draft202012Validator

from mpmgeo.case.load import load_case, resolved
from mpmgeo.case.reading.explain import place_of
from mpmgeo.case.reading.schema import case_schema
from mpmgeo.output.fields import PARTICLE_FIELDS

BOX = {"point_p1": [0, 0, 0], "point_p2": [1, 1, 1]}
TIP = {"type": "particles", "ids": [0], "fields": ["strain", "mass"]}


def test_entries_are_named_by_their_keys_or_numbers(case):
    case["prescribed_velocity"] = {"ram": BOX | {"velocity": [0, None, 1]}}
    case["results"] = {"probes": [TIP, TIP | {"name": "tip"}]}
    loaded = load_case(case, strict=True)
    assert [entry.name for entry in loaded.prescribed_velocity] == ["ram"]
    assert [probe.name for probe in loaded.results.probes] == ["probe_1", "tip"]


def test_a_given_name_counts(case):
    case["prescribed_velocity"] = {"a": BOX | {"name": "b", "velocity": [0, None, 1]}}
    assert load_case(case).prescribed_velocity[0].name == "b"


def test_canonical_form_is_valid_and_loads_to_the_same_case(case, tmp_path):
    (tmp_path / "p.json").write_text('[{"position": [0, 0, 0], "pressure": 1}]')
    case |= {
        "prescribed_velocity": {"ram": BOX | {"velocity": [0, None, 1]}},
        "initial_pressure_material": [{"material": 1, "pressure": 5}],
        "prescribed_pressure_box": [BOX | {"pressure": 5}],
        "pressure_force_box": {"a": BOX | {"pressure_force": [0, 0, 1]}},
        "hydro_mechanical_coupling": {
            "enabled": True,
            "type": "one_way",
            "pore_pressure_field": str(tmp_path / "p.json"),
        },
        "results": {"probes": {"walls": {"type": "planes"}, "tip": TIP}},
    }
    loaded = load_case(case)
    text = json.loads(json.dumps(resolved(loaded)))
    assert Draft202012Validator(case_schema()).is_valid(text)
    assert load_case(text) == loaded
    assert text["prescribed_velocity"][0]["velocity"] == [0.0, None, 1.0]
    assert text["hydro_mechanical_coupling"]["type"] == "one_way"
    assert text["initial_pressure_material"] == [{"material_id": 1, "pressure": 5.0}]


def test_loads_in_time_in_canonical_form(case, tmp_path):
    (tmp_path / "f.csv").write_text("time,factor\n0,0\n1,1\n")
    ramp, table = {"ramp": {"type": "sine", "duration": 10}}, {"time": [0, 1], "factor": [1, 2]}
    case |= {
        "gravity": {"value": [0, 0, -9.81]} | ramp,
        "load_distributed_box": [BOX | {"load": [0, 0, 1], "factor_file": str(tmp_path / "f.csv")}],
        "nodal_point_load": [
            {"point": [1, 1, 1], "force": [0, 0, 1]} | table,
            {"point": [1, 1, 1], "force": [0, 0, 1]},
        ],
    }
    loaded = load_case(case, strict=True)
    text = json.loads(json.dumps(resolved(loaded)))
    assert Draft202012Validator(case_schema()).is_valid(case)
    assert Draft202012Validator(case_schema()).is_valid(text)
    assert load_case(text) == loaded
    assert text["gravity"] == case["gravity"]
    assert text["nodal_point_load"] == [case["nodal_point_load"][0], [[1, 1, 1], [0, 0, 1]]]
    assert text["load_distributed_box"][0]["factor_file"] == str(tmp_path / "f.csv")
    assert load_case(case | {"gravity": {"value": [0, 0, -9.81]}}).gravity.course is None


def test_a_file_of_factors_lies_beside_the_case(case, tmp_path):
    (tmp_path / "f.csv").write_text("0,1\n")
    case["gravity"] = {"value": [0, 0, -9.81], "factor_file": "f.csv"}
    (tmp_path / "case.json").write_text(json.dumps(case))
    assert load_case(tmp_path / "case.json").gravity.factor_file == tmp_path / "f.csv"


@pytest.mark.parametrize(
    ("keys", "note"),
    [
        ({"prescribed_pressure_box": [BOX | {"pressure": 1}]}, "prescribed_pressure_box: has no"),
        ({"initial_pressure_box": [BOX | {"pressure": 1}]}, "initial_pressure_box: has no effect"),
        (
            {"initial_pressure_material": [{"material": 7, "material_id": 1, "pressure": 1}]},
            "initial_pressure_material: has no effect with one phase",
        ),
        ({"results": {"material_point_results": ["porosity"]}}, '"porosity" exists with two phase'),
        ({"results": {"stl_contact_mesh": ["stl_normal"]}}, '"stl_normal" exists with a terrain'),
    ],
)
def test_what_does_not_act_is_noted(case, keys, note):
    (found,) = load_case(case | keys, strict=True).notes
    assert note in found


@pytest.mark.parametrize("part", [{}, {"enabled": False, "pore_pressure_field": "missing.json"}])
def test_coupling_that_is_off_changes_nothing(case, part):
    assert load_case(case | {"hydro_mechanical_coupling": part}, strict=True) == load_case(case)


def test_coupling_without_its_switch_is_warned_of(case):
    part = {"type": "one_way", "pore_pressure_field": "missing.json"}
    (warning,) = load_case(case | {"hydro_mechanical_coupling": part}).warnings
    assert warning == 'hydro_mechanical_coupling: without effect, since "enabled" is not true'


def test_all_means_the_old_fields_and_new_ones_come_by_name(case):
    def fields(*words):
        return load_case(case | {"results": {"material_point_results": words}}).results

    assert fields("all").particle_fields == tuple(PARTICLE_FIELDS)
    more = fields("all", "volume", "strain").particle_fields
    assert more == (*PARTICLE_FIELDS, "strain", "volume")
    assert fields("none", "strain").particle_fields == ()
    assert fields("strain", "id").particle_fields == ("id", "strain")
    assert fields("porosity").particle_fields == ()


def test_fields_that_must_be_kept(case):
    case["results"] = {"material_point_results": ["id"], "probes": [TIP, {"type": "planes"}]}
    assert load_case(case).results.needed_fields == {"id", "strain", "mass"}


def test_places_of_entries_inside_objects():
    ids = place_of(("results", "probes", "tip", "ids", 0))
    assert ids == ("results", "probes", "*", "ids", "*")
    assert place_of(("results", "probes")) == ("results", "probes")
