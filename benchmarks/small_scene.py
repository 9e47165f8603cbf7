"""Time of a step of a small scene: a column of 720 particles on a moving base.

python benchmarks/small_scene.py [--steps 20000]
"""

import argparse
import tempfile
import time
from math import pi, sin
from pathlib import Path
from statistics import median

from contest import Table
from scenes import simulation

PIECES = 20  # parts of the run that are timed, for a median and a spread
TIME_STEP = 1e-4  # s


def write_record(path, duration):
    """Write a base acceleration of 2 m/s² at 5 Hz along x, sampled at 200 Hz."""
    rows = [f"{n / 200},{2 * sin(10 * pi * n / 200)},0,0" for n in range(int(duration * 200) + 2)]
    path.write_text("\n".join(["time,ax,ay,az", *rows]) + "\n")


def column(record, duration):
    """Return the case: 0.3 × 0.3 × 1 m in cells of 0.1 m, its sides free."""
    sides = {f"plane_{side}": "free" for side in ("X0", "Y0", "Xn", "Yn", "Zn")}
    body = {"type": "cuboid", "point_p1": [0.6, 0.6, 0.0], "point_p2": [0.9, 0.9, 1.0]}
    return {
        "time": duration,
        "time_step": TIME_STEP,
        "gravity": [0.0, 0.0, -9.81],
        "mesh": {
            "cells_number": [15, 15, 12],
            "cells_dimension": [0.1, 0.1, 0.1],
            "boundary_conditions": sides,
        },
        "materials": [{"type": "elastic", "id": 1, "density": 2000, "young": 2e7, "poisson": 0.3}],
        "body": [body | {"material_id": 1}],
        "earthquake": {"active": True, "file": str(record), "header": True},
    }


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--steps", type=int, default=20_000)
    steps = parser.parse_args().steps
    table = Table("small_scene")
    with tempfile.TemporaryDirectory() as folder:
        record = Path(folder) / "record.csv"
        write_record(record, steps * TIME_STEP)
        run = simulation(column(record, (steps + 200) * TIME_STEP))
    run.run(until=100 * TIME_STEP)  # past the first check of the guard, which compiles
    table.add("particles", "", run.solver.count)
    seconds = []
    run.solver.clock.seconds.clear()
    for _ in range(PIECES):
        before, begin = run.steps, time.perf_counter()
        run.run(until=run.time + steps / PIECES * TIME_STEP)
        seconds.append((time.perf_counter() - begin) / (run.steps - before) * 1e6)
    table.add("a step", "µs", median(seconds), min(seconds), max(seconds), bar="< 100")
    for stage, total in run.solver.clock.seconds.items():
        table.add(f"  of which {stage}, on average", "µs", total / steps * 1e6)
    table.write()


if __name__ == "__main__":
    main()
