"""Numbers that can be calculated with, and values as messages show them."""

import math

import pytest

from mpmgeo.values import is_number, shown


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (1.5, "1.5"),
        (True, "true"),
        ("soil", '"soil"'),
        ([1, 2], "[1, 2]"),
        ([1], "[1]"),
        ({}, "{}"),
        ({"a": 1}, "an object of 1 key"),
        (list(range(9)), "a list of 9 values"),
        ([[[1]]], "a list of 1 value"),
        ([{"a": 1}], "a list of 1 value"),
        (float("nan"), "NaN"),
        ("\x1b[31m", '"\\u001b[31m"'),
        ("\ud800", '"\\ud800"'),
        ("\u202eevil", '"\\u202eevil"'),
    ],
)
def test_values_show_as_short_printable_json(value, text):
    assert shown(value) == text


def test_long_values_are_cut():
    assert len(shown("x" * 10_000)) == 60


@pytest.mark.parametrize("value", [0, -1.5, 1e100])
def test_numbers(value):
    assert is_number(value)


@pytest.mark.parametrize("value", [True, "1", None, math.nan, math.inf, 1.1e100, 10**400, [1]])
def test_what_is_no_number(value):
    assert not is_number(value)
