"""The time loop: whom it tells what, in which order, however the run ends."""

import os
import signal

import pytest

import mpmgeo
from mpmgeo.run.loop import run
from mpmgeo.run.watch import StopRun


class Stepper:
    """A simulation of nothing, in steps of one second."""

    def __init__(self, log, fails_in=None, time_step=1.0):
        self.time_step = time_step
        self.log, self.fails_in = log, fails_in
        self.time, self.interrupted = 0.0, None

    def advance(self):
        self.time += self.time_step
        self.log.append("step")
        if self.time == self.fails_in:
            raise ArithmeticError("no more")


class Watcher:
    """Writes down what it is told; `stumbles` names the call in which it fails."""

    def __init__(self, name, log, stumbles=None):
        self.name, self.log, self.stumbles = name, log, stumbles

    def _told(self, call):
        self.log.append(f"{self.name} {call}")
        if self.stumbles == call:
            raise OSError("disk full")

    def begin(self, simulation):
        self._told("begin")

    def after_step(self, simulation):
        self._told("after")

    def end(self, simulation, error):
        self.error = error
        self._told("end")


@pytest.fixture
def log():
    return []


def test_order(log):
    simulation = Stepper(log)
    run(simulation, 2.0, [Watcher("a", log), Watcher("b", log)])
    step = ["step", "a after", "b after"]
    assert log == ["a begin", "b begin", *step, *step, "a end", "b end"]
    assert simulation.interrupted is False


@pytest.mark.parametrize("until, steps", [(0.0, 0), (0.5, 1), (1.0, 1), (2.5, 3)])
def test_runs_while_time_is_left(log, until, steps):
    run(Stepper(log), until, [])
    assert log == ["step"] * steps


@pytest.mark.parametrize("count", [3, 10, 531, 1000, 6000])
def test_round_off_costs_no_step(log, count):
    """Sums of such steps fall short of the time, or exceed it, by round-off."""
    for time in (0.1, 0.3, 0.7, 1.0):
        simulation = Stepper(log, time_step=time / count)
        log.clear()
        run(simulation, time, [])
        run(simulation, time, [])
        assert log == ["step"] * count


def test_what_is_left_is_run(log):
    run(Stepper(log), 2.02, [])
    assert log == ["step"] * 3


def test_end_hears_of_the_error(log):
    watcher = Watcher("a", log)
    with pytest.raises(ArithmeticError) as caught:
        run(Stepper(log, fails_in=2.0), 5.0, [watcher])
    assert log == ["a begin", "step", "a after", "step", "a end"]
    assert watcher.error is caught.value


def test_end_without_error(log):
    watcher = Watcher("a", log)
    run(Stepper(log), 1.0, [watcher])
    assert watcher.error is None


def test_only_those_that_began_are_ended(log):
    watchers = [Watcher("a", log), Watcher("b", log, stumbles="begin"), Watcher("c", log)]
    with pytest.raises(OSError):
        run(Stepper(log), 1.0, watchers)
    assert log == ["a begin", "b begin", "a end", "b end"]


@pytest.mark.parametrize("call", ["after", "end"])
def test_all_are_ended_although_one_fails(log, call):
    """A full disk may not leave the progress bar open."""
    watchers = [Watcher("a", log, stumbles=call), Watcher("b", log)]
    with pytest.raises(OSError, match="disk full"):
        run(Stepper(log), 1.0, watchers)
    assert log[-2:] == ["a end", "b end"]


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_an_interrupt_ends_the_run_after_its_step(log, number):
    class Interrupting(Watcher):
        def after_step(self, simulation):
            super().after_step(simulation)
            if simulation.time == 2.0:
                os.kill(os.getpid(), number)

    simulation = Stepper(log)
    first, second = Interrupting("a", log), Watcher("b", log)
    run(simulation, 100.0, [first, second])
    assert simulation.interrupted is True and simulation.time == 2.0
    assert log[-3:] == ["b after", "a end", "b end"]
    assert first.error is None


def test_the_base_class_does_nothing(log):
    """It has every method that is told something, and can be subclassed for one of them."""

    class Counting(mpmgeo.Watcher):
        count = 0

        def after_step(self, simulation):
            self.count += 1

    watcher = Counting()
    run(Stepper(log), 3.0, [watcher, mpmgeo.Watcher()])
    assert watcher.count == 3


@pytest.mark.parametrize("method", ["begin", "after_step", "end"])
def test_methods_may_be_left_out(log, method):
    """By an object of any class."""
    told = []
    watcher = type("Short", (), {method: lambda *arguments: told.append(len(arguments))})()
    run(Stepper(log), 2.0, [watcher])
    assert told == {"begin": [2], "after_step": [2, 2], "end": [3]}[method]


def stopping(log, call):
    class Stopping(Watcher):
        def _told(self, now):
            super()._told(now)
            if now == call and log.count(f"{self.name} {call}") == 2 - (call == "begin"):
                raise StopRun("enough")

    return Stopping("a", log)


def test_a_watcher_stops_the_run(log):
    """After the step that it is told of, which the others are told of as well; it is no error."""
    simulation, second = Stepper(log), Watcher("b", log)
    run(simulation, 100.0, [stopping(log, "after"), second])
    assert simulation.time == 2.0
    assert log[-5:] == ["step", "a after", "b after", "a end", "b end"]
    assert second.error is None
    assert simulation.stopped == "enough" and simulation.interrupted is False


def test_a_watcher_stops_the_run_before_it_begins(log):
    simulation = Stepper(log)
    run(simulation, 100.0, [stopping(log, "begin"), Watcher("b", log)])
    assert log == ["a begin", "b begin", "a end", "b end"]
    assert simulation.stopped == "enough"


def test_the_reason_of_an_earlier_stop_is_forgotten(log):
    simulation = Stepper(log)
    run(simulation, 100.0, [stopping(log, "after")])
    run(simulation, 5.0, [])
    assert simulation.time == 5.0 and simulation.stopped is None
