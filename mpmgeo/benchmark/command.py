"""The command `mpmgeo benchmark`: time the kernels, report as MPM-Geomechanics does and more."""

import argparse
import sys
from statistics import median
from time import perf_counter
from typing import NamedTuple

WRONG = 1e-9
"""Largest error of a kernel, relative to the largest value."""

MARKS = {"first cell": "PERF", "spread out": "SPREAD"}
"""What the line of a kernel begins with, by the placement of the particles."""

COMPILING = "compiling the kernels (once; later runs start at once)"

HEADER = "particles,threads,placement,kernel,median_ms,fastest_ms,slowest_ms,ns_per_particle"


class Timing(NamedTuple):
    """Times of the runs of a kernel [s], and the largest relative error of its result."""

    particles: int
    threads: int
    placement: str
    kernel: str
    seconds: list[float]
    error: float

    @property
    def milliseconds(self) -> tuple[float, float, float]:
        """Return median, fastest and slowest run [ms]."""
        return tuple(1e3 * f(self.seconds) for f in (median, min, max))

    @property
    def row(self) -> str:
        """Return the numbers as a row of the csv file."""
        middle = self.milliseconds[0]
        numbers = [f"{t:.6g}" for t in (*self.milliseconds, 1e6 * middle / self.particles)]
        what = (self.particles, self.threads, self.placement, self.kernel)
        return ",".join([*map(str, what), *numbers])


def parse(argv):
    """Return the options of the command; raises SystemExit for wrong ones."""
    parser = argparse.ArgumentParser(
        prog="mpmgeo benchmark",
        description="Time the nine kernels that MPM-Geomechanics times, with its configuration.",
        epilog="Exit codes: 0 done, 2 bad input, 3 a kernel's result is wrong, 130 interrupted.",
    )
    parser.add_argument(
        "config",
        nargs="?",
        help="configuration; with `parameters` every pair of particles and threads is run "
        "[benchmark-configuration.json if there is one, else built-in values]",
    )
    parser.add_argument("--repeats", type=int, default=10, help="timed runs of a kernel [10]")
    parser.add_argument("--csv", metavar="FILE", help="write all numbers to this file, too")
    parser.add_argument("--log", action="store_true", help="tell which keys are absent")
    arguments = parser.parse_args(argv)
    if arguments.repeats < 1:
        parser.error("--repeats needs a whole number above 0")
    return arguments


def serve(arguments) -> int:
    """Run the benchmark and return the exit code; OSError for files that cannot be used."""
    from mpmgeo.benchmark.configuration import read_configurations
    from mpmgeo.numerics.jit import remarks
    from mpmgeo.run.progress import Compilation

    try:
        reading = read_configurations(arguments.config)
    except ValueError as error:
        _say("error", error)
        return 2
    for remark in (*reading.remarks, *(reading.absences if arguments.log else ())):
        _say("note", remark)
    timings = []
    with Compilation(lambda: _say("note", COMPILING)):
        for configuration in reading.configurations:
            found = [*_run(configuration, arguments.repeats)]
            _print_table(found)
            timings += found
    for remark in remarks():
        _say("note", remark)
    if arguments.csv:
        _write(arguments.csv, timings)
    wrong = [t for t in timings if not t.error < WRONG]
    for timing in wrong:
        _say("error", f"{timing.kernel}, {timing.placement}: wrong by {timing.error:.2g}")
    return 3 if wrong else 0


def _run(configuration, repeats):
    """Yield the timings of all kernels, printing a line for each."""
    import numba

    from mpmgeo.benchmark.kernels import KERNELS
    from mpmgeo.benchmark.scene import PLACEMENTS, Scene

    most = numba.config.NUMBA_NUM_THREADS
    threads = min(configuration.threads, most)
    if threads < configuration.threads:
        _say("note", f"{configuration.threads} threads asked for, {most} available")
    numba.set_num_threads(threads)
    both = configuration.update == configuration.interpolation
    suites = {"update": configuration.update or both}
    suites["interpolation"] = configuration.interpolation or both
    print(f"{configuration.particles} particles, {threads} thread(s), {repeats} runs each")
    for placement in PLACEMENTS:
        scene = Scene(configuration, placement)
        for kernel in KERNELS:
            if suites[kernel.suite]:
                seconds, error = _time(kernel(scene), repeats)
                count = configuration.particles
                timing = Timing(count, threads, placement, kernel.name, seconds, error)
                print(f"[ {MARKS[placement]} ] {kernel.name} took {timing.milliseconds[0]:.6g} ms")
                sys.stdout.flush()
                yield timing


def _time(kernel, repeats):
    """Return the times of some runs after a first one, which may compile, and the last error."""
    seconds = []
    for _ in range(repeats + 1):
        if hasattr(kernel, "prepare"):
            kernel.prepare()
        start = perf_counter()
        kernel.run()
        seconds.append(perf_counter() - start)
    return seconds[1:], float(kernel.error())


def _print_table(timings):
    times = "".join(f"{word:>10}" for word in ("median", "fastest", "slowest"))
    print(f"\n{'kernel':28}{'placement':13}{times}  ns/particle")
    for timing in timings:
        numbers = "".join(f"{t:10.3f}" for t in timing.milliseconds)
        each = 1e6 * timing.milliseconds[0] / timing.particles
        print(f"{timing.kernel:28}{timing.placement:13}{numbers}{each:13.2f}")
    print("times in ms\n")


def _write(path, timings):
    from mpmgeo.output.whole_file import whole_file

    with whole_file(path) as file:
        file.write("".join(f"{line}\n" for line in [HEADER, *(t.row for t in timings)]).encode())


def _say(kind, text):
    print(f"{kind}: {text}", file=sys.stderr, flush=True)
