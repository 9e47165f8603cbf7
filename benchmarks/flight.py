"""What is left of the vibration of a cube in flight, for all transfers, schemes, shapes and speeds.

python benchmarks/flight.py [--particles 1 2] [--steps 2000]
"""

import argparse
import csv
import itertools
import warnings

import numpy as np
from contest import RESULTS, machine

from mpmgeo.mpm.schemes import SCHEMES
from mpmgeo.run.watch import Diverged
from mpmgeo.shapes import SHAPES
from mpmgeo.verify.flight import Flight, case

TRANSFERS = {
    "flip": "flip",
    "flip 0.99": {"type": "flip", "flip": 0.99},
    "apic": "apic",
    "tpic": "tpic",
}
SMOOTH = [shape for shape in SHAPES if shape != "linear"]
SHARES = (0.5, 0.25)  # of the time in which a wave crosses a cell
SPEEDS = (0.001, 0.01, 0.1, 0.3)  # in wave speeds
HEAD = ("particles along a cell", "transfer", "scheme", "shape", "time step", "speed")
FOUND = ("largest energy", "energy after an eighth", "energy at the end")


def fly(n, transfer, scheme, shape, share, speed, steps):
    """Return the largest energy of a flight, that after an eighth of it and the mean of its end."""
    keys = {
        "transfer": TRANSFERS[transfer],
        "stress_scheme_update": scheme,
        "shape_function": shape,
    }
    try:
        energy = Flight(case(speed, n, share, steps, **keys)).energies(steps)
    except Diverged:
        return 3 * [np.inf]
    return energy.max(), energy[len(energy) // 8], energy[-20:].mean()


def goes_together(transfer, scheme):
    """Tell whether a scheme takes a transfer: those of Newmark take FLIP alone."""
    return transfer == "flip" or not scheme.startswith("NPC")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--particles", type=int, nargs="+", default=[1, 2])
    parser.add_argument("--steps", type=int, default=2000)
    arguments = parser.parse_args()
    warnings.simplefilter("ignore")  # of steps that are too long for a scheme
    choices = arguments.particles, TRANSFERS, SCHEMES, SMOOTH, SHARES, SPEEDS
    with (RESULTS / "flight.csv").open("w", newline="", encoding="utf-8") as file:
        file.write(f"# {machine()}\n")
        rows = csv.writer(file, lineterminator="\n")
        rows.writerow([*HEAD, *FOUND])
        for choice in itertools.product(*choices):
            if not goes_together(*choice[1:3]):
                continue
            found = fly(*choice, arguments.steps)
            rows.writerow([*choice, *(f"{x:.3g}" for x in found)])
            print(*choice, *(f"{x:.3g}" for x in found), flush=True)


if __name__ == "__main__":
    main()
