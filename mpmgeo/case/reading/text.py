"""From a file to a tree of JSON values, or messages about what is no JSON."""

import json
import math
import os
from pathlib import Path

from mpmgeo.case.report import CaseError, nearest
from mpmgeo.values import LARGEST, printable, shown

DEEPEST = 64
"""Levels of nesting beyond which no case goes."""


class Object(dict):
    """A JSON object that remembers which of its keys the text gives more than once."""

    repeated = ()


def read(source):
    """Return the JSON tree of a file (str or Path) or of a dict; CaseError if it has none."""
    if isinstance(source, dict):
        return parse(_dump(source))
    return parse(_text(Path(source)))


def parse(text):
    """Return the tree of a JSON text; NaN and infinite values stay in it for `survey` to find."""
    if not text.strip():
        raise CaseError(["the file is empty"])
    try:
        tree = json.loads(text, object_pairs_hook=_object, parse_int=_integer, parse_constant=float)
    except json.JSONDecodeError as error:
        raise CaseError([_syntax(error)]) from None
    except RecursionError:
        raise CaseError([f"nested more than {DEEPEST} levels deep"]) from None
    if not isinstance(tree, dict):
        raise CaseError([f"a case is a JSON object {{ … }}, not {shown(tree)}"])
    return tree


def survey(node, report, path=()) -> bool:
    """Report what JSON text can hold and a case cannot, and remove keys whose value is null.

    Returns whether the tree is shallow enough to be looked at further.
    """
    if len(path) > DEEPEST:
        report.error(path[:8], f"nested more than {DEEPEST} levels deep")
        return False
    if isinstance(node, dict):
        for key in getattr(node, "repeated", ()):
            report.warn((*path, key), "given more than once; the last one counts")
        for key in [key for key, value in node.items() if value is None and _is_read(path)]:
            del node[key]
        children = list(node.items())
        for key, _ in children:
            _survey_text(key, report, (*path, key))
    else:
        children = enumerate(node) if isinstance(node, list) else ()
        _survey_number(node, report, path)
        _survey_text(node, report, path)
    found = [survey(value, report, (*path, key)) for key, value in children]
    return all(found)


def survey_moved(node, report, path=()):
    """Report numbers that a case cannot hold once more, by the paths that they have by now.

    What follows looks for errors by path, and old spellings have gone.
    """
    if isinstance(node, dict | list):
        for key, value in node.items() if isinstance(node, dict) else enumerate(node):
            survey_moved(value, report, (*path, key))
    else:
        _survey_number(node, report, path)
        _survey_text(node, report, path)


def _is_read(path):
    return path[:1] != ("expected",)


def _survey_number(value, report, path):
    if isinstance(value, float) and not math.isfinite(value):
        report.error(path, f"{shown(value)} is no finite number")
    elif isinstance(value, int | float) and abs(value) > LARGEST and _is_read(path):
        report.error(path, f"{shown(value)} is larger than any quantity here can be")


def _survey_text(value, report, path):
    if isinstance(value, str) and not value.isascii():
        try:
            value.encode()
        except UnicodeEncodeError:
            report.error(path, f"{shown(value)} holds half a Unicode character")


def _object(pairs):
    result = Object(pairs)
    if len(result) < len(pairs):
        seen = set()
        result.repeated = [key for key, _ in pairs if key in seen or seen.add(key)]
    return result


def _integer(digits):
    """Return an int, or an infinite float where no double could hold it."""
    number = float(digits)
    return int(digits) if math.isfinite(number) else number


def _dump(source):
    """Return a dict as JSON text, so that it is read, and copied, like a file."""

    def plain(value):
        if hasattr(value, "tolist"):
            return value.tolist()
        if isinstance(value, os.PathLike):
            return os.fspath(value)
        raise TypeError(f"{type(value).__name__} is no JSON value")

    try:
        return json.dumps(source, default=plain)
    except (TypeError, ValueError) as error:
        raise CaseError([f"the case cannot be written as JSON: {error}"]) from None
    except RecursionError:
        raise CaseError([f"nested more than {DEEPEST} levels deep"]) from None


def _text(path):
    try:
        complaint = _complaint(path)
        data = b"" if complaint else path.read_bytes()
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or error
        complaint = f"{shown(str(path))} cannot be read: {reason}"
    if complaint:
        raise CaseError([complaint])
    try:
        return data.decode(json.detect_encoding(data))
    except UnicodeDecodeError as error:
        byte = error.object[error.start]
        message = f"not UTF-8 text: byte {byte:#04x} at position {error.start}"
        raise CaseError([message]) from None


def _complaint(path):
    if path.is_dir():
        return f"{path} is a folder, not a case file"
    if not path.exists():
        return f"there is no file {shown(str(path))}{_similar(path)}"
    return "" if path.is_file() else f"{path} is not a regular file"


def _similar(path):
    folder = path.parent
    names = [p.name for p in folder.glob("*.json")] if folder.is_dir() else []
    name = nearest(path.name, names)
    return f"; did you mean {folder / name}?" if name else ""


REASONS = {
    "Expecting property name": "a key in double quotes is expected",
    "Expecting value": "a value is expected",
    "Expecting ',' delimiter": "a comma or a closing bracket is expected",
    "Expecting ':' delimiter": "a colon is expected after a key",
    "Extra data": "the text goes on after the end of the case",
    "Unterminated string": "a text has no closing quote",
    "Invalid control character": "a text does not end on its line or holds a control character",
    "Invalid \\escape": "a backslash in a text is written twice",
}


def _syntax(error):
    start = error.doc.rfind("\n", 0, error.pos) + 1
    line = error.doc[start:].split("\n", 1)[0].strip()
    message = f"line {error.lineno}, column {error.colno}: not JSON: {_reason(error)}"
    return f"{message}: {printable(line)}" if line else message


def _reason(error):
    text, position = error.doc, error.pos
    rest = text[position:].lstrip(" \t\r\n,")
    has_comma = text[:position].rstrip().endswith(",") or text[position : position + 1] == ","
    if rest[:2] in ("//", "/*") or rest[:1] == "#":
        return "comments are not allowed"
    if rest[:1] in ("}", "]") and has_comma:
        return f"the comma before {rest[0]} has to go"
    if rest[:1] == "'":
        return 'texts and keys stand in double quotes ("), not in single ones'
    if not rest:
        return "the text ends too early"
    words = [REASONS[known] for known in REASONS if error.msg.startswith(known)]
    return words[0] if words else error.msg
