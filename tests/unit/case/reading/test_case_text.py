"""From bytes to a tree: encodings, syntax messages, and what JSON can hold and a case cannot."""

import math

import numpy as np
import pytest

from mpmgeo.case.reading.text import parse, read, survey
from mpmgeo.case.report import CaseError, Report


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16"])
def test_text_encodings_are_recognised(tmp_path, encoding):
    file = tmp_path / "case.json"
    file.write_bytes('{"title": "Böschung"}'.encode(encoding))
    assert read(file) == {"title": "Böschung"}


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ('{"time": 1,}', "the comma before } has to go"),
        ('{"a": [1, 2,]}', "the comma before ] has to go"),
        ('{"time": 1 // seconds\n}', "comments are not allowed"),
        ('{\n# comment\n"time": 1}', "line 2, column 1: not JSON: comments are not allowed"),
        ("{'time': 1}", "double quotes"),
        ('{"time": 1', "the text ends too early"),
        ("{time: 1}", "a key in double quotes is expected"),
        ('{"time": .5}', "a value is expected"),
        ('{"time": 1 "body": 2}', "a comma or a closing bracket is expected"),
        ('{"time" 1}', "a colon is expected after a key"),
        ('{"time": 1} {}', "the text goes on after the end of the case"),
        ('{"title": "a\nb"}', "does not end on its line"),
        ('{"file": "C:\\data"}', "a backslash in a text is written twice"),
        ("[1, 2]", "a case is a JSON object { … }, not [1, 2]"),
        ("   \n", "the file is empty"),
        ("[" * 100_000, "nested more than 64 levels deep"),
    ],
)
def test_messages_name_the_flaw(text, message):
    with pytest.raises(CaseError) as caught:
        parse(text)
    assert message in str(caught.value)


def test_message_shows_the_line():
    with pytest.raises(CaseError, match=r'line 2, column 8.*"time" 1') as caught:
        parse('{\n"time" 1}')
    assert len(str(caught.value).splitlines()) == 1


def survey_of(text):
    report = Report()
    tree = parse(text)
    shallow = survey(tree, report)
    return tree, report, shallow


@pytest.mark.parametrize("word", ["NaN", "Infinity", "-Infinity", "1e999", "1" * 5000])
def test_non_finite_numbers_are_errors_with_their_path(word):
    _, report, _ = survey_of(f'{{"mesh": {{"origin": [0, {word}, 0]}}}}')
    assert list(report.errors) == [("mesh", "origin", 1)]
    assert "no finite number" in report.errors["mesh", "origin", 1]


def test_numbers_beyond_any_quantity_are_errors():
    _, report, _ = survey_of('{"time": 1e101, "expected": {"huge": 1e101}}')
    assert list(report.errors) == [("time",)]


def test_repeated_keys_are_warned_of_and_the_last_counts():
    tree, report, _ = survey_of('{"mesh": {"time": 1, "time": 2, "time": 3}}')
    assert tree["mesh"]["time"] == 3
    assert list(report.warnings.values()) == [
        "mesh.time: given more than once; the last one counts"
    ]


def test_null_counts_as_absent_but_in_expected_numbers():
    tree, _, _ = survey_of('{"gravity": null, "mesh": {"origin": null}, "expected": {"a": null}}')
    assert tree == {"mesh": {}, "expected": {"a": None}}


def test_deep_trees_are_refused_before_anything_walks_them():
    _, report, shallow = survey_of('{"a":' * 100 + "1" + "}" * 100)
    assert not shallow
    assert len(report.errors) == 1


def test_half_a_unicode_character_is_an_error():
    _, report, _ = survey_of('{"title": "\\ud800", "\\udc00": 1}')
    assert len(report.errors) == 2


def test_a_dict_is_copied_and_may_hold_tuples_arrays_and_paths(tmp_path):
    source = {"gravity": (0, 0, -9.81), "n": np.array([1, 2]), "x": np.float64(2), "f": tmp_path}
    tree = read(source)
    assert tree == {"gravity": [0, 0, -9.81], "n": [1, 2], "x": 2.0, "f": str(tmp_path)}
    tree["gravity"].append(1)
    assert len(source["gravity"]) == 3


@pytest.mark.parametrize("value", [{1, 2}, object(), 1j, {(1, 2): 3}])
def test_a_dict_of_other_values_is_refused(value):
    with pytest.raises(CaseError, match="cannot be written as JSON"):
        read({"time": value})


def test_a_dict_that_holds_itself_is_refused():
    source = {}
    source["self"] = source
    with pytest.raises(CaseError):
        read(source)


def test_missing_file_names_a_similar_one(tmp_path):
    (tmp_path / "slope.json").write_text("{}")
    with pytest.raises(CaseError, match=r"there is no file .*did you mean .*slope.json"):
        read(tmp_path / "slop.json")


@pytest.mark.parametrize(
    ("name", "message"),
    [
        (".", "is a folder"),
        ("x" * 5000, "cannot be read"),
        ("nul\0.json", "there is no file|cannot be read"),
        ("none/case.json", "there is no file"),
    ],
)
def test_names_that_are_no_files(tmp_path, name, message):
    with pytest.raises(CaseError, match=message):
        read(tmp_path / name)


def test_bytes_that_are_no_text(tmp_path):
    file = tmp_path / "case.json"
    file.write_bytes(b'{"title": "B\xf6schung"}')
    with pytest.raises(CaseError, match="not UTF-8 text: byte 0xf6 at position 12"):
        read(file)


def test_integers_stay_exact_and_floats_stay_floats():
    tree = parse('{"a": 12345678901234567890, "b": 1.0}')
    assert tree["a"] == 12345678901234567890
    assert isinstance(tree["b"], float)
    assert math.isclose(tree["b"], 1)
