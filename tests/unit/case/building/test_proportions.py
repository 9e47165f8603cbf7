"""What only a built case shows to be hardly meant."""

import numpy as np
import pytest
from test_lint import simulation_of

from mpmgeo.case.building.lint import lint


def warning_of(case, **times):
    (warning,) = lint(simulation_of(case, **times))
    return warning


def test_an_automatic_step_longer_than_the_run(case):
    del case["time_step"]
    assert warning_of(case, time_step=0.2, stable_time_step=0.8) == (
        "time: the time step chosen from the critical one, 0.2 s, is longer than the run, 0.1 s; "
        "is a stiffness or density in other units?"
    )


def test_a_body_heavier_than_its_stiffness(case):
    case["materials"]["soil"]["young"] = 1e4
    case["gravity"] = [0, 0, -9.81]
    assert lint(simulation_of(case)) == [
        "body 1: its own weight, 1.47e+04 Pa at the bottom, exceeds the stiffness of material 1, "
        "young 10000 Pa; is that in kPa or MPa?"
    ]
    case["materials"]["soil"]["young"] = 1e5
    assert lint(simulation_of(case)) == []


def test_gravity_upwards(case):
    case["gravity"] = [0, 0, 9.81]
    assert warning_of(case) == "gravity: 9.81 m/s² along z points up"


def test_gravity_in_time_counts_where_it_is_largest(case):
    table = {"time": [0, 1, 2], "factor": [0, -2, 1]}
    case["gravity"] = {"value": [0, 0, -10]} | table
    assert warning_of(case) == "gravity: 20 m/s² along z points up"
    case["gravity"] = {"value": [0, 0, -10], "ramp": {"type": "sine", "duration": 1}}
    assert lint(simulation_of(case)) == []
    case["materials"]["soil"]["young"] = 1e4
    assert warning_of(case).startswith("body 1: its own weight, 1.5e+04 Pa at the bottom")


@pytest.mark.parametrize(
    ("gravity", "plane"), [([0, -9.81, 0], "Y0"), ([0, 9.81, 0], "Yn"), ([9.81, 0, 0], "Xn")]
)
def test_gravity_along_another_axis_than_the_bodies_stand_on(case, gravity, plane):
    case["body"]["block"] |= {"point_p1": [0.5, 0.5, 0], "point_p2": [1.5, 1.5, 1]}
    case["gravity"] = gravity
    assert warning_of(case) == (
        f"gravity: points to the plane {plane}, while the bodies stand on Z0"
    )
    at = "XYZ".index(plane[0])
    lower = plane[1] == "0"
    case["body"]["block"]["point_p1" if lower else "point_p2"][at] = 0.0 if lower else 2.0
    assert lint(simulation_of(case)) == []


def test_gravity_of_a_tilted_base(case):
    case["body"]["block"] |= {"point_p1": [0.5, 0.5, 0], "point_p2": [1.5, 1.5, 1]}
    case["gravity"] = [7.07, 0, -7.07]
    assert lint(simulation_of(case)) == []


SAND = {"type": "mohr-coulomb", "friction": 30, "cohesion": 100.0}


def test_no_gravity_and_nothing_else_acts(case):
    case["materials"]["soil"] |= SAND
    absent = "gravity: absent, and nothing else acts on the bodies (mohr-coulomb)"
    assert warning_of(case) == absent
    case["body"]["block"]["initial_velocity"] = [1, 0, 0]
    assert lint(simulation_of(case)) == []


def test_no_gravity_where_strength_needs_it(case):
    case["volumetric_locking"] = "cells"
    case["materials"]["soil"] |= SAND | {"su_vertical_stress": 0.3}
    case["body"]["block"]["initial_velocity"] = [1, 0, 0]
    assert warning_of(case) == "gravity: absent, while su_vertical_stress needs a vertical stress"


def test_a_body_faster_than_its_waves(case):
    case["body"]["block"]["initial_velocity"] = [0, 0, -300]
    assert warning_of(case).startswith(
        "body 1: 300 m/s at the start is not small beside the speed of waves in its material, 25.9"
    )
    case["body"]["block"]["initial_velocity"] = [0, 0, -12]
    assert lint(simulation_of(case)) == []


def test_a_body_that_crosses_the_mesh_many_times(case):
    case["materials"]["soil"]["young"] = 1e11
    case["body"]["block"]["initial_velocity"] = [0, 0, -500]
    assert warning_of(case) == (
        "body 1: 500 m/s at the start lead 50 m far during the run, in a mesh 3.46 m across"
    )


def test_a_prescribed_velocity_that_leads_out_of_the_mesh(case):
    case["prescribed_velocity"] = {"ram": {"body": 1, "velocity": [300, None, None]}}
    assert warning_of(case) == (
        "prescribed_velocity, ram: leads 30 m far during the run, in a mesh 3.46 m across"
    )


def test_a_record_in_other_units(case, tmp_path):
    time = np.linspace(0, 1, 101)
    record = np.c_[time, 300 * np.sin(2 * np.pi * time), 0 * time, 0 * time]
    np.savetxt(tmp_path / "r.csv", record, delimiter=",", header="t,x,y,z", comments="")
    case["earthquake"] = {"active": True, "file": str(tmp_path / "r.csv")}
    assert warning_of(case) == (
        "earthquake: the record reaches 300 m/s², 31 times gravity; is it in cm/s²?"
    )
