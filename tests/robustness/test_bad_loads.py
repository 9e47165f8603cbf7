"""Loads, probes and fields that make no sense: a clear message, exit code 2, nothing written."""

import pytest
from refusal import refusal_of

NOT = "is not accepted; accepted:"
BOX = {"point_p1": [0, 0, 0], "point_p2": [1, 1, 1]}
TURNED = {"point_p1": [0, 0, 0], "point_p2": [1, 1, -1]}
STILL = {"velocity": [0, 0, 0]}
POINTS = {"enabled": True, "pore_pressure_field": "pressures.json"}


@pytest.fixture(autouse=True)
def nothing_is_written(folder):
    yield
    assert not (folder / "out").exists()


def refused(case, keys, capsys):
    """Return what the program says about a case that it refuses to run."""
    return refusal_of(case | keys, capsys)


VELOCITIES = [
    (5, "prescribed_velocity: 5"),
    ([5], f"prescribed_velocity[0]: 5 {NOT} an object"),
    ([{}], '[0].body: needs one of "body", "plane" or "point_p1" with "point_p2"'),
    ([{}], 'prescribed_velocity[0].velocity: needs either "velocity" or "file"'),
    ({"a": STILL}, 'prescribed_velocity.a.body: needs one of "body", "plane" or'),
    ({"a": STILL | {"body": 1, "plane": "Z0"}}, "prescribed_velocity.a.body: needs one of"),
    ({"a": STILL | BOX | {"plane": "Z0"}}, "prescribed_velocity.a.body: needs one of"),
    ({"a": STILL | {"point_p1": [0, 0, 0]}}, "point_p1 and point_p2 are given together"),
    ({"a": STILL | TURNED}, "prescribed_velocity.a.point_p2: z is -1, below that of point_p1, 0"),
    ({"a": STILL | {"body": 0}}, f"prescribed_velocity.a.body: 0 {NOT} a whole number at least 1"),
    ({"a": STILL | {"body": "wegde"}}, 'prescribed_velocity.a.body: "wegde"'),
    ({"a": STILL | {"body": 4}}, "there is no body 4; bodies are numbered from 1 to 3"),
    ({"a": STILL | {"plane": "z0"}}, f'prescribed_velocity.a.plane: "z0" {NOT} "X0", "Y0", "Z0"'),
    ({"a": STILL | {"plane": "Z0"}}, "prescribed_velocity.a.plane: Z0 is moved by earthquake"),
    ([STILL | {"plane": "X0"}] * 2, "X0 is moved by prescribed_velocity[0]"),
    ({"a": BOX | {"velocity": [0, 0]}}, f".velocity: [0, 0] {NOT} a list of 3 numbers or null"),
    ({"a": BOX | {"velocity": 1}}, f"prescribed_velocity.a.velocity: 1 {NOT} a list of 3 numbers"),
    ({"a": BOX | {"velocity": [0, "0", 0]}}, f'velocity[1]: "0" {NOT} a number or null'),
    ({"a": BOX | {"velocity": [None] * 3}}, "velocity: leaves all components free"),
    ({"a": BOX | {"velocity": [0, 0, float("nan")]}}, "velocity[2]: NaN is no finite number"),
    ({"a": BOX | STILL | {"file": "record.csv"}}, 'velocity: needs either "velocity" or "file"'),
    ({"a": BOX | {"file": "none.csv"}}, 'a.file: there is no file "none.csv" in'),
    ({"a": BOX | {"file": 3}}, f"prescribed_velocity.a.file: 3 {NOT} text"),
    ({"a": BOX | STILL | {"every": 0}}, f".every: 0 {NOT} a whole number at least 1"),
    ({"a/b": BOX | STILL}, f'."a/b".name: "a/b" {NOT} up to 60 letters'),
    ({"..": BOX | STILL}, f'".." {NOT} up to 60 letters'),
    ([BOX | STILL | {"name": "q" * 61}], f"{NOT} up to 60 letters, digits, blanks"),
    ([BOX | STILL | {"name": "q\n"}], "prescribed_velocity[0].name: "),
    ([BOX | STILL | {"name": 4}], f"prescribed_velocity[0].name: 4 {NOT} text"),
    ([BOX | STILL | {"name": n} for n in ("Ram", "ram")], '"ram" is taken by prescribed_velocity'),
]


@pytest.mark.parametrize(("entries", "message"), VELOCITIES, ids=str)
def test_prescribed_velocity(case, entries, message, capsys):
    assert message in refused(case, {"prescribed_velocity": entries}, capsys)


TABLES = {
    "empty": (b"", "v.csv: no line with time and three velocities"),
    "heading only": (b"t,vx,vy,vz\n", "v.csv: no line with time and three velocities"),
    "three columns": (b"t,vx,vy\n0,0,0\n", "v.csv, line 2: needs time and three velocities"),
    "a word": (b"t,vx,vy,vz\n0,0,0,fast\n", "v.csv, line 2: 'fast' is not a number"),
    "NaN": (b"t,vx,vy,vz\n0,0,0,nan\n", "v.csv, line 2: not all numbers are finite"),
    "unsorted": (b"1,0,0,0\n0,0,0,0\n", "line 2: time 0 s does not exceed the time before it, 1 s"),
    "twice": (b"0,0,0,0\n0,0,0,0\n", "line 2: time 0 s does not exceed the time before it, 0 s"),
    "all free": (b"0,,,\n", "v.csv: all components are free"),
    "free at times": (b"0,,0,0\n1,1,0,0\n", "line 2: a column is free in all lines or in none"),
    "decimal commas": (b"0;0;0;0,5\n1;0;0;0,5\n", "'0,5' has a decimal comma; write a point"),
    "binary": (bytes(range(256)), "v.csv, line 3: needs time and three velocities"),
}


@pytest.mark.parametrize("name", TABLES)
def test_table_of_velocities(case, folder, name, capsys):
    text, message = TABLES[name]
    (folder / "v.csv").write_bytes(text)
    shown = refused(case, {"prescribed_velocity": {"a": BOX | {"file": "v.csv"}}}, capsys)
    assert message in shown
    assert "error: prescribed_velocity.a.file: " in shown


VALUE = {"value": [0, 0, -9.81]}
RAMP = {"ramp": {"type": "sine", "duration": 10}}
ONLY_ONE = 'only one of "time" with "factor", "factor_file" or "ramp" can be given'

IN_TIME = [
    ({"time": [0, 1], "factor": [1]}, "factor: has 1 values for 2 instants in time"),
    ({"time": [0, 2, 1], "factor": [0, 1, 2]}, "time: 1 s does not exceed the instant before it"),
    ({"time": [0, 0], "factor": [0, 1]}, "time: 0 s does not exceed the instant before it, 0 s"),
    ({"time": [], "factor": []}, "time: holds no instant; at least one is needed"),
    ({"time": [0, 1]}, 'time: "time" and "factor" are given together'),
    ({"factor": [1]}, 'factor: "time" and "factor" are given together'),
    ({"time": 0, "factor": [1]}, f"time: 0 {NOT} a list of numbers"),
    ({"time": [0], "factor": ["1"]}, f'factor[0]: "1" {NOT} a number'),
    ({"time": [0], "factor": [float("nan")]}, "factor[0]: NaN is no finite number"),
    ({"time": [0], "factor": [1]} | RAMP, f"ramp: {ONLY_ONE}"),
    ({"factor_file": "record.csv"} | RAMP, f"ramp: {ONLY_ONE}"),
    ({"time": [0], "factor": [1], "factor_file": "record.csv"}, f"factor_file: {ONLY_ONE}"),
    ({"factor_file": "none.csv"}, 'factor_file: there is no file "none.csv" in'),
    ({"factor_file": "record.csv"}, "record.csv, line 1: the columns are 't, ax, ay, az'; needed:"),
    ({"ramp": {"type": "cubic", "duration": 1}}, f'ramp.type: "cubic" {NOT} "sine"'),
    ({"ramp": {"type": "sine"}}, "ramp.duration: missing; needed: a number above 0"),
    ({"ramp": {"type": "sine", "duration": 0}}, f"ramp.duration: 0 {NOT} a number above 0"),
    ({"ramp": {"duration": 1}}, 'ramp.type: missing; needed: "sine"'),
    ({"ramp": "sine"}, f'ramp: "sine" {NOT} an object'),
]
FORCE = {"point": [1, 1, 1], "force": [0, 0, 1]}


@pytest.mark.parametrize(("keys", "message"), IN_TIME, ids=str)
def test_gravity_in_time(case, keys, message, capsys):
    shown = refused(case, {"gravity": VALUE | keys}, capsys)
    assert "error: gravity." in shown and message in shown


@pytest.mark.parametrize(("keys", "message"), IN_TIME[::4], ids=str)
def test_loads_in_time(case, keys, message, capsys):
    boxes = {"top": BOX | {"load": [0, 0, 1]} | keys}
    shown = refused(case, {"load_distributed_box": boxes}, capsys)
    assert f"load_distributed_box.top.{message}" in shown
    shown = refused(case, {"nodal_point_load": {"tip": FORCE | keys}}, capsys)
    assert f"nodal_point_load.tip.{message}" in shown


@pytest.mark.parametrize(
    ("gravity", "message"),
    [
        (5, f"gravity: 5 {NOT} a list of 3 numbers, or an object"),
        ([0, 0], f"gravity: [0, 0] {NOT} a list of 3 numbers, or an object"),
        ({}, "gravity.value: missing; needed: a list of 3 numbers"),
        ({"value": -9.81}, f"gravity.value: -9.81 {NOT} a list of 3 numbers"),
        ([[0, 0, -9.81], [0, 1], [0, 1]], f"gravity[0]: [0, 0, -9.81] {NOT} a number"),
    ],
)
def test_gravity(case, gravity, message, capsys):
    assert message in refused(case, {"gravity": gravity}, capsys)


@pytest.mark.parametrize(
    ("keys", "where"),
    [
        ({"gravity": VALUE | RAMP}, "gravity.ramp"),
        (
            {"load_distributed_box": [BOX | {"load": [0, 0, 1]} | RAMP]},
            "load_distributed_box[0].r",
        ),
        ({"nodal_point_load": [FORCE | {"time": [0], "factor": [1]}]}, "nodal_point_load[0].time"),
    ],
)
def test_loads_in_time_with_compatibility(case, keys, where, capsys):
    case.pop("results")
    shown = refused(case, keys | {"compatibility": "mpm-geomechanics"}, capsys)
    assert f"error: {where}" in shown and "MPM-Geomechanics knows no loads in time" in shown


PRESSURES = [
    ({"prescribed_pressure_box": [{}]}, "prescribed_pressure_box[0].point_p1: missing"),
    ({"prescribed_pressure_box": [BOX]}, "[0].pressure: missing; needed: a number (Pore pressure"),
    ({"prescribed_pressure_box": {"a": BOX | {"pressure": "1"}}}, f'.a.pressure: "1" {NOT} a numb'),
    ({"prescribed_pressure_box": [TURNED | {"pressure": 1}]}, "[0].point_p2: z is -1, below that"),
    ({"initial_pressure_box": 3}, "initial_pressure_box: 3"),
    ({"initial_pressure_box": [BOX | {"pressure": float("inf")}]}, "Infinity is no finite number"),
    ({"initial_pressure_material": [{"pressure": 1}]}, "[0].material_id: missing; needed: a whole"),
    ({"initial_pressure_material": [{"material": 1}]}, "[0].pressure: missing; needed: a number"),
    ({"initial_pressure_material": [{"material": 7, "pressure": 1}]}, "7 is no id of a material"),
    ({"initial_pressure_material": [{"material_id": 1.5, "pressure": 1}]}, "[0].material_id: 1.5"),
    ({"pressure_force_box": [BOX | {"pressure_force": 1}]}, f"[0].pressure_force: 1 {NOT} a list"),
    ({"pressure_force_box": [BOX]}, "pressure_force_box[0].pressure_force: missing"),
    ({"pressure_force_box": [{"pressure_force": [0, 0, 1]}]}, "[0].point_p1: missing"),
]


@pytest.mark.parametrize(("keys", "message"), PRESSURES, ids=str)
def test_pressures(case, keys, message, capsys):
    assert message in refused(case, keys, capsys)


COUPLINGS = [
    (True, f"hydro_mechanical_coupling: true {NOT} an object"),
    ({"enabled": "yes"}, f'hydro_mechanical_coupling.enabled: "yes" {NOT} true or false'),
    ({"enabled": True}, "coupling.pore_pressure_field: is required when enabled is true"),
    (POINTS | {"type": "two_way"}, f'hydro_mechanical_coupling.type: "two_way" {NOT} "one_way"'),
    (POINTS | {"pore_pressure_field": 3}, f"coupling.pore_pressure_field: 3 {NOT} text"),
    (POINTS | {"pore_pressure_field": "no.json"}, 'there is no file "no.json" in'),
    (POINTS | {"interpolation": "cubic"}, f'.interpolation: "cubic" {NOT} "nearest", "linear"'),
    (POINTS | {"radius": 0}, f"hydro_mechanical_coupling.radius: 0 {NOT} a number above 0"),
]


@pytest.mark.parametrize(("part", "message"), COUPLINGS, ids=str)
def test_coupling(case, part, message, capsys):
    assert message in refused(case, {"hydro_mechanical_coupling": part}, capsys)


FIELDS = {
    "empty": ("", "pressures.json: not JSON: line 1, column 1"),
    "no JSON": ("[{]", "pressures.json: not JSON: line 1, column 3"),
    "an object": ("{}", 'pressures.json: needs a list of objects with "position" and "pressure"'),
    "an empty list": ("[]", "pressures.json: the list is empty"),
    "a number": ("[1]", "pressures.json, entry 1: needs an object { … }, has 1"),
    "no position": ('[{"pressure": 1}]', 'entry 1: "position" is missing'),
    "no pressure": ('[{"position": [0, 0, 0]}]', 'entry 1: "pressure" is missing'),
    "two numbers": ('[{"position": [0, 0], "pressure": 1}]', '"position" needs three finite numb'),
    "a word": ('[{"position": [0, 0, "0"], "pressure": 1}]', '"position" needs three finite numb'),
    "NaN": ('[{"position": [0, 0, 0], "pressure": NaN}]', '"pressure" needs a finite number'),
    "infinite": ('[{"position": [0, 0, 1e999], "pressure": 1}]', '"position" needs three finite'),
    "text": ('[{"position": [0, 0, 0], "pressure": "1"}]', '"pressure" needs a finite number, has'),
}


@pytest.mark.parametrize("name", FIELDS)
def test_file_of_pore_pressures(case, folder, name, capsys):
    text, message = FIELDS[name]
    (folder / "pressures.json").write_text(text)
    shown = refused(case, {"hydro_mechanical_coupling": POINTS}, capsys)
    assert message in shown
    assert "error: hydro_mechanical_coupling.pore_pressure_field: " in shown


def probe(**keys):
    return {"type": "particles", "ids": [0], "fields": ["stress"]} | keys


POINT = {"type": "points", "points": [[0, 0, 0]], "fields": ["stress"]}
PROBES = [
    (5, "results.probes: 5"),
    ([5], f"results.probes[0]: 5 {NOT} an object"),
    ([{}], 'results.probes[0].type: missing; needed: "points", "particles", "box", "planes"'),
    ({"a": {"type": "point"}}, 'did you mean "points"?'),
    (
        {"a": {"type": "points"}},
        "results.probes.a.points: missing; needed: a list of lists of 3 nu",
    ),
    ({"a": {"type": "points"}}, "results.probes.a.fields: missing; needed: a list of words out of"),
    ({"a": POINT | {"points": []}}, "results.probes.a.points: needs at least one point"),
    ({"a": POINT | {"points": [0, 0, 0]}}, f"results.probes.a.points[0]: 0 {NOT} a list"),
    ({"a": POINT | {"points": [[0, 0]]}}, f"results.probes.a.points[0]: [0, 0] {NOT} a list of"),
    ({"a": POINT | {"interpolation": "cubic"}}, f'"cubic" {NOT} "linear", "nearest"'),
    ({"a": POINT | {"fields": []}}, "results.probes.a.fields: needs at least one field"),
    ({"a": POINT | {"fields": ["stres"]}}, 'did you mean "stress"?'),
    ({"a": POINT | {"fields": ["porosity"]}}, f'fields[0]: "porosity" {NOT}'),
    ({"a": POINT | {"fields": ["all"]}}, f'fields[0]: "all" {NOT}'),
    ({"a": POINT | {"every": 0}}, f"results.probes.a.every: 0 {NOT} a whole number at least 1"),
    ({"a": POINT | {"every": 1.5}}, f"results.probes.a.every: 1.5 {NOT} a whole number"),
    ({"a": probe(ids=[])}, "results.probes.a.ids: needs at least one number"),
    ({"a": probe(ids=[-1])}, f"results.probes.a.ids[0]: -1 {NOT} a whole number at least 0"),
    ({"a": probe(ids=[10**6])}, "results.probes, a: there is no particle 1000000; they are numb"),
    ({"a": probe(ids="0")}, f'results.probes.a.ids: "0" {NOT} a list of whole numbers'),
    ({"a\\b": probe()}, f"{NOT} up to 60 letters, digits, blanks"),
    ([probe(name="q"), probe(name="Q")], 'probes[1].name: "Q" is taken by results.probes[0]'),
    ([probe(type="box")], "results.probes[0].point_p1: missing; needed: a list of 3 numbers"),
    ([BOX | probe(type="box", reduction="max")], f'"max" {NOT} "mean", "sum"'),
    ([TURNED | probe(type="box")], "results.probes[0].point_p2: z is -1, below that of point_p1"),
    ([{"type": "planes", "planes": []}], "results.probes[0].planes: needs at least one plane"),
    ([{"type": "planes", "planes": ["Z1"]}], f'results.probes[0].planes[0]: "Z1" {NOT} "X0", "Y0"'),
]


@pytest.mark.parametrize(("probes", "message"), PROBES, ids=str)
def test_probes(case, probes, message, capsys):
    results = case["results"] | {"probes": probes}
    assert message in refused(case, {"results": results}, capsys)


@pytest.mark.parametrize(
    ("keys", "message"),
    [
        ({"stl_contact_mesh": 5}, "results.stl_contact_mesh: 5"),
        ({"stl_contact_mesh": [5]}, "results.stl_contact_mesh[0]: 5"),
        ({"material_point_results": [["strain"]]}, "results.material_point_results[0]: "),
    ],
)
def test_fields_of_files(case, keys, message, capsys):
    assert message in refused(case, {"results": case["results"] | keys}, capsys)
