"""Paths and likeness as messages show them."""

import pytest

from mpmgeo.case.report import CaseError, Report, nearest, shown_key


def test_paths_read_as_the_user_wrote_them():
    report = Report()
    report.written["materials",] = "material"
    report.written["body", 0] = 3
    assert report.where(("materials", "rock", "young")) == "material.rock.young"
    assert report.where(("body", 0, "point_p2", 1)) == "body[3].point_p2[1]"
    assert report.where(("a b", 'c"d', "", "softening.x")) == 'a b."c\\"d"."".softening.x'


def test_the_first_error_of_a_path_stands():
    report = Report()
    report.error(("time",), "first")
    report.error(("time",), "second")
    assert list(report.errors.values()) == ["time: first"]


def test_strict_turns_warnings_into_problems():
    report = Report()
    report.warn(("mesh",), "odd")
    report.raise_errors()
    with pytest.raises(CaseError) as caught:
        report.raise_errors(strict=True)
    assert caught.value.problems == ["mesh: odd"]


def test_errors_carry_warnings_and_notes():
    report = Report()
    report.error((), "bad")
    report.warn((), "odd")
    report.note((), "so")
    with pytest.raises(CaseError) as caught:
        report.raise_errors()
    error = caught.value
    assert (error.problems, error.warnings, error.notes) == (["bad"], ("odd",), ("so",))
    assert str(error) == "bad"


def test_long_keys_are_cut():
    assert len(shown_key("x" * 10_000)) == 60


@pytest.mark.parametrize(
    ("word", "known", "found"),
    [
        ("pointP1", ["point_p1", "point_p2"], "point_p1"),
        ("gimp", ["GIMP", "linear"], "GIMP"),
        ("Fixed", ["free", "sliding", "fixed"], "fixed"),
        ("material-point-results", ["material_point_results"], "material_point_results"),
        ("xyz", ["point_p1"], None),
        ("x" * 10_000, ["x"], None),
        (3, ["3"], None),
        ("3", [3], None),
        ("", ["a"], None),
        ("___", ["a"], None),
    ],
)
def test_nearest(word, known, found):
    assert nearest(word, known) == found
