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
            for watcher in begun:
                watcher.end(simulation, error)
