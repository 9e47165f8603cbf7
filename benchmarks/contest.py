"""Fair timing on a noisy machine: contestants take turns, and ratios are taken within a round."""

import csv
import os
import platform
import time
from pathlib import Path
from statistics import median

import llvmlite.binding
import numba
import numpy as np

RESULTS = Path(__file__).parent / "results"


class Contest:
    """Steppers of the same number of particles, timed in turn."""

    def __init__(self, particles):
        self.particles = particles
        self.entries = {}
        self.seconds = {}  # name → seconds of one step, a value for each round

    def add(self, name, step, threads=1, steps=20):
        """Enter `step()`, of which a round does `steps` on some threads."""
        self.entries[name] = step, min(threads, numba.config.NUMBA_NUM_THREADS), steps
        self.seconds[name] = []

    def run(self, rounds):
        """Step everybody once to compile and to touch memory, then time the rounds."""
        for step, threads, _ in self.entries.values():
            numba.set_num_threads(threads)
            step()
        for _ in range(rounds):
            for name, (step, threads, steps) in self.entries.items():
                numba.set_num_threads(threads)
                begin = time.perf_counter()
                for _ in range(steps):
                    step()
                self.seconds[name].append((time.perf_counter() - begin) / steps)

    def speed(self, name):
        """Return million particle-steps per second: median, least, most."""
        speeds = [self.particles / s / 1e6 for s in self.seconds[name]]
        return median(speeds), min(speeds), max(speeds)

    def ratio(self, name, other):
        """Return the speed of one entry in that of another: median over rounds, least, most."""
        pairs = zip(self.seconds[name], self.seconds[other], strict=True)
        ratios = [theirs / ours for ours, theirs in pairs]
        return median(ratios), min(ratios), max(ratios)


class Table:
    """Rows of a measurement: printed as they come, kept as csv in `benchmarks/results`."""

    def __init__(self, name):
        self.path = RESULTS / f"{name}.csv"
        self.rows = []
        print(machine(), flush=True)

    def add(self, what, unit, value, low=None, high=None, bar=None):
        """Add a figure with its spread, and the bar it should reach as text."""
        self.rows.append([what, *(_short(x) for x in (value, low, high)), unit, bar or ""])
        spread = "" if low is None else f"  ({_short(low)} … {_short(high)})"
        wanted = f"  [wanted: {bar}]" if bar else ""
        print(f"{what:52} {_short(value):>9} {unit}{spread}{wanted}", flush=True)

    def write(self):
        """Write the csv file."""
        self.path.parent.mkdir(exist_ok=True)
        with self.path.open("w", newline="", encoding="utf-8") as file:
            file.write(f"# {machine()}\n")
            rows = csv.writer(file, lineterminator="\n")
            rows.writerow(["what", "value", "low", "high", "unit", "wanted"])
            rows.writerows(self.rows)
        print(f"written to {self.path}")


def _short(x):
    return "" if x is None else f"{x:.4g}"


def machine():
    """Return processor, cores, vector instructions, versions and load in one line."""
    features = llvmlite.binding.get_host_cpu_features()
    vectors = [name for name in ("avx2", "avx512f", "neon", "sve") if features.get(name)]
    load = f", load {os.getloadavg()[0]:.1f}" if hasattr(os, "getloadavg") else ""
    return (
        f"{_processor()}, {os.cpu_count()} cores, {' '.join(vectors)}, Python "
        f"{platform.python_version()}, numba {numba.__version__}, numpy {np.__version__}{load}"
    )


def _processor():
    """Return the name that the system gives its processor, and LLVM's name for its kind."""
    kind = llvmlite.binding.get_host_cpu_name()
    try:
        lines = Path("/proc/cpuinfo").read_text().splitlines()
    except OSError:
        return f"{platform.processor() or platform.machine()} ({kind})"
    names = [line.split(":")[1].strip() for line in lines if line.startswith("model name")]
    return f"{names[0] if names else platform.machine()} ({kind})"
