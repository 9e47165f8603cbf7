"""Contradictions between keys that are each fine by themselves."""

import pytest
from terrains import plane, text_of

from mpmgeo.case.load import CaseError, load_case
from mpmgeo.shapes import SHAPES


def problems(case):
    with pytest.raises(CaseError) as caught:
        load_case(case)
    return caught.value.problems


def test_bodies_need_a_defined_material(case):
    case["materials"]["rock"] = case["materials"]["soil"] | {"id": 4}
    case["body"]["block"]["material_id"] = 2
    assert problems(case) == ["body.block.material_id: 2 is no id of a material; defined: 1, 4"]


def test_a_broken_material_id_raises_no_second_complaint(case):
    case["materials"]["soil"]["id"] = 1.5
    (problem,) = problems(case)
    assert problem.startswith("materials.soil.id: 1.5")


@pytest.mark.parametrize("value", [[], {}, "1", True])
def test_ids_of_any_type_are_looked_at(case, value):
    del case["materials"]["soil"]["type"], case["body"]["block"]["type"]
    case["materials"]["soil"]["id"] = case["body"]["block"]["material_id"] = value
    assert [problem.split(":")[0] for problem in problems(case)] == [
        "materials.soil.type",
        "body.block.type",
    ]


def test_a_body_must_be_active(case):
    case["body"]["block"]["active"] = False
    assert problems(case) == ["body: no body is active"]


def test_bodies_must_not_need_more_particles_than_fit(case):
    case["body"]["block"]["point_p2"] = [1e6, 1e6, 1e6]
    (problem,) = problems(case)
    assert problem.startswith("body.block: the body needs about 6.4e+19 particle positions")


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("scheme", ["USL", "MUSL", "USF"])
@pytest.mark.parametrize("time_step", [1e-9, None])
def test_usl_with_linear_is_warned_of_whatever_the_step(case, shape, scheme, time_step):
    keys = {"shape_function": shape, "stress_scheme_update": scheme, "time_step": time_step}
    warnings = load_case(case | keys).warnings
    if (shape, scheme) == ("linear", "USL"):
        (warning,) = warnings
        assert warning.startswith('shape_function: "linear" with the scheme USL diverges in plain')
        assert '"stress_scheme_update": "MUSL" mends it' in warning
    else:
        assert warnings == ()


@pytest.mark.parametrize("shape", ["quadratic-bspline", "cubic-bspline"])
def test_splines_are_not_as_in_mpm_geomechanics(case, shape):
    case |= {"shape_function": shape}
    assert load_case(case).shape_function == shape
    (problem,) = problems(case | {"compatibility": "mpm-geomechanics"})
    assert problem == (
        f'shape_function: MPM-Geomechanics has no "{shape}"; '
        'accepted with compatibility: "GIMP", "linear"'
    )


UPDATED = {"particle_domain": "updated"}


@pytest.mark.parametrize("scheme", ["USL", "MUSL"])
def test_sizes_of_gimp_can_follow(case, scheme):
    loaded = load_case(case | UPDATED | {"stress_scheme_update": scheme})
    assert loaded.particle_domain == "updated"
    assert load_case(case).particle_domain == "initial"


@pytest.mark.parametrize(
    ("keys", "message"),
    [
        ({"shape_function": "linear", "stress_scheme_update": "MUSL"}, 'with "linear" particles'),
        ({"shape_function": "cubic-bspline"}, 'with "cubic-bspline" particles have no size;'),
        ({"stress_scheme_update": "USF"}, '"USF" strains with other velocities than those that'),
        ({"compatibility": "mpm-geomechanics"}, "MPM-Geomechanics keeps the sizes of particles;"),
        ({"particle_domain": "rotated"}, '"rotated" is not accepted; accepted: "initial", '),
    ],
    ids=["linear", "spline", "USF", "compatibility", "word"],
)
def test_sizes_that_cannot_follow(case, keys, message):
    (problem,) = problems(case | UPDATED | keys)
    assert problem.startswith(f"particle_domain: {message}")


def test_sizes_do_not_follow_on_a_terrain(case, tmp_path):
    (tmp_path / "ground.stl").write_text(text_of(plane()))
    terrain = {"active": True, "stl_mesh": str(tmp_path / "ground.stl")}
    (problem,) = problems(case | UPDATED | {"terrain_contact": terrain})
    assert problem.startswith("particle_domain: contact with a terrain is for particles that keep")
    assert load_case(case | UPDATED | {"terrain_contact": terrain | {"active": False}})


def test_usl_need_not_be_written_to_be_warned_of(case):
    (warning,) = load_case(case | {"shape_function": "linear"}).warnings
    assert "USL" in warning


def test_inactive_bodies_may_be_large(case):
    case["body"]["idle"] = case["body"]["block"] | {"active": False, "point_p2": [1e9, 1e9, 1e9]}
    assert len(load_case(case).body) == 2


@pytest.mark.parametrize("position", [[0, 0, 0], [2, 2, 2], [2.0000000001, 1, 1]])
def test_point_loads_may_lie_on_the_boundary(case, position):
    case["nodal_point_load"] = [[position, [0, 0, 1]]]
    assert load_case(case).nodal_point_load


@pytest.mark.parametrize(
    ("load", "where"),
    [
        ([[3, 1, 1], [0, 0, 1]], "nodal_point_load.p[0]: [3.0, 1.0, 1.0] is outside the mesh"),
        ({"position": [1, 1, -0.1], "force": [0, 0, 1]}, "nodal_point_load.p.position: "),
    ],
)
def test_point_loads_must_lie_in_the_mesh(case, load, where):
    case["nodal_point_load"] = {"p": load}
    (problem,) = problems(case)
    assert problem.startswith(where)


@pytest.mark.parametrize(
    ("keys", "where"),
    [
        ({"time": 1, "time_step": 1e-300}, "time_step: 1e+300 steps of 1e-300 s"),
        ({"time": 1e60, "time_step": 1e-3}, "time_step: "),
        ({"time": 1e60, "time_step": 0}, "time: "),
    ],
)
def test_runs_must_come_to_an_end(case, keys, where):
    (problem,) = problems(case | keys)
    assert problem.startswith(where)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "no line with time and three accelerations"),
        ("t,x,y,z\n0,0,0\n", "line 2: needs time and three accelerations"),
        ("t,x,y,z\n0,0,0,0\n0,1,1,1\n", "line 3: time 0 s does not exceed"),
        ("t,x,y,z\n0,0,zero,0\n", "line 2: 'zero' is not a number"),
    ],
)
def test_records_are_read_before_the_run(case, tmp_path, text, message):
    file = tmp_path / "record.csv"
    file.write_text(text)
    case["earthquake"] = {"active": True, "file": str(file)}
    (problem,) = problems(case)
    assert problem.startswith("earthquake.file: ")
    assert message in problem
