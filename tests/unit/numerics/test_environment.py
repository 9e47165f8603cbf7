"""Settings of numba in the environment that no run can go with are named, with exit code 2."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

import mpmgeo
from mpmgeo.numerics.environment import Unusable, examine

WRONG = [
    ("NUMBA_DISABLE_JIT", "1"),
    ("NUMBA_DISABLE_JIT", "yes"),
    ("NUMBA_NUM_THREADS", "0"),
    ("NUMBA_NUM_THREADS", "abc"),
    ("NUMBA_NUM_THREADS", "-2"),
    ("NUMBA_NUM_THREADS", "1.5"),
    ("NUMBA_NUM_THREADS", "9" * 5000),
    ("NUMBA_THREADING_LAYER", "pthreads"),
]


@pytest.mark.parametrize(("name", "value"), WRONG)
def test_what_cannot_be_used_is_named(name, value):
    with pytest.raises(Unusable, match=name):
        examine({name: value})


@pytest.mark.parametrize(
    "sound",
    [
        {},
        {"NUMBA_DISABLE_JIT": "0"},
        {"NUMBA_NUM_THREADS": "2"},
        {"NUMBA_NUM_THREADS": " 2 ", "NUMBA_THREADING_LAYER": "workqueue"},
    ],
)
def test_what_can_be_used_is_left_alone(sound):
    given = dict(sound)
    examine(given)
    assert given == sound


def test_a_blank_value_is_none():
    given = {"NUMBA_NUM_THREADS": "", "NUMBA_DISABLE_JIT": " "}
    examine(given)
    assert given == {}


def python(*words, **variables):
    variables["PYTHONPATH"] = str(Path(mpmgeo.__file__).parents[1])
    return subprocess.run(
        [sys.executable, *words], env=os.environ | variables, capture_output=True, text=True
    )


@pytest.mark.parametrize(("name", "value"), [WRONG[0], WRONG[2], WRONG[3]])
@pytest.mark.parametrize("words", [["case.json"], ["benchmark"]])
def test_the_command_line_says_so(name, value, words):
    done = python("-m", "mpmgeo", *words, **{name: value})
    assert done.returncode == 2
    assert done.stderr.startswith(f"error: environment variable {name}: '{value}' is not accepted")
    assert len(done.stderr.splitlines()) == 1


def test_scripts_are_told_too():
    done = python("-c", "from mpmgeo import Simulation", NUMBA_DISABLE_JIT="1")
    assert "Unusable: environment variable NUMBA_DISABLE_JIT" in done.stderr


def test_a_layer_of_threads_that_is_not_there_is_a_message(monkeypatch):
    import numba

    from mpmgeo.numerics.chunks import most_threads

    def none():
        raise ValueError("No threading layer could be loaded.\nHINT: …")

    monkeypatch.setattr(numba.config, "THREADING_LAYER", "tbb")
    monkeypatch.setattr(numba, "get_num_threads", none)
    with pytest.raises(ValueError, match=r"NUMBA_THREADING_LAYER 'tbb'.*could be loaded.$"):
        most_threads()
