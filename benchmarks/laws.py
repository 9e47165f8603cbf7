"""What material laws cost: speed, and the time of a step relative to that of the elastic solid.

python benchmarks/laws.py [--particles 512000] [--rounds 7]

The block stands between smooth walls and yields under its own weight, nearly everywhere and in
every step, except where the law is said to stay elastic.
"""

import argparse

from contest import Contest, Table
from scenes import CELL, side_of, simulation

ELASTIC = "elastic"
SOLID = {"id": 1, "density": 2000.0, "young": 1e7, "poisson": 0.3}
WEAK = {"type": "mohr-coulomb", "friction": 5.0, "cohesion": 0.0}
SOFT = {
    "softening": "exponential",
    "softening.exponential.eta": 5.0,
    "softening.friction.active": True,
    "softening.friction.residual": 3.0,
}
LAWS = {
    ELASTIC: {"type": "elastic"},
    "elastic, jaumann": {"type": "elastic", "objective_rate": "jaumann"},
    "elastic, hughes-winget": {"type": "elastic", "objective_rate": "hughes-winget"},
    "neo-hookean": {"type": "neo-hookean"},
    "mohr-coulomb that yields": WEAK,
    "mohr-coulomb that yields, softening": WEAK | SOFT,
    "mohr-coulomb that yields, su_vertical_stress": WEAK | {"su_vertical_stress": 0.1},
    "mohr-coulomb that stays elastic": WEAK | {"cohesion": 1e9},
}
WATER = {"type": "newtonian", "id": 1, "density": 2000.0, "viscosity": 1.0, "bulk": 1e7}
BAR = {"mohr-coulomb that yields": "3 million particle-steps per second on a quiet machine"}
SETTLED = 100  # steps after which nearly every particle yields


def block(side, material):
    """Return the case of a cube of `side` cells between smooth walls."""
    return {
        "time": 1.0,
        "time_step": 2e-4 * CELL / 0.1,
        "gravity": [0.0, 0.0, -9.81],
        "mesh": {"cells_number": [side, side, side + 4], "cells_dimension": 3 * [CELL]},
        "materials": [material],
        "plane_strain": "off",
        "body": [
            {
                "type": "cuboid",
                "point_p1": [0.0, 0.0, 0.0],
                "point_p2": 3 * [side * CELL],
                "material_id": 1,
            }
        ],
    }


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--particles", type=int, default=512_000)
    parser.add_argument("--rounds", type=int, default=7)
    arguments = parser.parse_args()
    side = side_of(arguments.particles)
    contest = Contest(8 * side**3)
    materials = {name: SOLID | law for name, law in LAWS.items()} | {"newtonian": WATER}
    simulations = {}
    for name, material in materials.items():
        simulations[name] = simulation(block(side, material)).step(SETTLED)
        contest.add(name, simulations[name].solver.step, steps=5)
    table = Table("laws")
    table.add("particles", "", contest.particles)
    contest.run(arguments.rounds)
    for name in materials:
        table.add(name, "M/s, one thread", *contest.speed(name), bar=BAR.get(name))
    for name in list(materials)[1:]:
        table.add(f"{name} / {ELASTIC}", "speed", *contest.ratio(name, ELASTIC))
    for name, material in materials.items():
        if material["type"] == "mohr-coulomb":
            share = yielding(simulations[name])
            table.add(f"{name}: yielding in a step", "of the particles", share)
    table.write()


def yielding(simulation):
    """Return the share of the particles whose plastic strain grows in a step."""
    before = simulation.field("plastic_strain")
    return float((simulation.step().field("plastic_strain") > before).mean())


if __name__ == "__main__":
    main()
