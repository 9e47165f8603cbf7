"""Cost of probes: steps at whose end rows are taken against the steps between them, in turns.

python benchmarks/probe_cost.py [--particles 512000] [--threads 1] [--every 10]
"""

import argparse
import tempfile
import time
from pathlib import Path
from statistics import median

import numba
from contest import Table
from scenes import CELL, MARGIN, side_of, simulation, standing

from mpmgeo.output.histories import Histories, histories_of
from mpmgeo.run.outputs import EverySteps

FIELDS = ["displacement", "velocity", "stress"]


def probes(side, every):
    """Return a probe of each type, on and in a block of `side` cells along its edges."""
    low = MARGIN * CELL
    middle = low + side * CELL / 2
    points = [[middle, middle, (z + 0.5) * CELL] for z in range(0, side, max(1, side // 8))]
    box = {"point_p1": [low, low, 0.0], "point_p2": [middle, middle, 2 * CELL]}
    return {
        "line": {"type": "points", "points": points, "fields": FIELDS, "every": every},
        "tip": {
            "type": "points",
            "points": [[middle, middle, side * CELL]],
            "interpolation": "nearest",
            "fields": FIELDS,
            "every": every,
        },
        "few": {"type": "particles", "ids": [0, 17], "fields": FIELDS, "every": every},
        "foot": {"type": "box", "fields": ["stress", "mass"], "every": every} | box,
        "walls": {"type": "planes", "every": every},
    }


def share(case, every, rounds):
    """Return the particles and the cost of rows, in % of the steps: one share for each round.

    The step with the rows takes turns with the steps between rows of the same run. Processor time
    is counted, not time on the clock, which other programs on the machine would change.
    """
    block = simulation(case)
    shares = []
    with tempfile.TemporaryDirectory() as folder:
        histories = Histories(histories_of(block, Path(folder)), outputs=EverySteps(every))
        histories.begin(block)

        def seconds(steps):
            begin = time.process_time()
            for _ in range(steps):
                block.step()
                histories.after_step(block)
            return (time.process_time() - begin) / steps

        seconds(every)  # compiles
        for _ in range(rounds):
            plain = seconds(every - 1)
            shares.append(100 * (seconds(1) - plain) / (every * plain))
    return block.solver.count, shares


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--particles", type=int, default=512_000)
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--every", type=int, default=10)
    parser.add_argument("--rounds", type=int, default=9)
    arguments = parser.parse_args()
    every, threads = arguments.every, min(arguments.threads, numba.config.NUMBA_NUM_THREADS)
    side = side_of(arguments.particles)
    table = Table("probe_cost")
    wanted = probes(side, every)
    scenes = {"all": wanted} | {name: {name: probe} for name, probe in wanted.items()}
    for name, chosen in scenes.items():
        case = standing(side, n_threads=threads, results={"probes": chosen})
        count, shares = share(case, every, arguments.rounds)
        if name == "all":
            table.add("particles", "", count)
            table.add("threads", "", threads)
            table.add("steps between rows", "", every)
        bar = "<= 2" if name == "all" else None
        table.add(f"probes: {name}", "%", median(shares), min(shares), max(shares), bar=bar)
    table.write()


if __name__ == "__main__":
    main()
