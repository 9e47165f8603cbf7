"""Signals while a run is on, and what is left of that afterwards."""

import signal
import threading

import pytest

from mpmgeo.run.interrupt import Interrupt

HANGUP = pytest.mark.skipif(not hasattr(signal, "SIGHUP"), reason="signals of POSIX")
BOTH = pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])


@pytest.fixture
def handlers():
    """Our own handlers for both signals, which write down what comes; put back after the test."""
    heard = []
    numbers = (signal.SIGINT, signal.SIGTERM)
    before = [signal.signal(n, lambda number, _: heard.append(number)) for n in numbers]
    yield heard
    for number, handler in zip(numbers, before, strict=True):
        signal.signal(number, handler)


@BOTH
def test_the_first_asks_and_the_second_acts(handlers, number):
    with Interrupt() as interrupt:
        assert not interrupt.asked
        signal.raise_signal(number)
        assert interrupt.asked and not handlers
        signal.raise_signal(number)
        assert handlers == [number]


def test_the_second_may_be_the_other_one(handlers):
    with Interrupt():
        signal.raise_signal(signal.SIGINT)
        signal.raise_signal(signal.SIGTERM)
    assert handlers == [signal.SIGTERM]


@BOTH
def test_handlers_are_put_back(handlers, number):
    with Interrupt() as interrupt:
        pass
    signal.raise_signal(number)
    assert handlers == [number] and not interrupt.asked


def test_handlers_are_put_back_after_an_error(handlers):
    with pytest.raises(ValueError), Interrupt():
        raise ValueError
    signal.raise_signal(signal.SIGINT)
    assert handlers == [signal.SIGINT]


def test_ctrl_c_twice_is_a_keyboard_interrupt():
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        with pytest.raises(KeyboardInterrupt), Interrupt():
            signal.raise_signal(signal.SIGINT)
            signal.raise_signal(signal.SIGINT)
    finally:
        signal.signal(signal.SIGINT, before)


@HANGUP
def test_a_hangup_asks_and_those_after_it_are_ignored(handlers):
    """A shell sends one to its jobs, the system another."""
    number = signal.SIGHUP
    before = signal.signal(number, lambda number, _: handlers.append(number))
    try:
        with Interrupt() as interrupt:
            signal.raise_signal(number)
            assert interrupt.asked
            signal.raise_signal(number)
            assert not handlers
            signal.raise_signal(signal.SIGTERM)
        signal.raise_signal(number)
    finally:
        signal.signal(number, before)
    assert handlers == [signal.SIGTERM, number]


@HANGUP
def test_a_hangup_that_is_ignored_stays_so():
    """As nohup asks for."""
    before = signal.signal(signal.SIGHUP, signal.SIG_IGN)
    try:
        with Interrupt() as interrupt:
            signal.raise_signal(signal.SIGHUP)
        assert not interrupt.asked
        assert signal.getsignal(signal.SIGHUP) == signal.SIG_IGN
    finally:
        signal.signal(signal.SIGHUP, before)


def test_runs_outside_the_main_thread_leave_signals_alone():
    asked = []

    def work():
        with Interrupt() as interrupt:
            asked.append(interrupt.asked)

    thread = threading.Thread(target=work)
    thread.start()
    thread.join()
    assert asked == [False]
