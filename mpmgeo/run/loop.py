"""The time loop: it knows no physics."""

from mpmgeo.instants import has_come_to
from mpmgeo.run.interrupt import Interrupt
from mpmgeo.run.watch import StopRun, Watcher

NOBODY = Watcher()
"""Hears what a watcher has no method for."""


def run(simulation, until, watchers):
    """Step a simulation to time `until` [s], telling the watchers.

    Watchers have methods of `Watcher`; `end` is called in any case, with the error that ended the
    run or None. The first interrupt ends the run after the step that it falls in and sets
    `simulation.interrupted`; a watcher that raises StopRun ends it after the step that it is told
    of, and `simulation.stopped` is then the reason that it gives, None otherwise.
    """
    begun, error = [], None
    simulation.stopped = None
    with Interrupt() as interrupt:
        try:
            for watcher in watchers:
                begun.append(watcher)
                _tell([watcher], "begin", simulation)
            while not (
                has_come_to(simulation, until) or interrupt.asked or simulation.stopped is not None
            ):
                simulation.advance()
                _tell(watchers, "after_step", simulation)
        except BaseException as caught:
            error = caught
            raise
        finally:
            simulation.interrupted = interrupt.asked
            _end(begun, simulation, error)


def _tell(watchers, what, simulation):
    """Call a method of all watchers, even if one of them wants the run to stop."""
    for watcher in watchers:
        try:
            getattr(watcher, what, getattr(NOBODY, what))(simulation)
        except StopRun as stop:
            if simulation.stopped is None:
                simulation.stopped = str(stop)


def _end(watchers, simulation, error):
    """End all watchers, even if one of them fails; raise the first such failure at the end."""
    failures = []
    for watcher in watchers:
        try:
            getattr(watcher, "end", NOBODY.end)(simulation, error)
        except Exception as failure:
            failures.append(failure)
    if failures:
        raise failures[0]
