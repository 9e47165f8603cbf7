"""What a terminal shows of a run: the time left at any width, and that kernels are compiled."""

import io
import re
from types import SimpleNamespace

import pytest
from rich.console import Console

from mpmgeo.numerics.clock import Clock
from mpmgeo.run import progress
from mpmgeo.run.bar import Bar, clock
from mpmgeo.run.progress import Compilation, Progress


class Terminal(io.StringIO):
    """A stream that says that it is a terminal."""

    def isatty(self):
        return True


class Simulation:
    """Steps of 0.01 s of a million particles, without any."""

    def __init__(self):
        self.case = SimpleNamespace(time=10.0, title="")
        self.solver = SimpleNamespace(
            count=1_000_000, active=1_000_000, clock=Clock(), effect=lambda name: None
        )
        self.steps, self.messages, self.threads = 0, [], 1

    @property
    def time(self):
        return 0.01 * self.steps

    def kinetic_energy(self):
        return 1234.5


@pytest.fixture
def now(monkeypatch):
    """A clock that stands still until a test sets `now.seconds`."""
    now = SimpleNamespace(seconds=1000.0)
    monkeypatch.setattr(progress, "perf_counter", lambda: now.seconds)
    return now


@pytest.fixture
def columns(monkeypatch):
    """A function that sets the width of the terminal."""
    monkeypatch.setenv("TERM", "xterm")
    return lambda width: monkeypatch.setenv("COLUMNS", str(width))


@pytest.fixture
def watch():
    """A function that returns a watcher of a simulation, and closes its bar after the test."""
    watchers = []

    def watch(simulation, stream):
        watchers.append((Progress(Compilation(lambda: None), stream), simulation))
        watchers[-1][0].begin(simulation)
        return watchers[-1][0]

    yield watch
    for watcher, simulation in watchers:
        watcher.end(simulation, RuntimeError())


def shown(watcher, width):
    """Return the line of a watcher as the terminal shows it now."""
    screen = Console(file=io.StringIO(), width=width)
    screen.print(watcher._bar._progress.get_renderable())
    lines = screen.file.getvalue().splitlines()
    assert len(lines) == 1
    return lines[0]


def steps(watcher, simulation, now, count, seconds):
    """Do steps that take some seconds together."""
    for _ in range(count):
        simulation.steps += 1
        now.seconds += seconds / count
        watcher.after_step(simulation)


@pytest.mark.parametrize("width", [40, 60, 76, 80, 100, 120, 200])
def test_the_time_left_stays_at_any_width(now, columns, watch, width):
    columns(width)
    simulation = Simulation()
    watcher = watch(simulation, Terminal())
    simulation.steps = 1
    watcher.after_step(simulation)
    steps(watcher, simulation, now, 499, 499 * 7.5)
    line = shown(watcher, width)
    assert len(line.rstrip()) <= width and "…" not in line
    assert "step 500" in line and " 50% " in line and "1:02:30 left" in line
    assert ("M particle-steps/s" in line) == (width >= 76)
    assert ("Ekin 1.23" in line) == (width >= 100)


def test_the_line_says_that_kernels_are_compiled_and_moves(now, columns, watch):
    columns(80)
    simulation = Simulation()
    watcher = watch(simulation, Terminal())
    assert "-:--:-- left" in shown(watcher, 80)
    watcher.compilation.on_start(None)
    seen = []
    for _ in range(3):
        now.seconds += 4
        seen.append(re.search(r"compiling, \d+ s", shown(watcher, 80))[0])
    assert seen == ["compiling, 4 s", "compiling, 8 s", "compiling, 12 s"]
    watcher.compilation.on_end(None)
    assert "compiling" not in shown(watcher, 80)


@pytest.mark.parametrize("stream", [Terminal, io.StringIO])
def test_the_first_estimate_leaves_compilation_out(now, columns, watch, stream):
    """A kernel that the second step needs takes a minute; steps take 1 s, and 998 are left."""
    columns(80)
    simulation, file = Simulation(), stream()
    watcher = watch(simulation, file)
    steps(watcher, simulation, now, 1, 1.0)
    watcher.compilation.on_start(None)
    now.seconds += 60
    watcher.compilation.on_end(None)
    steps(watcher, simulation, now, 1, 1.0)
    line = file.getvalue() if stream is io.StringIO else shown(watcher, 80)
    assert ("998 s left" if stream is io.StringIO else "0:16:38 left") in line
    assert "1.00 M particle-steps/s" in line


def test_a_bar_prints_lines_as_they_are(columns):
    columns(80)
    file = Terminal()
    bar = Bar(file, 1.0, Compilation(lambda: None))
    bar.print("note: a title with [/b] and [kg]")
    bar.stop()
    assert "note: a title with [/b] and [kg]" in file.getvalue()


@pytest.mark.parametrize(
    ("seconds", "text"),
    [(0.4, "0:00:00"), (59.6, "0:01:00"), (3_725, "1:02:05"), (4e5, "111:06:40")],
)
def test_clock(seconds, text):
    assert clock(seconds) == text
