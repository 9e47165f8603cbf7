"""The time loop: it knows no physics."""

from mpmgeo.run.interrupt import Interrupt


def run(simulation, until, watchers):
    """Step a simulation to time `until` [s], telling the watchers.

    Watchers have `begin(simulation)`, `after_step(simulation)` and `end(simulation, error)`; `end`
    is called in any case, with the error that ended the run or None. The first interrupt ends the
    run after the step that it falls in and sets `simulation.interrupted`.
    """
    begun, error = [], None
    with Interrupt() as interrupt:
        try:
            for watcher in watchers:
                begun.append(watcher)
                watcher.begin(simulation)
            while simulation.time < until and not interrupt.asked:
                simulation.advance()
                for watcher in watchers:
                    watcher.after_step(simulation)
        except BaseException as caught:
            error = caught
            raise
        finally:
            simulation.interrupted = interrupt.asked
            _end(begun, simulation, error)


def _end(watchers, simulation, error):
    """End all watchers, even if one of them fails; raise the first such failure at the end."""
    failures = []
    for watcher in watchers:
        try:
            watcher.end(simulation, error)
        except Exception as failure:
            failures.append(failure)
    if failures:
        raise failures[0]
