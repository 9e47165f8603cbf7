"""The numbers of a case's `expected` key are read, measured and judged."""

import pytest
from scenes import cuboid, scene

import mpmgeo
from mpmgeo.verify.expected import compare, expectations

ENTRY = {
    "field": "displacement",
    "component": "z",
    "at": [1.5, 1.5, 6.5],
    "value": -4.905,
    "tolerance": 1e-6,
    "source": "free fall",
}


def falling(**expected):
    case = scene(
        [3, 3, 8],
        1.0,
        [cuboid([1, 1, 6], [2, 2, 7])],
        time=1.0,
        time_step=1e-3,
        gravity=[0, 0, -9.81],
        expected=expected,
    )
    return mpmgeo.load_case(case)


def test_a_run_is_compared_at_the_instants_asked_for():
    half = ENTRY | {"time": 0.5, "value": -4.905 / 4}
    case = falling(end=ENTRY, half=half, speed=ENTRY | {"field": "velocity", "value": 0.0})
    half, end, speed = compare(mpmgeo.Simulation(case), case)
    assert half.agrees
    assert end.agrees
    assert not speed.agrees
    assert "speed: -9.8" in str(speed)


def test_a_wrong_entry_is_refused():
    with pytest.raises(TypeError, match="tolerance"):
        expectations(falling(end={k: v for k, v in ENTRY.items() if k != "tolerance"}))
    with pytest.raises(TypeError, match="colour"):
        expectations(falling(end=ENTRY | {"colour": "red"}))


def test_a_case_may_expect_nothing():
    assert expectations(falling()) == []
