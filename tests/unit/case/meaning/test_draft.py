"""Parts of a case know their place, whole or broken."""

from pathlib import Path

import pytest

from mpmgeo.bodies import Cuboid
from mpmgeo.case.meaning.draft import draft
from mpmgeo.case.report import Report
from mpmgeo.case.spec import Case, Mesh


@pytest.fixture
def report():
    return Report()


def test_a_whole_case_is_made(case, report):
    made = draft(case, Path(), report)
    assert isinstance(made.whole.made, Case)
    assert made.of("mesh")[0].path == ("mesh",)
    assert isinstance(made.made("mesh")[0], Mesh)
    assert made.made("body") == [made.whole.made.body[0]]
    assert made.of("earthquake") == []


def test_entries_come_in_the_order_of_the_case(case, report):
    block = case["body"]["block"]
    case["body"] = {"z": block, "a": block | {"active": False}}
    made = draft(case, Path(), report)
    assert [part.path[-1] for part in made.of("body")] == ["a", "z"]
    assert [part.made.active for part in made.of("body")] == [False, True]


def test_a_part_written_as_a_list_knows_its_positions(case, report):
    point, force = [1, 1, 1], [0, 0, 1]
    case["nodal_point_load"] = [[point, force], {"point": point, "force": force}]
    first, second = draft(case, Path(), report).of("nodal_point_load")
    assert first.at("point", 2) == ("nodal_point_load", 0, 0, 2)
    assert second.at("point", 2) == ("nodal_point_load", 1, "point", 2)
    assert first.made == second.made


def test_a_broken_part_keeps_what_is_sound(case, report):
    report.error(("body", "block", "point_p1"), "is wrong")
    made = draft(case, Path(), report)
    (part,) = made.of("body")
    assert part.made is None
    assert made.whole.made is None
    assert "point_p1" not in part.values
    assert part.values["point_p2"] == (1.0, 1.0, 1.0)
    assert part.values["active"] is True
    assert part.given == frozenset(case["body"]["block"])
    assert made.made("mesh")


def test_problems_of_an_object_leave_it_without_one(case, report):
    case["body"]["block"]["point_p2"] = [1, 1, -1]
    (part,) = draft(case, Path(), report).of("body")
    assert part.made is None
    assert part.values["material_id"] == 1
    assert list(report.errors) == [("body", "block", "point_p2")]


def test_of_an_object_without_a_class_scalars_are_known(case, report):
    case["body"]["block"] |= {"type": "cone", "material_id": 9, "active": "no"}
    report.error(("body", "block", "type"), "is wrong")
    (part,) = draft(case, Path(), report).of("body")
    assert part.values == {"material_id": 9}


def test_words_left_out_do_not_move_the_places_of_others(case, report):
    case["results"] = {"material_point_results": ["qwertz", "stress"]}
    made = draft(case, Path(), report)
    (results,) = made.of("results")
    assert results.values["material_point_results"] == ("stress",)
    where = report.where(results.at("material_point_results", 0))
    assert where == "results.material_point_results[1]"


def test_made_objects_are_those_of_the_declarations(case, report):
    assert type(draft(case, Path(), report).made("body")[0]) is Cuboid
