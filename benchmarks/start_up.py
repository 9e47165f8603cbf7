"""Time from the command to the first step: first run ever, which compiles, and later runs.

python benchmarks/start_up.py [CASE] [--runs 5]
"""

import argparse
import json
import os
import re
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from statistics import median

from contest import Table

ROOT = Path(__file__).parents[1]
CASE = ROOT / "inputs" / "cantilever" / "case.json"

COMMAND = """
import sys, time
from mpmgeo.mpm import solver

step = solver.Solver.step

def first_step(self):
    step(self)
    solver.Solver.step = step
    print("first step", time.time(), file=sys.stderr)

solver.Solver.step = first_step
from mpmgeo.cli import main
sys.exit(main())
"""


def launch(case, output, cache):
    """Run a case; return the seconds to its first step and to its end, and what it said."""
    environment = os.environ | {"NUMBA_CACHE_DIR": str(cache), "PYTHONPATH": str(ROOT)}
    words = [sys.executable, "-c", COMMAND, str(case), "--output", str(output)]
    begin = time.time()
    done = subprocess.run(words, env=environment, capture_output=True, text=True, check=True)
    end = time.time()
    first = float(re.search(r"first step ([\d.]+)", done.stderr)[1])
    return first - begin, end - begin, done.stderr


def shortened(source, folder, steps):
    """Return a copy of a case that lasts some steps of 1 µs."""
    case = json.loads(source.read_text())
    case |= {"time_step": 1e-6, "time": steps * 1e-6}
    copy = folder / "case.json"
    copy.write_text(json.dumps(case))
    return copy


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("case", nargs="?", type=Path, default=CASE)
    parser.add_argument("--runs", type=int, default=5)
    arguments = parser.parse_args()
    table = Table("start_up")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        case = shortened(arguments.case, folder, steps=20)
        cache, output = folder / "cache", folder / "results"
        first, _, said = launch(case, output, cache)
        compilation = float(re.search(r"compilation ([\d.]+) s", said)[1])
        table.add("first run ever: to the first step", "s", first)
        table.add("first run ever: compilation", "s", compilation, bar="< 30")
        table.add("first run ever: says that it compiles", "", "compiling" in said, bar="1")
        later = [launch(case, output, cache) for _ in range(arguments.runs)]
    for what, column, bar in (("to the first step", 0, "< 1.5"), ("to the end of 20 steps", 1, "")):
        seconds = [run[column] for run in later]
        table.add(f"later runs: {what}", "s", median(seconds), min(seconds), max(seconds), bar)
    table.write()


if __name__ == "__main__":
    main()
