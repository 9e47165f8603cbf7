"""Errors of shapes and schemes in the bar of Dyka and Ingel, in meshes that are refined.

python benchmarks/dyka_bar.py [cells …]

The errors of velocity and stress in the mean square at the end of the run, in 3D, one cell of
cross-section, are written to benchmarks/results/dyka_bar.csv.
"""

import csv
import sys
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
        simulation.run()
    except Unsound:
        return float("nan"), float("nan")
    return BAR.errors(simulation)


if __name__ == "__main__":
    warnings.simplefilter("ignore", mpmgeo.CaseWarning)
    rows = []
    for cells, scheme, shape in product(
        map(int, sys.argv[1:]) if sys.argv[1:] else CELLS, SCHEMES, SHAPES
    ):
        velocity, stress = measure(cells, scheme, shape)
        word = shape if isinstance(shape, str) else f"LME {shape:g}"
        rows.append((cells, scheme, word, f"{velocity:.4f}", f"{stress:.4g}"))
        print(*rows[-1], flush=True)
    with FILE.open("w", newline="", encoding="utf-8") as file:
        head = ("cells", "scheme", "shape", "velocity", "stress")
        csv.writer(file, lineterminator="\n").writerows([head, *rows])
