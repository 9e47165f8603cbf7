"""How long a time step is stable, and how near to that the limit is which the program states.

python benchmarks/stability.py [one_phase] [two_phases]

For schemes, shapes, particles a cell, Poisson's ratios and cells: the limit that `Simulation`
states and the one that bisection finds, the worst of some places of the block on the grid, as
shares of the critical time step h/c. With two phases also for several conductivities. The figures
are written to benchmarks/results/stability_….csv; `mpmgeo/verify/stability.py` says what counts as
stable.
"""

import csv
import sys
import warnings
from itertools import product
from pathlib import Path

import mpmgeo
from mpmgeo.verify.stability import OFFSETS, Trial, bisected, block

RESULTS = Path(__file__).parent / "results"
METHODS = (
    ("USL", "GIMP"),
    ("MUSL", "GIMP"),
    ("USF", "GIMP"),
    ("MUSL", "linear"),
    ("USF", "linear"),
)
COUNTS = (1, 2, 3, 4)  # along an edge of a cell
RATIOS = (0.0, 0.3, 0.49)
CELLS = ((1, 1, 1), (1, 1, 5))
EXTREMES = (0.0, 0.49)
CONDUCTIVITIES = (1e-6, 1e-3, 1.0)  # m/s
DEFAULT = 0.25  # share of the critical time step that is taken if a case says none
COLUMNS = ("scheme", "shape", "cells", "particles", "poisson", "conductivity")
COLUMNS = (*COLUMNS, "limit", "bisected", "ratio")


def measure(method, edges, count, poisson, conductivity):
    """Return limit and bisected limit."""
    keys = dict(zip(("stress_scheme_update", "shape_function"), method, strict=True))
    cases = (block(count, poisson, edges, o, conductivity, **keys) for o in OFFSETS)
    trials = [Trial(case) for case in cases]
    return trials[0].limit, bisected(trials, 0.95 * trials[0].limit)


def grid(name):
    """Return what is measured: methods, cells, particles, Poisson's ratios, conductivities."""
    if name == "one_phase":
        return product(METHODS, CELLS, COUNTS, RATIOS, (None,))
    methods = [method for method in METHODS if method[0] != "USF"]
    return product(methods, CELLS, COUNTS, EXTREMES, CONDUCTIVITIES)


def tabulate(name):
    """Measure a grid, print and write it."""
    rows = []
    for method, edges, count, poisson, conductivity in grid(name):
        limit, found = measure(method, edges, count, poisson, conductivity)
        cells, ratio = ":".join(map(str, edges)), limit / found if found else float("inf")
        wet = "" if conductivity is None else f"{conductivity:g}"
        numbers = (f"{limit:.3f}", f"{found:.3f}", f"{ratio:.2f}")
        rows.append((*method, cells, count**3, poisson, wet, *numbers))
        print(*rows[-1], flush=True)
    path = RESULTS / f"stability_{name}.csv"
    with path.open("w", newline="", encoding="utf-8") as file:
        csv.writer(file, lineterminator="\n").writerows([COLUMNS, *rows])
    ratios = [float(row[-1]) for row in rows]
    smallest = min(float(row[6]) for row in rows)
    print(f"limit / bisected from {min(ratios):.2f} to {max(ratios):.2f}, wanted 0.6 to 1.05")
    print(f"smallest limit {smallest:.3f}, wanted above {DEFAULT}")


if __name__ == "__main__":
    warnings.simplefilter("ignore", mpmgeo.CaseWarning)
    for name in sys.argv[1:] or ("one_phase", "two_phases"):
        tabulate(name)
