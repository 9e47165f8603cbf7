"""JSON values: which numbers can be calculated with, and how messages show a value."""

import json

LARGEST = 1e100
"""Number beyond which products of three overflow, and which no quantity in SI units reaches."""

USABLE = 1e60
"""Magnitude, or its inverse, beyond which products of five quantities overflow or vanish."""

LONGEST = 60
"""Characters of a value or key that a message shows."""


def is_number(value) -> bool:
    """Tell whether a JSON value is a number that can be calculated with."""
    return type(value) in (int, float) and abs(value) <= LARGEST


def is_usable(value: float) -> bool:
    """Tell whether products and quotients of a few such quantities stay positive and finite."""
    return 1 / USABLE <= value <= USABLE


def shown(value) -> str:
    """Return a JSON value as messages show it: one short line that any terminal can print."""
    if isinstance(value, dict):
        return f"an object of {_count(value, 'key')}" if value else "{}"
    if isinstance(value, list) and (len(value) > 6 or _is_nested(value)):
        return f"a list of {_count(value, 'value')}"
    return printable(json.dumps(value, ensure_ascii=False, default=str))


def printable(text) -> str:
    """Return a text cut to a length that messages can show, without what would upset a terminal."""
    text = text[: LONGEST + 1].encode("utf-8", "backslashreplace").decode()
    text = "".join(c if c.isprintable() else f"\\u{ord(c):04x}" for c in text)
    return text if len(text) <= LONGEST else text[: LONGEST - 1] + "…"


def _count(values, noun):
    return f"{len(values)} {noun}{'s'[: len(values) != 1]}"


def _is_nested(values):
    inside = [entry for value in values if isinstance(value, list) for entry in value]
    return any(isinstance(value, dict) for value in values) or any(
        isinstance(entry, dict | list) for entry in inside
    )
