"""Messages about single values: path, value, what is accepted, description, nearest word."""

import pytest

from mpmgeo.case.load import CaseError, load_case
from mpmgeo.case.reading.explain import accepted, place_of


def problems(case, **options):
    with pytest.raises(CaseError) as caught:
        load_case(case, **options)
    return caught.value.problems


def test_a_message_says_everything(case):
    case["materials"]["soil"]["poisson"] = 0.5
    assert problems(case) == [
        "materials.soil.poisson: 0.5 is not accepted; "
        "accepted: a number above -1 and below 0.5 (Poisson's ratio)"
    ]


def test_components_of_vectors_are_named(case):
    case["body"]["block"]["point_p2"][1] = "high"
    assert problems(case) == [
        'body.block.point_p2[1]: "high" is not accepted; accepted: a number, without quotes '
        "(Corner of highest coordinates [m])"
    ]


def test_missing_keys_say_what_is_needed(case):
    del case["mesh"]["cells_dimension"], case["time"]
    assert sorted(problems(case), reverse=True) == [
        "time: missing; needed: a number above 0 (Simulated time [s])",
        "mesh.cells_dimension: missing; needed: a list of 3 numbers above 0 "
        "(Edge lengths of a cell [m])",
    ]


def test_missing_materials(case):
    del case["materials"]
    (problem,) = problems(case)
    assert problem.startswith("materials: missing; needed: a list of objects")


def test_words_name_the_nearest(case):
    case["shape_function"] = "gimp"
    (problem,) = problems(case)
    assert problem.endswith('did you mean "GIMP"?')


def test_unknown_keys_are_warnings_and_errors_if_strict(case):
    case["body"]["block"]["point_P3"] = [1, 1, 1]
    case["mesh"]["gravity"] = [0, 0, 0]
    case["mesh"]["diameter"] = 3
    case["mesh"]["quite_unlike"] = 3
    warnings = [
        "mesh.gravity: unknown key, ignored; it belongs to the top level",
        'mesh.diameter: unknown key, ignored; it belongs to "body_sphere"',
        "mesh.quite_unlike: unknown key, ignored",
        'body.block.point_P3: unknown key, ignored; did you mean "point_p2"?',
    ]
    assert list(load_case(case).warnings) == warnings
    assert problems(case, strict=True) == warnings


def test_unknown_fields_are_warnings(case):
    case["results"] = {"material_point_results": ["displacment", "stress", "qwertz"]}
    loaded = load_case(case)
    assert loaded.results.material_point_results == ("stress",)
    first, second = loaded.warnings
    assert first == (
        'results.material_point_results[0]: "displacment" is no field, ignored; '
        'did you mean "displacement"?'
    )
    assert '"qwertz" is no field, ignored; known: "id", ' in second


def test_errors_of_all_parts_come_together(case):
    case["time"] = -1
    case["materials"]["soil"]["young"] = "1e6"
    case["body"]["block"]["material_id"] = 7
    case["body"]["empty"] = case["body"]["block"] | {"point_p2": [0, 0, 0], "material_id": 1}
    case["nodal_point_load"] = [[[9, 9, 9], [0, 0, 1]]]
    found = problems(case)
    for start in (
        "time: -1",
        "materials.soil.young",
        "body.empty.point_p2: x is 0 and must exceed that of point_p1, 0; y",
    ):
        assert any(problem.startswith(start) for problem in found)
    for start in ("body.block.material_id: 7", "nodal_point_load[0][0]: [9.0, 9.0, 9.0]"):
        assert any(problem.startswith(start) for problem in found)
    assert len(found) == 5


@pytest.mark.parametrize(
    ("path", "place"),
    [
        ((), ()),
        (("time",), ("time",)),
        (("body", "soil", "points", 3, 1), ("body", "*", "points", "*", "*")),
        (("body", 2, "type"), ("body", "*", "type")),
        (("mesh", "origin", 1), ("mesh", "origin", "*")),
    ],
)
def test_places(path, place):
    assert place_of(path) == place


@pytest.mark.parametrize(
    ("schema", "words"),
    [
        ({"type": "integer", "minimum": 1, "maximum": 2**31 - 1}, "a whole number at least 1"),
        ({"type": "integer", "minimum": -(2**31)}, "a whole number"),
        ({"type": "boolean"}, "true or false"),
        ({"const": False}, "false"),
        ({"enum": ["a", "b"]}, '"a", "b"'),
        ({"$ref": "#/$defs/mesh"}, "an object { … }"),
        ({"type": ["array", "object"], "maxItems": 0}, "an empty list"),
        ({"type": "array", "items": {"type": "string"}}, "a list of texts in double quotes"),
    ],
)
def test_accepted(schema, words):
    assert accepted(schema) == words


def test_range_of_integers_is_named_where_it_is_left(case):
    case["body"]["block"]["material_id"] = 1e30
    (problem,) = [p for p in problems(case) if "material_id" in p]
    assert "at most 2147483647" in problem
