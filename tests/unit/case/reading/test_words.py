"""Words that people use lead to those of a case."""

import pytest

from mpmgeo.case.load import CaseError, load_case
from mpmgeo.case.reading.schema import case_schema
from mpmgeo.case.reading.words import MEANINGS, meant


def known_words(node):
    """Yield all keys and words of a schema."""
    if isinstance(node, dict):
        yield from node.get("properties", ())
        yield from node.get("enum", ())
        for value in node.values():
            yield from known_words(value)
    elif isinstance(node, list):
        for value in node:
            yield from known_words(value)


def test_every_meaning_is_a_word_of_a_case():
    assert set(MEANINGS) <= set(known_words(case_schema()))


@pytest.mark.parametrize("word", MEANINGS)
def test_every_word_leads_to_its_meaning(word):
    for other in MEANINGS[word]:
        assert meant(other, [word]) == word
        assert meant(other.upper(), ["quite_unlike", word]) == word


UNKNOWN = [
    ((), "dt", "time_step"),
    ((), "duration", "time"),
    ((), "End_Time", "time"),
    (("materials", "soil"), "E", "young"),
    (("materials", "soil"), "nu", "poisson"),
    (("materials", "soil"), "rho", "density"),
    (("body", "block"), "velocity", "initial_velocity"),
    (("body", "block"), "min", "point_p1"),
    (("mesh",), "cell_size", "cells_dimension"),
]


@pytest.mark.parametrize(("place", "word", "right"), UNKNOWN)
def test_unknown_keys(case, place, word, right):
    part = case
    for key in place:
        part = part[key]
    part[word] = 1
    (warning,) = load_case(case).warnings
    where = ".".join([*place, word])
    assert warning == f'{where}: unknown key, ignored; did you mean "{right}"?'


def test_keys_of_a_law(case):
    case["materials"]["soil"] |= {"type": "mohr-coulomb", "cohesion": 1.0, "phi": 30, "psi": 0}
    warnings = load_case(case).warnings
    assert 'materials.soil.phi: unknown key, ignored; did you mean "friction"?' in warnings
    assert 'materials.soil.psi: unknown key, ignored; did you mean "dilation"?' in warnings


@pytest.mark.parametrize(
    ("place", "key", "word", "right"),
    [
        (("body", "block"), "type", "box", "cuboid"),
        (("body", "block"), "type", "Ball", "sphere"),
        (("materials", "soil"), "type", "linear-elastic", "elastic"),
        (("materials", "soil"), "type", "water", "newtonian"),
        (("damping",), "type", "rayleigh", "mass"),
        (("mesh", "boundary_conditions"), "plane_Z0", "roller", "sliding"),
    ],
)
def test_words_after_a_key(case, place, key, word, right):
    case["damping"], case["mesh"]["boundary_conditions"] = {"type": "none"}, {}
    part = case
    for step in place:
        part = part[step]
    part[key] = word
    with pytest.raises(CaseError) as caught:
        load_case(case)
    assert caught.value.problems[0].endswith(f'did you mean "{right}"?')
