"""A factor in time: its values, and what is no factor."""

from math import pi, sin

import pytest

from mpmgeo.loads import BoxLoad, Gravity, PointLoad
from mpmgeo.loads.in_time import Course, SineRamp

TWO = {"time": (1.0, 3.0), "factor": (-1.0, 5.0)}


def test_a_course_is_linear_between_its_instants_and_held_beyond_them():
    course = Course(time=(1.0, 3.0, 4.0), factor=(0.5, 2.5, -1.0))
    assert [course.at(t) for t in (0.0, 1.0, 1.5, 3.0, 3.5, 4.0, 9.0)] == [
        *(0.5, 0.5, 1.0, 2.5, 0.75, -1.0, -1.0)
    ]
    assert course.largest == 2.5
    assert Course((2.0,), (7.0,)).at(0.0) == Course((2.0,), (7.0,)).at(3.0) == 7.0


def test_a_sine_ramp_grows_to_the_whole():
    ramp = SineRamp(duration=10.0)
    for t in (0.0, 1.0, 2.5, 5.0, 9.0):
        assert ramp.at(t) == pytest.approx(0.5 * (sin(pi * t / 10 - pi / 2) + 1), abs=1e-15)
    assert ramp.at(0.0) == 0.0 and ramp.at(10.0) == ramp.at(11.0) == 1.0


@pytest.mark.parametrize("keys", [{}, TWO, {"ramp": SineRamp(duration=1.0)}], ids=str)
def test_what_is_sound_has_no_problems(keys):
    gravity = Gravity(value=(0, 0, -1), **keys)
    assert not [*gravity.problems()]
    assert (gravity.course is None) == (not keys)


@pytest.mark.parametrize(
    ("text", "factor"),
    [
        ("time,factor\n0,0\n2,1\n", 0.5),
        ("Time [s]; Factor (-)\n0; 0\n2; 1\n", 0.5),
        ("# time factor\n0 0\n\n2 1\n", 0.5),
        ("0,0.25,not read\n", 0.25),
    ],
)
def test_files(tmp_path, text, factor):
    path = tmp_path / "f.csv"
    path.write_text(text)
    load = PointLoad(point=(0, 0, 0), force=(0, 0, 1), factor_file=path)
    assert not [*load.problems()]
    assert load.course.at(1.0) == factor


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("factor,time\n0,0\n", "line 1: the columns are 'factor, time'; needed: time, factor"),
        ("t,f,g\n0,0,0\n", "line 1: the columns are 't, f, g'; needed: time, factor"),
        ("time\n0\n", "line 1: the columns are 'time'; needed: time, factor"),
        ("time,factor\n", "no line with time and one factor"),
        ("0,0\n1\n", "line 2: needs time and one factor, has '1'"),
        ("0,0\n1,nan\n", "line 2: not all numbers are finite"),
        ("0,0\n0,1\n", "line 2: time 0 s does not exceed the time before it, 0 s"),
        ("0;0\n1;0,5\n", "line 2: '0,5' has a decimal comma; write a point"),
        ("0,0\n1,much\n", "line 2: 'much' is not a number"),
    ],
)
def test_files_that_cannot_be_used(tmp_path, text, message):
    path = tmp_path / "f.csv"
    path.write_text(text)
    box = {"point_p1": (0, 0, 0), "point_p2": (1, 1, 1), "load": (0, 0, 1)}
    ((key, found),) = BoxLoad(**box, factor_file=path).problems()
    assert key == "factor_file" and message in found
