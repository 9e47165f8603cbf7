"""Error against run time: problems with exact solutions, in shapes, schemes and refinements.

python benchmarks/work_precision.py [ring vortex …] [--cells 4 8 16] [--combos GIMP:USL …] [--draw]

A combination is a shape, a scheme and what else `Problem.simulation` takes, keys of the case too,
as `cubic-bspline:MUSL:particles=3:courant=0.1`. Every run has one thread; what counts is processor
time, without that of compiling the kernels. A run is on the Pareto front if no other one is both
faster and more accurate.
"""

import argparse
import csv
import json
import time
import warnings
from math import inf, isfinite
from pathlib import Path

from contest import RESULTS, machine

import mpmgeo
from mpmgeo.run.watch import Diverged
from mpmgeo.verify.problems import PROBLEMS

COMBOS = [
    "linear:MUSL",
    *(
        f"{shape}:{scheme}{transfer}"
        for shape in ("GIMP", "quadratic-bspline", "cubic-bspline", "LME")
        for scheme in ("USL", "MUSL")
        for transfer in ("", ":transfer=tpic")
    ),
    *("LME:NPC", "cubic-bspline:NPC", "cubic-bspline:NPC-CD"),
]
CELLS = {
    "axial_vibration": [8, 16, 32],
    "axis_aligned": [4, 8, 16],
    "vortex": [4, 8, 16],
    "ring": [4, 8, 16],
    "compaction": [10, 20, 40],
    "colliding_discs": [10, 20, 40],
    "dyka_bar": [20, 40, 134],
}
COLOURS = {
    "linear": "tab:gray",
    "GIMP": "tab:blue",
    "quadratic-bspline": "tab:orange",
    "cubic-bspline": "tab:red",
    "LME": "tab:green",
}
MARKERS = {"USL": "o", "MUSL": "s", "USF": "D", "NPC": "^", "NPC-CD": "v"}
PICTURES = Path(__file__).parents[1] / "manual" / "pictures"
COLUMNS = ("problem", "combination", "cells", "particles", "steps", "seconds", "error", "front")


def choices(combo):
    """Return what a combination says as arguments of `Problem.simulation`."""
    shape, scheme, *others = combo.split(":")
    return {"shape": shape, "scheme": scheme} | dict(map(_pair, others))


def _pair(text):
    key, _, value = text.partition("=")
    try:
        return key, json.loads(value)
    except json.JSONDecodeError:
        return key, value


def measure(problem, cells, combo):
    """Return particles, steps, processor seconds and error of a run, infinite if it diverges."""
    simulation = problem.simulation(cells, n_threads=1, **choices(combo))
    start = time.process_time()
    try:
        simulation.run()
        error = problem.error(simulation)
    except Diverged:
        error = inf
    return simulation.solver.count, simulation.steps, time.process_time() - start, error


def front(runs):
    """Return which of the runs, pairs of seconds and error, are on the Pareto front."""
    return [
        isfinite(error) and not any(s < seconds and e < error for s, e in runs)
        for seconds, error in runs
    ]


def race(name, refinements, combos):
    """Return a row of COLUMNS for every run of a problem; prints them as they come."""
    problem, rows = PROBLEMS[name](), []
    for combo in combos:
        problem.simulation(min(refinements), n_threads=1, **choices(combo)).step(2)
        for cells in refinements:
            rows.append((name, combo, cells, *measure(problem, cells, combo)))
            *_, seconds, error = rows[-1]
            print(f"{name:16} {combo:32} {cells:4} {seconds:9.2f} s {error:10.3e}", flush=True)
    return [
        (*row, int(best)) for row, best in zip(rows, front([r[-2:] for r in rows]), strict=True)
    ]


def style(combo):
    """Return how the line of a combination looks: colour of the shape, marker of the scheme."""
    shape, scheme, *others = combo.split(":")
    return {
        "color": COLOURS.get(shape, "black"),
        "marker": MARKERS.get(scheme, "x"),
        "linestyle": "--" if "transfer=tpic" in others else "-",
    }


def draw(name, rows):
    """Draw error against seconds, a line for every combination, and the Pareto front."""
    import matplotlib

    matplotlib.use("agg")
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots(figsize=(9, 5), layout="constrained")
    for combo in dict.fromkeys(row[1] for row in rows):
        line = [row[5:7] for row in rows if row[1] == combo and isfinite(row[6])]
        if line:
            label = combo.replace(":transfer=", ", ").replace(":", ", ")
            looks = {"markersize": 4, "linewidth": 1, "label": label} | style(combo)
            axes.plot(*zip(*line, strict=True), **looks)
    best = sorted(row[5:7] for row in rows if row[7])
    if best:
        axes.plot(*zip(*best, strict=True), "ko", markersize=10, fillstyle="none", label="front")
    axes.set(xscale="log", yscale="log", xlabel="processor time [s]", ylabel="error", title=name)
    axes.grid(True, which="both", linewidth=0.3)
    figure.legend(fontsize=7, loc="outside right upper")
    path = PICTURES / f"work_precision_{name}.png"
    figure.savefig(path, dpi=90)
    plt.close(figure)
    print(f"drawn in {path}")


def path_of(name):
    """Return where the rows of a problem are written."""
    return RESULTS / f"work_precision_{name}.csv"


def read(name):
    """Return the rows of a problem as they were written."""
    with path_of(name).open(encoding="utf-8") as file:
        _, _, *rows = csv.reader(file)
    return [(*row[:5], float(row[5]), float(row[6]), int(row[7])) for row in rows]


def write(name, rows):
    """Write the rows of a problem as csv."""
    path = path_of(name)
    with path.open("w", newline="", encoding="utf-8") as file:
        file.write(f"# {machine()}\n")
        lines = csv.writer(file, lineterminator="\n")
        lines.writerow(COLUMNS)
        lines.writerows((*row[:5], f"{row[5]:.3f}", f"{row[6]:.4e}", row[7]) for row in rows)
    print(f"written to {path}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("problems", nargs="*", help=f"of {', '.join(PROBLEMS)}; without: all")
    parser.add_argument("--draw", action="store_true", help="draw what has been measured before")
    parser.add_argument("--cells", type=int, nargs="+")
    parser.add_argument("--combos", nargs="+", default=COMBOS, metavar="SHAPE:SCHEME[:KEY=VALUE]")
    arguments = parser.parse_args()
    unknown = set(arguments.problems) - set(PROBLEMS)
    if unknown:
        parser.error(f"there is no problem {min(unknown)}; there are {', '.join(PROBLEMS)}")
    for name in arguments.problems or PROBLEMS:
        if arguments.draw:
            draw(name, read(name))
            continue
        rows = race(name, arguments.cells or CELLS[name], arguments.combos)
        RESULTS.mkdir(exist_ok=True)
        write(name, rows)
        draw(name, rows)


if __name__ == "__main__":
    warnings.simplefilter("ignore", mpmgeo.CaseWarning)
    main()
