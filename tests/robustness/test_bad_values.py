"""Impossible and malformed values: each is refused with its path, itself and what is accepted."""

import json

import pytest

from mpmgeo import cli
from mpmgeo.case.load import CaseError, load_case

ABSENT = object()
WEDGE = ("body", "wedge")
BLOCK = ("body", "block")
BALL = ("body", "ball")
SOIL = ("materials", "soil")
CELLS = ("mesh", "cells_number")
SIZES = ("mesh", "cells_dimension")
TOP = ("load_distributed_box", "top")
NOT = "is not accepted; accepted:"

BAD = [
    # time
    (("time",), ABSENT, "time: missing; needed: a number above 0 (Simulated time [s])"),
    (("time",), 0, f"time: 0 {NOT} a number above 0"),
    (("time",), -1, f"time: -1 {NOT} a number above 0"),
    (("time",), "1", f'time: "1" {NOT} a number above 0, without quotes'),
    (("time",), True, f"time: true {NOT} a number"),
    (("time",), [1], f"time: [1] {NOT} a number"),
    (("time",), {}, f"time: {{}} {NOT} a number"),
    (("time",), None, "time: missing"),
    (("time",), float("nan"), "time: NaN is no finite number"),
    (("time",), float("inf"), "time: Infinity is no finite number"),
    (("time",), 1e200, "time: 1e+200 is larger than any quantity here can be"),
    (("time",), 10**400, "time: Infinity is no finite number"),
    (("time",), 1e30, "time_step: 1e+33 steps of 0.001 s are needed, more than can be made"),
    (("time_step",), -1e-3, f"time_step: -0.001 {NOT} a number at least 0"),
    (("time_step",), "auto", f'time_step: "auto" {NOT} a number'),
    (("time_step",), 1e-320, "time_step: inf steps of 1e-320 s are needed"),
    (("critical_time_step_multiplier",), 0, f"critical_time_step_multiplier: 0 {NOT} a number a"),
    (("critical_time_step_multiplier",), -0.1, "critical_time_step_multiplier: -0.1"),
    # words and switches
    (("stress_scheme_update",), "usl", f'stress_scheme_update: "usl" {NOT} "USL", "MUSL"'),
    (("stress_scheme_update",), "RK4", f'stress_scheme_update: "RK4" {NOT}'),
    (("stress_scheme_update",), 1, f"stress_scheme_update: 1 {NOT}"),
    (("shape_function",), "LINEAR", 'did you mean "linear"?'),
    (("shape_function",), "", f'shape_function: "" {NOT} "GIMP", "linear"'),
    (("transfer",), "pic", f'transfer.type: "pic" {NOT} "flip", "apic", "tpic"'),
    (("transfer",), 0.99, f"transfer: 0.99 {NOT} an object {{ … }}, or the word of its type"),
    (("transfer",), {"flip": 0.99}, 'transfer.type: missing; needed: "flip", "apic", "tpic"'),
    (("transfer",), {"type": "flip", "flip": 1.01}, f"transfer.flip: 1.01 {NOT} a number at"),
    (("compatibility",), "yes", f'compatibility: "yes" {NOT} "mpm-geomechanics"'),
    (("n_phases",), 3, f"n_phases: 3 {NOT} 1, 2"),
    (("n_phases",), 1.5, f"n_phases: 1.5 {NOT} 1, 2"),
    (("conductivity_gravity",), 0, f"conductivity_gravity: 0 {NOT} a number above 0"),
    (("pore_pressure_smoothing",), 1, f"pore_pressure_smoothing: 1 {NOT} true or false"),
    (("n_threads",), 1.5, f"n_threads: 1.5 {NOT} a whole number at least 0"),
    (("n_threads",), -1, f"n_threads: -1 {NOT} a whole number at least 0"),
    (("n_threads",), "4", f'n_threads: "4" {NOT} a whole number at least 0, without quotes'),
    (("save_state",), "false", f'save_state: "false" {NOT} true or false'),
    (("load_state",), 1, f"load_state: 1 {NOT} true or false"),
    (("title",), 7, f"title: 7 {NOT} text in double quotes"),
    (("expected",), [1], f"expected: [1] {NOT} an object"),
    # vectors
    (("gravity",), -9.81, f"gravity: -9.81 {NOT} a list of 3 numbers, or an object"),
    (("gravity",), [0, -9.81], f"gravity: [0, -9.81] {NOT} a list of 3 numbers"),
    (("gravity",), [0, 0, 0, 0], f"gravity: [0, 0, 0, 0] {NOT} a list of 3 numbers"),
    (("gravity", 2), "down", f'gravity[2]: "down" {NOT} a number, without quotes'),
    (("gravity", 0), None, f"gravity[0]: null {NOT} a number"),
    (("gravity", 1), False, f"gravity[1]: false {NOT} a number"),
    (("gravity", 2), float("-inf"), "gravity[2]: -Infinity is no finite number"),
    # mesh
    (("mesh",), ABSENT, "mesh: missing; needed: an object { … } (The grid)"),
    (("mesh",), [], f"mesh: [] {NOT} an object {{ … }}"),
    (CELLS, ABSENT, "mesh.cells_number: missing; needed: a list of 3 whole numbers at least 1"),
    ((*CELLS, 0), 0, f"mesh.cells_number[0]: 0 {NOT} a whole number at least 1"),
    ((*CELLS, 1), 2.5, f"mesh.cells_number[1]: 2.5 {NOT} a whole number"),
    ((*CELLS, 2), -3, "mesh.cells_number[2]: -3"),
    ((*CELLS, 2), 2**20 + 1, f"mesh.cells_number[2]: 1048577 {NOT} a whole number at least 1 and"),
    (CELLS, [4, 4], "mesh.cells_number: [4, 4]"),
    (CELLS, "4 4 4", "mesh.cells_number: "),
    (SIZES, ABSENT, "mesh.cells_dimension: missing"),
    (SIZES, 0.5, f"mesh.cells_dimension: 0.5 {NOT} a list of 3 numbers above 0"),
    ((*SIZES, 0), 0, f"mesh.cells_dimension[0]: 0 {NOT} a number above 0 (Edge lengths of a cell"),
    ((*SIZES, 1), -0.5, "mesh.cells_dimension[1]: -0.5"),
    (SIZES, [1e-200] * 3, "mesh.cells_dimension: the volume of such a cell is no usable number"),
    (("mesh", "origin"), [1e15, 0, 0], "mesh.cells_dimension: cells of 0.5 m are lost in"),
    (("mesh", "origin", 1), "0", 'mesh.origin[1]: "0"'),
    (("mesh", "boundary_conditions"), "fixed", "mesh.boundary_conditions: "),
    (
        ("mesh", "boundary_conditions", "plane_X0"),
        "Fixed",
        f'mesh.boundary_conditions.plane_X0: "Fixed" {NOT} "free", "sliding", "fixed" '
        '(Condition on the plane of lowest x; sliding if not said); did you mean "fixed"?',
    ),
    (("mesh", "boundary_conditions", "plane_Zn"), 0, "mesh.boundary_conditions.plane_Zn: 0"),
    # materials
    (("materials",), ABSENT, "materials: missing; needed: a list of objects"),
    (("materials",), {}, f"materials: {{}} {NOT} a list of objects"),
    (("materials",), "elastic", 'materials: "elastic"'),
    (SOIL, "elastic", f'materials.soil: "elastic" {NOT} an object {{ … }}'),
    ((*SOIL, "type"), ABSENT, 'materials.soil.type: missing; needed: "elastic"'),
    ((*SOIL, "type"), "plastic", f'materials.soil.type: "plastic" {NOT} "elastic"'),
    ((*SOIL, "type"), "mohr_coulomb", 'did you mean "mohr-coulomb"?'),
    ((*SOIL, "type"), None, "materials.soil.type: missing"),
    ((*SOIL, "id"), ABSENT, "materials.soil.id: missing; needed: a whole number"),
    ((*SOIL, "id"), 1.5, f"materials.soil.id: 1.5 {NOT} a whole number"),
    ((*SOIL, "id"), "1", 'materials.soil.id: "1"'),
    ((*SOIL, "density"), 0, f"materials.soil.density: 0 {NOT} a number above 0 (Initial density"),
    ((*SOIL, "density"), ABSENT, "materials.soil.density: missing; needed: a number above 0"),
    ((*SOIL, "young"), 0, f"materials.soil.young: 0 {NOT} a number above 0 (Young's modulus [Pa])"),
    ((*SOIL, "young"), "1e6", f'materials.soil.young: "1e6" {NOT} a number above 0, without'),
    ((*SOIL, "poisson"), 0.5, f"materials.soil.poisson: 0.5 {NOT} a number above -1 and below 0.5"),
    ((*SOIL, "poisson"), -1, "materials.soil.poisson: -1"),
    # bodies
    (("body",), ABSENT, "body: missing; needed: a list of objects { … }, or an object of such"),
    (("body",), [], f"body: [] {NOT} a list of objects"),
    (BLOCK, [], f"body.block: [] {NOT} an object"),
    ((*BLOCK, "type"), ABSENT, 'body.block.type: missing; needed: "cuboid", "sphere"'),
    ((*BLOCK, "type"), "Cuboid", 'did you mean "cuboid"?'),
    ((*BLOCK, "type"), ["cuboid"], f'body.block.type: ["cuboid"] {NOT}'),
    ((*BLOCK, "type"), "gmsh", "body.block.mesh_file: missing"),
    ((*BLOCK, "active"), 1, f"body.block.active: 1 {NOT} true or false"),
    ((*BLOCK, "material_id"), ABSENT, "body.block.material_id: missing"),
    ((*BLOCK, "material_id"), 2, "body.block.material_id: 2 is no id of a material; defined: 1"),
    ((*BLOCK, "material_id"), 1.5, f"body.block.material_id: 1.5 {NOT} a whole number"),
    ((*BLOCK, "material_id"), "1", f'body.block.material_id: "1" {NOT} a whole number'),
    ((*BLOCK, "material_id"), 1e30, "at least -2147483648 and at most 2147483647"),
    ((*BLOCK, "point_p1"), ABSENT, "body.block.point_p1: missing; needed: a list of 3 numbers"),
    ((*BLOCK, "point_p2"), [0, 1, 1], "body.block.point_p2: x is 0 and must exceed that of point"),
    ((*BLOCK, "point_p2"), [1, 1, -1], "body.block.point_p2: z is -1 and must exceed"),
    ((*BLOCK, "point_p2"), [1e9] * 3, "body.block: the body needs about 6.4e+28 particle posi"),
    ((*BLOCK, "particles_per_direction"), [2, 2, 0], "body.block.particles_per_direction[2]: 0"),
    ((*BLOCK, "particles_per_direction"), 2, "body.block.particles_per_direction: 2"),
    ((*BLOCK, "particles_per_direction"), [10**9] * 3, "body.block: the body needs about"),
    ((*BLOCK, "initial_velocity"), "fast", "body.block.initial_velocity: "),
    ((*BALL, "diameter"), 0, f"body.ball.diameter: 0 {NOT} a number above 0"),
    ((*BALL, "diameter"), ABSENT, "body.ball.diameter: missing; needed: a number above 0"),
    ((*BALL, "center"), [0, 0], "body.ball.center: [0, 0]"),
    ((*WEDGE, "points"), [], "body.wedge.points: has 0 points and needs at least 3"),
    ((*WEDGE, "points"), [[0, 0, 0], [1, 0, 0]], "body.wedge.points: has 2 points and needs at"),
    ((*WEDGE, "points", 1), [1, 0], "body.wedge.points[1]: [1, 0]"),
    ((*WEDGE, "points", 1, 2), "a", 'body.wedge.points[1][2]: "a"'),
    ((*WEDGE, "extrude_direction"), "Y", 'did you mean "y"?'),
    ((*WEDGE, "extrude_direction"), ABSENT, 'body.wedge.extrude_direction: missing; needed: "x"'),
    ((*WEDGE, "extrude_displacement"), 0, "body.wedge.extrude_displacement: 0"),
    ((*WEDGE, "extrude_displacement"), -1, "body.wedge.extrude_displacement: -1"),
    ((*WEDGE, "discretization_length"), -1, "body.wedge.discretization_length: -1"),
    ((*WEDGE, "discretization_length"), 1e-9, "body.wedge: the body needs about"),
    # damping
    (("damping",), "local", f'damping: "local" {NOT} an object'),
    (("damping", "type"), ABSENT, 'damping.type: missing; needed: "none", "local", "kinetic"'),
    (("damping", "type"), "Local", 'did you mean "local"?'),
    (("damping", "value"), -0.1, f"damping.value: -0.1 {NOT} a number at least 0"),
    (("damping", "value"), "0.1", 'damping.value: "0.1"'),
    # loads
    (("nodal_point_load",), 5, "nodal_point_load: 5"),
    (("nodal_point_load",), [[0, 0, 0], [0, 0, 1]], "nodal_point_load[0][0]: 0"),
    (("nodal_point_load", 0), [[1, 1, 1]], f"nodal_point_load[0]: [[1, 1, 1]] {NOT} a list of 2"),
    (("nodal_point_load", 0), {}, "nodal_point_load[0].point: missing; needed: a list of 3"),
    (("nodal_point_load", 0, 0), [9, 9, 9], "nodal_point_load[0][0]: [9.0, 9.0, 9.0] is outside"),
    (("nodal_point_load", 0, 1, 2), "1", 'nodal_point_load[0][1][2]: "1"'),
    ((*TOP, "load"), ABSENT, "load_distributed_box.top.load: missing; needed: a list of 3 num"),
    ((*TOP, "load"), 10, "load_distributed_box.top.load: 10"),
    ((*TOP, "point_p2"), [1, 1, -1], "load_distributed_box.top.point_p2: z is -1, below that of"),
    (("load_distributed_box",), True, "load_distributed_box: true"),
    # earthquake
    (("earthquake", "file"), ABSENT, "earthquake.file: is required when active is true"),
    (("earthquake", "file"), "recrod.csv", 'earthquake.file: there is no file "recrod.csv" in '),
    (("earthquake", "file"), ".", 'earthquake.file: there is no file "."'),
    (("earthquake", "file"), "case\0.csv", "earthquake.file: there is no file"),
    (("earthquake", "file"), 3, f"earthquake.file: 3 {NOT} text in double quotes"),
    (("earthquake", "header"), False, "earthquake.file: "),
    (("earthquake", "active"), "true", f'earthquake.active: "true" {NOT} true or false'),
    (("earthquake",), "record.csv", 'earthquake: "record.csv"'),
    # results
    (("results",), ["stress"], "results: "),
    (("results", "print"), "10", f'results.print: "10" {NOT} a whole number, without quotes'),
    (("results", "print"), True, "results.print: true"),
    (("results", "material_point_results"), 5, "results.material_point_results: 5"),
    (("results", "material_point_results"), [5], "results.material_point_results[0]: 5"),
    (("results", "material_point_results"), {"a": 1}, "results.material_point_results: "),
    (("results", "grid_nodal_results"), [["mass"]], "results.grid_nodal_results[0]: "),
    (("results", "grid_all_cells"), 1, "results.grid_all_cells: 1"),
    # parts of later versions
    (("terrain_contact",), True, f"terrain_contact: true {NOT} an object"),
]


def changed(case, path, value):
    """Set or remove the value at a path of a case."""
    *place, last = path
    node = case
    for key in place:
        node = node[key]
    if value is ABSENT:
        del node[last]
    else:
        node[last] = value
    return case


def name_of(row):
    path, value, _ = row
    text = "absent" if value is ABSENT else str(value)[:12]
    return f"{'.'.join(map(str, path))}={text}"


@pytest.mark.parametrize(("path", "value", "message"), BAD, ids=map(name_of, BAD))
def test_bad_value(case, folder, path, value, message, capsys):
    (folder / "case.json").write_text(json.dumps(changed(case, path, value)))
    with pytest.raises(CaseError) as caught:
        load_case("case.json")
    assert any(message in problem for problem in caught.value.problems), caught.value.problems
    assert all(len(problem.splitlines()) == 1 for problem in caught.value.problems)

    assert cli.main(["case.json", "--output", "out"]) == cli.BAD_INPUT
    shown = capsys.readouterr().err
    assert message in shown
    assert "Traceback" not in shown
    assert not (folder / "out").exists()


def test_the_case_itself_is_sound(case, folder):
    assert load_case(case, strict=True).warnings == ()


def test_all_bad_values_of_different_parts_come_together(case, folder):
    rows = {}
    for path, value, message in BAD:
        if message.startswith(".".join(map(str, path)) + ": ") and len(path) > 1:
            part = path[:2] if path[0] in ("body", "mesh", "results") else path[:1]
            rows.setdefault(part, (path, value, message))
    for path, value, _ in rows.values():
        changed(case, path, value)
    with pytest.raises(CaseError) as caught:
        load_case(case)
    problems = caught.value.problems
    assert len(rows) > 10
    for path, _, message in rows.values():
        assert any(message in problem for problem in problems), path
