"""Whatever happens to a valid case: a Case or a CaseError with reasons, in no time."""

import copy
import json
from pathlib import Path
from time import perf_counter

from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from mpmgeo.case.load import CaseError, load_case, resolved
from mpmgeo.case.spec import Case

SOUND = json.loads(Path(__file__).with_name("sound.json").read_text())

LONGEST = 5.0
"""Seconds that no file of this size may take, on a machine that does other things too."""

WORDS = st.sampled_from(
    [
        *("type", "id", "active", "file", "value", "alpha", "fields", "material", "point_p1"),
        *("mohr-coulomb", "gmsh", "none", "all", "kinetic", "sphere", "MUSL", "record.csv", "y"),
    ]
)
NUMBERS = st.one_of(
    st.integers(), st.floats(), st.sampled_from([0, -1, 0.5, 1e300, -1e-300, 2**31, 10**400])
)
SCALARS = st.one_of(st.none(), st.booleans(), NUMBERS, st.text(max_size=20), WORDS)
JUNK = st.recursive(
    SCALARS,
    lambda inner: st.one_of(
        st.lists(inner, max_size=4),
        st.dictionaries(st.one_of(WORDS, st.text(max_size=8)), inner, max_size=4),
    ),
    max_leaves=8,
)


def paths_of(node, path=()):
    """Return the paths of all values of a tree, but that of the whole."""
    children = node.items() if isinstance(node, dict) else enumerate(node)
    found = []
    for key, value in children:
        found.append((*path, key))
        if isinstance(value, dict | list):
            found += paths_of(value, (*path, key))
    return found


def delete(draw, parent, key):
    del parent[key]


def replace(draw, parent, key):
    parent[key] = draw(JUNK)


def rename(draw, parent, key):
    new = draw(st.one_of(WORDS, st.text(max_size=8), st.just(str(key)[:-1] + "x")))
    if isinstance(parent, dict):
        parent[new] = parent.pop(key)


def scale(draw, parent, key):
    if isinstance(parent[key], int | float):
        parent[key] *= draw(st.sampled_from([0, -1, 1e-30, 1e-6, 1e6, 1e30, 1e90, 1e200]))


def wrap(draw, parent, key):
    parent[key] = draw(st.sampled_from([[parent[key]], {"fields": parent[key]}, str(parent[key])]))


def insert(draw, parent, key):
    if isinstance(parent, dict):
        parent[draw(st.one_of(WORDS, st.text(max_size=8)))] = draw(JUNK)
    else:
        parent.insert(key, draw(JUNK))


def swap(draw, parent, key):
    """Move in the value of another key of the same object."""
    keys = list(parent) if isinstance(parent, dict) else range(len(parent))
    parent[key] = copy.deepcopy(parent[draw(st.sampled_from(keys))])


MUTATIONS = st.sampled_from([delete, replace, rename, scale, wrap, insert, swap])


@st.composite
def mutated_cases(draw):
    """Draw a valid case after one to four mutations."""
    case = copy.deepcopy(SOUND)
    for _ in range(draw(st.integers(1, 4))):
        paths = paths_of(case)
        if not paths:
            break
        *place, key = draw(st.sampled_from(paths))
        parent = case
        for step in place:
            parent = parent[step]
        draw(MUTATIONS)(draw, parent, key)
    return case


def load_in_time(source):
    """Load a case or catch its CaseError, checking what must hold of either."""
    start = perf_counter()
    try:
        case = load_case(source)
    except CaseError as error:
        assert error.problems
        assert all(isinstance(problem, str) and problem for problem in error.problems)
        return None
    finally:
        assert perf_counter() - start < LONGEST
    assert isinstance(case, Case)
    return case


SHARED = [HealthCheck.function_scoped_fixture, HealthCheck.too_slow]


@given(mutated_cases())
@settings(max_examples=400, deadline=None, suppress_health_check=SHARED)
def test_mutated_cases_load_or_say_why_not(folder, case):
    loaded = load_in_time(case)
    if loaded is not None:
        again = json.loads(json.dumps(resolved(loaded)))
        assert load_case(again) == loaded


@given(st.data())
@settings(max_examples=150, deadline=None, suppress_health_check=SHARED)
def test_mutated_texts_load_or_say_why_not(folder, data):
    text = json.dumps(SOUND, indent=1).encode()
    start = data.draw(st.integers(0, len(text)))
    end = data.draw(st.integers(start, min(start + 40, len(text))))
    inserted = data.draw(
        st.one_of(
            st.binary(max_size=6), st.sampled_from([b"NaN", b"1e999", b"//", b"[[", b"}", b","])
        )
    )
    file = folder / "case.json"
    file.write_bytes(text[:start] + inserted + text[end:])
    load_in_time(file)


@given(JUNK)
@settings(max_examples=100, deadline=None, suppress_health_check=SHARED)
def test_any_json_loads_or_says_why_not(folder, junk):
    file = folder / "case.json"
    file.write_text(json.dumps(junk))
    assert load_in_time(file) is None
