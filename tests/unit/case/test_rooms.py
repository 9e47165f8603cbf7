"""The way of a case file: it goes through each room once and does not come back."""

import sys
from itertools import groupby
from pathlib import Path

import pytest

import mpmgeo.case
from mpmgeo.case.building.solver import build
from mpmgeo.case.load import CaseError, load_case

CASE = Path(mpmgeo.case.__file__).parent


def rooms_of(action):
    """Return the folders of `case/` in whose files functions run, in order."""
    visited = []

    def watch(frame, event, _):
        path = Path(frame.f_code.co_filename)
        if event == "call" and path.parent.parent == CASE:
            visited.append(path.parent.name)

    sys.setprofile(watch)
    try:
        action()
    finally:
        sys.setprofile(None)
    return [room for room, _ in groupby(visited)]


@pytest.fixture
def everything(case):
    """A case of which every room has something to do."""
    box = {"point_p1": [0, 0, 0], "point_p2": [1, 1, 1]}
    case["material"] = case.pop("materials")
    return case | {
        "nodal_point_loads": [[[1, 1, 1], [0, 0, 1]]],
        "load_distributed_box": [box | {"load": [0, 0, 1]}],
        "prescribed_velocity": {"ram": box | {"velocity": [0, None, 1]}},
        "initial_pressure_box": [box | {"pressure": 1}],
        "results": {"fields": "stress", "probes": [{"type": "planes"}]},
        "terrain_contact": {"active": False},
    }


def test_a_sound_case_goes_through_each_room_once(everything):
    assert rooms_of(lambda: build(load_case(everything))) == ["reading", "meaning", "building"]


def test_a_broken_case_does_not_come_back_either(everything):
    everything["time"] = -1
    everything["body"]["block"] |= {"material_id": 7, "point_p2": [1, 1, -1]}
    everything["nodal_point_loads"] += [[[9, 9, 9], [0, 0, 1]]]

    def load():
        with pytest.raises(CaseError) as caught:
            load_case(everything)
        assert len(caught.value.problems) == 4

    assert rooms_of(load) == ["reading", "meaning"]
