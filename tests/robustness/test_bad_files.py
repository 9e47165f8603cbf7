"""Files that are no cases: never a traceback, always a reason, exit code 2, nothing written."""

import json

import pytest

from mpmgeo import cli

BAD = {
    "empty": (b"", "the file is empty"),
    "blank": (b" \n\t\n", "the file is empty"),
    "only a BOM": (b"\xef\xbb\xbf", "the file is empty"),
    "null": (b"null", "a case is a JSON object { … }, not null"),
    "a number": (b"42", "a case is a JSON object { … }, not 42"),
    "a text": (b'"case"', 'a case is a JSON object { … }, not "case"'),
    "a list": (b"[{}]", "a case is a JSON object { … }, not a list of 1 value"),
    "an empty object": (b"{}", "time: missing"),
    "trailing comma": (b'{"time": 1,}', "the comma before } has to go"),
    "comment": (b'{"time": 1} // end', "comments are not allowed"),
    "python": (b"{'time': 1}", 'double quotes (")'),
    "python words": (b'{"save_state": False}', "line 1, column 16: not JSON: a value is expected"),
    "yaml": (b"time: 1\nmesh:\n  origin: 0\n", "line 1, column 1: not JSON"),
    "ini": (b"[case]\ntime = 1\n", "line 1, column 2: not JSON"),
    "xml": (b"<case time='1'/>", "line 1, column 1: not JSON"),
    "cut short": (b'{"time": 1, "mesh": {"orig', "not JSON: "),
    "two cases": (b'{"time": 1}{"time": 2}', "the text goes on after the end of the case"),
    "missing colon": (b'{"time" 1}', "a colon is expected after a key"),
    "missing comma": (b'{"a": 1\n"b": 2}', "line 2, column 1: not JSON: a comma or a closing"),
    "leading zero": (b'{"time": 01}', "not JSON"),
    "bare point": (b'{"time": .5}', "a value is expected"),
    "hexadecimal": (b'{"time": 0x10}', "not JSON"),
    "backslash": (b'{"file": "C:\\data"}', "a backslash in a text is written twice"),
    "line break in text": (b'{"title": "a\nb"}', "does not end on its line"),
    "latin-1": (b'{"title": "B\xf6schung"}', "not UTF-8 text: byte 0xf6 at position 12"),
    "binary": (bytes(range(256)), "not UTF-8 text"),
    "a picture": (b"\x89PNG\r\n\x1a\n\x00\x00\x00\rIHDR", "not UTF-8 text"),
    "zeros": (bytes(1000), "not JSON"),
    "odd UTF-16": (b"\xff\xfe{", "not UTF-8 text"),
    "half a character": (b'{"title": "\\ud800"}', "title: "),
    "deep lists": (b"[" * 200_000, "nested more than 64 levels deep"),
    "deep objects": (b'{"a":' * 5_000 + b"1" + b"}" * 5_000, "nested more than 64 levels deep"),
    "rather deep": (b'{"a":' * 200 + b"1" + b"}" * 200, "nested more than 64 levels deep"),
    "not a number": (b'{"time": NaN}', "time: NaN is no finite number"),
    "huge number": (b'{"time": 1e999}', "time: Infinity is no finite number"),
    "long number": (b'{"time": ' + b"9" * 100_000 + b"}", "time: Infinity is no finite number"),
    "long key": (b'{"' + b"k" * 1_000_000 + b'": 1}', "unknown key"),
    "long text": (b'{"time": "' + b"x" * 1_000_000 + b'"}', "time: "),
    "many keys": (json.dumps({f"k{n}": n for n in range(10_000)}).encode(), "and 9900 more"),
    "escape codes": (b'{"time": "\\u001b[2J"}', 'time: "\\u001b[2J" is not accepted'),
}


@pytest.mark.parametrize("name", BAD)
def test_bad_file(folder, name, capsys):
    content, message = BAD[name]
    (folder / "case.json").write_bytes(content)
    assert cli.main(["case.json", "--output", "out"]) == cli.BAD_INPUT
    shown = capsys.readouterr().err
    assert message in shown
    assert "Traceback" not in shown
    assert "\x1b" not in shown
    assert len(shown) < 20_000
    assert not (folder / "out").exists()


def test_byte_order_mark_is_no_error(folder, case, capsys):
    (folder / "case.json").write_bytes(b"\xef\xbb\xbf" + json.dumps(case).encode())
    assert cli.main(["case.json", "--check"]) == cli.DONE


RECORDS = {
    "empty": ("", "no line with time"),
    "only a heading": ("t,ax,ay,az\n", "no line with time"),
    "three columns": ("t,ax,ay,az\n0,1,2\n", "needs time and three accelerations"),
    "words": ("t,ax,ay,az\n0,a,b,c\n", "is not a number"),
    "not finite": ("t,ax,ay,az\n0,nan,0,0\n", "not all numbers are finite"),
    "time stands still": ("t,ax,ay,az\n0,0,0,0\n0,0,0,0\n", "does not exceed the time before it"),
    "time runs back": ("t,ax,ay,az\n1,0,0,0\n0,0,0,0\n", "does not exceed the time before it"),
    "decimal commas": ("t;ax;ay;az\n0,5;0;0;0\n", "has a decimal comma"),
}


@pytest.mark.parametrize("name", RECORDS)
def test_bad_record(folder, case, name, capsys):
    text, message = RECORDS[name]
    (folder / "record.csv").write_text(text)
    (folder / "case.json").write_text(json.dumps(case))
    assert cli.main(["case.json", "--output", "out"]) == cli.BAD_INPUT
    shown = capsys.readouterr().err
    assert "error: earthquake.file: " in shown
    assert message in shown
    assert not (folder / "out").exists()
