"""What solving one layer for all gains: speed of a slab one cell thick, relative to all layers.

python benchmarks/plane_strain.py [--particles 512000] [--rounds 7]

Particles are those of the case, two across. The slab of sand yields under its own weight.
"""

import argparse

from contest import Contest, Table
from laws import SETTLED, SOLID, WEAK
from scenes import CELL, simulation

LAWS = {"elastic": {"type": "elastic"}, "mohr-coulomb that yields": WEAK}
BAR = {"elastic": "4.5", "mohr-coulomb that yields": "2.5"}
MODES = {"plane": "auto", "space": "off"}
RATIO = 1.6  # length of the slab over its height


def slab(particles, material, mode):
    """Return the case of a slab that stands against a smooth wall, and is free on two sides."""
    height = max(1, round((particles / 8 / RATIO) ** 0.5))
    length = round(RATIO * height)
    body = {
        "type": "cuboid",
        "point_p1": [0.0, 0.0, 0.0],
        "point_p2": [length * CELL, CELL, height * CELL],
        "material_id": 1,
    }
    return {
        "time": 1.0,
        "time_step": 2e-4 * CELL / 0.1,
        "gravity": [0.0, 0.0, -9.81],
        "mesh": {"cells_number": [length + 8, 1, height + 4], "cells_dimension": 3 * [CELL]},
        "materials": [material],
        "body": [body],
        "plane_strain": mode,
    }


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--particles", type=int, default=512_000)
    parser.add_argument("--rounds", type=int, default=7)
    arguments = parser.parse_args()
    table, contest = Table("plane_strain"), None
    for law, keys in LAWS.items():
        for mode, word in MODES.items():
            case = slab(arguments.particles, SOLID | keys, word)
            run = simulation(case).step(SETTLED if law != "elastic" else 3)
            contest = contest or Contest(run.solver.count)
            contest.add(f"{law}, {mode}", run.solver.step, steps=3)
    table.add("particles", "", contest.particles)
    contest.run(arguments.rounds)
    for law in LAWS:
        for mode in MODES:
            table.add(f"{law}, {mode}", "M/s", *contest.speed(f"{law}, {mode}"))
        ratio = contest.ratio(f"{law}, plane", f"{law}, space")
        table.add(f"{law}: plane / space", "speed", *ratio, bar=BAR[law])
    table.write()


if __name__ == "__main__":
    main()
