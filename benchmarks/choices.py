"""What a choice in the case costs: the time of a step with it, relative to the step without.

python benchmarks/choices.py [--particles 512000] [--rounds 7]
"""

import argparse

from contest import Contest, Table
from scenes import side_of, simulation, standing

PLAIN = "USL GIMP"
LOAD = {"point_p1": [0, 0, 0], "point_p2": [9, 9, 9], "load": [0, 0, -1e3]}
CHOICES = {
    "shape_function linear": {"shape_function": "linear"},
    "stress_scheme_update MUSL": {"stress_scheme_update": "MUSL"},
    "stress_scheme_update USF": {"stress_scheme_update": "USF"},
    "volumetric_locking cells": {"volumetric_locking": "cells"},
    "transfer flip 0.99": {"transfer": {"type": "flip", "flip": 0.99}},
    "transfer tpic": {"transfer": "tpic"},
    "transfer apic": {"transfer": "apic"},
    "damping local": {"damping": {"type": "local", "value": 0.1}},
    "damping kinetic": {"damping": {"type": "kinetic"}},
    "load_distributed_box": {"load_distributed_box": [LOAD]},
}


def mixed_sizes(side):
    """Return a standing block of two bodies with particles of two shapes, eight in a cell."""
    case = standing(side)
    (body,) = case["body"]
    middle = body["point_p1"][2] + side // 2 * 0.1
    lower = body | {"point_p2": [*body["point_p2"][:2], middle]}
    upper = body | {"point_p1": [*body["point_p1"][:2], middle]}
    return case | {"body": [lower, upper | {"particles_per_direction": [4, 2, 1]}]}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--particles", type=int, default=512_000)
    parser.add_argument("--rounds", type=int, default=7)
    arguments = parser.parse_args()
    side = side_of(arguments.particles)
    contest = Contest(8 * side**3)
    contest.add(PLAIN, simulation(standing(side)).solver.step, steps=10)
    for name, keys in CHOICES.items():
        contest.add(name, simulation(standing(side, **keys)).solver.step, steps=10)
    contest.add("particles of different sizes", simulation(mixed_sizes(side)).solver.step, steps=10)
    table = Table("choices")
    table.add("particles", "", contest.particles)
    contest.run(arguments.rounds)
    for name in [*CHOICES, "particles of different sizes"]:
        table.add(name, "times the step", *contest.ratio(PLAIN, name))
    table.write()


if __name__ == "__main__":
    main()
