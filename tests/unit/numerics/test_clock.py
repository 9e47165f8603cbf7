from time import sleep

from mpmgeo.numerics.clock import Clock


def test_laps_add_up_by_stage():
    clock = Clock()
    sleep(0.05)
    clock.begin()
    for _ in range(2):
        sleep(0.01)
        clock.lap("scatter")
    clock.lap("gather")
    assert list(clock.seconds) == ["scatter", "gather"]
    assert clock.seconds["scatter"] >= 0.02
    assert clock.seconds["gather"] < 0.02


def test_time_left_out_counts_for_no_stage():
    clock = Clock()
    clock.begin()
    sleep(0.05)
    clock.leave_out(0.05)
    clock.lap("scatter")
    assert clock.seconds["scatter"] < 0.04
