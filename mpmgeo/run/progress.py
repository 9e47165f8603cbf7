"""What the user sees of a run: its time step, a live bar or plain lines, a table at the end."""

import sys
from math import inf
from time import perf_counter

from numba.core import event

from mpmgeo.run.bar import REFRESH, Bar
from mpmgeo.run.rest import figures
from mpmgeo.run.terminal import without_controls
from mpmgeo.run.watch import Watcher

LINE = 10.0  # s between plain lines


class Compilation(event.Listener):
    """Notices when kernels are compiled, tells the user once, and adds up the time."""

    def __init__(self, tell):
        self.seconds = 0.0
        self.clock = None  # whose stages the time is no part of
        self._tell = tell
        self._depth = 0

    def __enter__(self):
        event.register("numba:compile", self)
        return self

    def __exit__(self, *_):
        event.unregister("numba:compile", self)

    @property
    def running(self):
        """Seconds of compilation so far if kernels are being compiled, else None."""
        return self.seconds + perf_counter() - self._begin if self._depth else None

    def on_start(self, _):
        """Note that a compilation begins, perhaps inside another one; numba calls this."""
        if self._depth == 0:
            self._begin = perf_counter()
            if not self.seconds:
                self._tell()
        self._depth += 1

    def on_end(self, _):
        """Count the time of an outermost compilation; numba calls this."""
        self._depth -= 1
        if self._depth == 0:
            seconds = perf_counter() - self._begin
            self.seconds += seconds
            if self.clock is not None:
                self.clock.leave_out(seconds)


class Progress(Watcher):
    """Watches a run and shows step, time, share done, time left, speed and kinetic energy."""

    def __init__(self, compilation, stream=None):
        self.compilation = compilation
        self.stream = stream or sys.stderr
        self.live = self.stream.isatty()
        self._bar = None

    def begin(self, simulation):
        """Start the clock and, on a terminal, the bar."""
        self.compilation.clock = simulation.solver.clock
        self._start = self._shown = perf_counter()
        self._first_step = None
        self._work = self._first_work = 0  # steps of active particles
        self._messages = len(simulation.messages)
        if self.live:
            self._bar = Bar(self.stream, simulation.case.time, self.compilation)

    def after_step(self, simulation):
        """Show the state if it is time to."""
        if len(simulation.messages) > self._messages:
            self._news(simulation)
        self._work += simulation.solver.active
        now = perf_counter()
        if self._first_step is None:
            self._first_step = self._shown = now
            self._compiled = self.compilation.seconds
            self._first_work, self._first_time = self._work, simulation.time
            return
        if now - self._shown < (REFRESH if self.live else LINE):
            return
        self._shown = now
        self._show(simulation, now)

    def _seconds(self, now):
        """Return the time [s] since the first step, without that of compilation; 0 before it."""
        if self._first_step is None:
            return 0.0
        return now - self._first_step - (self.compilation.seconds - self._compiled)

    def _speed(self, now):
        if self._first_step is None:
            return 0.0
        return (self._work - self._first_work) / max(self._seconds(now), 1e-9) / 1e6

    def _left(self, simulation, now):
        """Return the time that the run still takes [s], None before there is an estimate."""
        done = 0.0 if self._first_step is None else simulation.time - self._first_time
        if not done > 0:
            return None
        return max(simulation.case.time - simulation.time, 0.0) * self._seconds(now) / done

    def _show(self, simulation, now):
        speed, left = self._speed(now), self._left(simulation, now)
        energy = simulation.kinetic_energy()
        if self._bar is not None:
            time, steps = simulation.time, simulation.steps
            self._bar.update(
                left, time, step=steps, speed=speed, energy=energy, rest=figures(simulation)
            )
            return
        share = min(simulation.time / simulation.case.time, 1.0)
        ahead = "" if left is None else f"{left:.0f} s left, "
        self._print(
            f"step {simulation.steps}, t = {simulation.time:.4g} s, {100 * share:.0f}%, "
            f"{ahead}{speed:.2f} M particle-steps/s, Ekin {energy:.3e} J{figures(simulation)}"
        )

    def _news(self, simulation):
        for message in simulation.messages[self._messages :]:
            self._print(f"note: {message}")
        self._messages = len(simulation.messages)

    def _print(self, line):
        """Print a line that may hold words of the user, which are no markup."""
        line = without_controls(line)
        if self._bar is not None:
            self._bar.print(line)
            return
        print(line, file=self.stream, flush=True)

    def end(self, simulation, error):
        """Close the bar and show where the time went."""
        now = perf_counter()
        if self._bar is not None:
            self._show(simulation, now)
            self._bar.stop()
            self._bar = None
        self._news(simulation)
        if error is None:
            self._table(simulation, now)

    def _table(self, simulation, now):
        from rich.console import Console
        from rich.table import Table
        from rich.text import Text

        title = Text(without_controls(simulation.case.title or ""), "table.title")
        table = Table(title=title or None, show_edge=False, header_style="")
        table.add_column("stage")
        table.add_column("s", justify="right")
        table.add_column("ns/particle/step", justify="right")
        work = max(self._work, 1)
        for stage, seconds in simulation.solver.clock.seconds.items():
            table.add_row(stage, f"{seconds:.2f}", f"{seconds / work * 1e9:.1f}")
        console = Console(file=self.stream, highlight=False)
        console.print(table)
        self._print(
            f"{simulation.steps} steps, {simulation.solver.count} particles, "
            f"{now - self._start:.2f} s, {self._speed(now):.2f} M particle-steps/s, "
            f"compilation {self.compilation.seconds:.1f} s, "
            f"peak memory {peak_memory() / 2**20:.0f} MiB, {simulation.threads} thread(s)"
        )


def about_step(simulation):
    """Return the time step beside those that it may be compared with."""
    stable, step = simulation.stable_time_step, f"time step {simulation.time_step:.4g} s"
    step += " at the start, adaptive" if simulation.case.is_adaptive else ""
    if stable == inf:  # no particles
        return step
    limit = f"stable up to {stable:.4g} s" if stable else "no step is stable"
    critical = f"critical {simulation.critical_time_step:.4g} s (a wave across a cell)"
    return f"{step}; {limit}, {critical}"


def peak_memory():
    """Return the largest memory that this process has had [bytes]."""
    if sys.platform == "win32":
        import ctypes
        from ctypes import wintypes

        size = ctypes.sizeof(ctypes.c_size_t)
        counters = (ctypes.c_char * (2 * 4 + 8 * size))()
        process = wintypes.HANDLE(-1)
        ctypes.windll.psapi.GetProcessMemoryInfo(process, counters, len(counters))
        return int.from_bytes(counters[8 : 8 + size], "little")
    import resource

    unit = 1 if sys.platform == "darwin" else 1024
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * unit
