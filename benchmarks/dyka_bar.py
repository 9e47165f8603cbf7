"""Errors of shapes and schemes in the bar of Dyka and Ingel, in meshes that are refined.

python benchmarks/dyka_bar.py [--missing] [cells …]

The errors of velocity and stress in the mean square at the end of the run, in 3D, one cell of
cross-section, take their places in benchmarks/results/dyka_bar.csv; with --missing those that
it lacks.
"""

import argparse
import csv
import warnings
from itertools import product
from pathlib import Path

import mpmgeo
from mpmgeo.mpm.incidents import Unsound
from mpmgeo.verify.dyka_bar import DykaBar

FILE = Path(__file__).parent / "results" / "dyka_bar.csv"
CELLS = (14, 20, 40, 134, 266, 400)
SCHEMES = ("USF", "USL", "MUSL", "NPC", "NPC-CD")
SHAPES = ("linear", "GIMP", "quadratic-bspline", "cubic-bspline", 0.8, 1.8, 3.0, 4.0)
"""Words, or γ of LME."""

BAR = DykaBar()


def measure(cells, scheme, shape):
    """Return both errors [m/s, Pa]."""
    keys = {} if isinstance(shape, str) else {"lme": {"gamma": shape}}
    case = BAR.case(cells, scheme, shape if isinstance(shape, str) else "LME", **keys)
    simulation = mpmgeo.Simulation(case)
    try:
        simulation.step(round(BAR.time / simulation.time_step))  # a step more would move the jumps
    except Unsound:
        return float("nan"), float("nan")
    return BAR.errors(simulation)


def known():
    """Return the rows that have been written before, by cells, scheme and shape."""
    if not FILE.exists():
        return {}
    with FILE.open(encoding="utf-8") as file:
        _, *rows = csv.reader(file)
    return {(int(row[0]), *row[1:3]): row[3:] for row in rows}


def write(rows):
    """Write the rows in order of cells, schemes and shapes."""
    words = [word_of(shape) for shape in SHAPES]
    place = {key: (key[0], SCHEMES.index(key[1]), words.index(key[2])) for key in rows}
    with FILE.open("w", newline="", encoding="utf-8") as file:
        lines = csv.writer(file, lineterminator="\n")
        lines.writerow(("cells", "scheme", "shape", "velocity", "stress"))
        lines.writerows((*key, *rows[key]) for key in sorted(rows, key=place.get))


def word_of(shape):
    """Return how a shape is called in the table."""
    return shape if isinstance(shape, str) else f"LME {shape:g}"


if __name__ == "__main__":
    warnings.simplefilter("ignore", mpmgeo.CaseWarning)
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("cells", type=int, nargs="*", default=CELLS)
    parser.add_argument("--missing", action="store_true")
    arguments = parser.parse_args()
    skipped = known() if arguments.missing else {}
    for cells, scheme, shape in product(arguments.cells, SCHEMES, SHAPES):
        if (cells, scheme, word_of(shape)) in skipped:
            continue
        velocity, stress = measure(cells, scheme, shape)
        key = cells, scheme, word_of(shape)
        print(*key, f"{velocity:.4f}", f"{stress:.4g}", flush=True)
        write(known() | {key: (f"{velocity:.4f}", f"{stress:.4g}")})
