"""Share of writing files in a run of 1,000 steps with 10 outputs of displacement, velocity, stress.

python benchmarks/output_cost.py [--particles 512000] [--threads 1]
"""

import argparse
import tempfile
import time
from pathlib import Path
from statistics import median

import numba
from contest import Table
from scenes import side_of, simulation, standing

from mpmgeo.output.results import ResultFiles
from mpmgeo.run.outputs import EverySteps

STEPS, OUTPUTS = 1000, 10  # of the run in question
FIELDS = ["displacement", "velocity", "stress"]


def seconds_of(action):
    """Return the time that an action takes [s]."""
    begin = time.perf_counter()
    action()
    return time.perf_counter() - begin


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--particles", type=int, default=512_000)
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--rounds", type=int, default=5)
    arguments = parser.parse_args()
    table = Table("output_cost")
    case = standing(side_of(arguments.particles), results={"material_point_results": FIELDS})
    block = simulation(case)
    block.threads = min(arguments.threads, numba.config.NUMBA_NUM_THREADS)
    steps, outputs = [], []
    with tempfile.TemporaryDirectory() as folder:
        files = ResultFiles(Path(folder), block.case, EverySteps(1))
        block.step()
        first = seconds_of(lambda: files.begin(block))
        for _ in range(arguments.rounds):
            steps.append(seconds_of(lambda: block.step(10)) / 10)
            outputs.append(seconds_of(lambda: files.after_step(block)))
        written = sum(file.stat().st_size for file in Path(folder).rglob("*.*"))
    step, output = median(steps), median(outputs)
    table.add("particles", "", block.solver.count)
    table.add("threads", "", block.threads)
    table.add("a step", "ms", step * 1e3, min(steps) * 1e3, max(steps) * 1e3)
    table.add("the first output, with the grid", "ms", first * 1e3)
    table.add("an output", "ms", output * 1e3, min(outputs) * 1e3, max(outputs) * 1e3)
    table.add("size of an output", "MB", written / (arguments.rounds + 1) / 1e6)
    writing = first + OUTPUTS * output
    share = 100 * writing / (writing + STEPS * step)
    table.add("writing in 1,000 steps with 10 outputs", "%", share, bar="< 10")
    table.write()


if __name__ == "__main__":
    main()
