"""Particle-steps per second and memory: schemes and shapes, at rest, moving, in a huge mesh.

python benchmarks/throughput.py [--particles 512000] [--rounds 7] [--yardstick FOLDER]
"""

import argparse
import multiprocessing
import tracemalloc

from contest import Contest, Table
from peer import Peer
from scenes import (
    SPEED,
    floating,
    lost_in_space,
    restless,
    saturated,
    side_of,
    simulation,
    standing,
)

from mpmgeo.run.outputs import EverySteps
from mpmgeo.run.progress import peak_memory
from mpmgeo.run.watch import Guard
from mpmgeo.verify.plain import PlainSolver

KINDS = {
    "USL GIMP": {},
    "USL linear": {"shape_function": "linear"},
    "MUSL GIMP": {"stress_scheme_update": "MUSL"},
    "USF GIMP": {"stress_scheme_update": "USF"},
}
TWO = "USL GIMP, 2 threads"
TWIN, PEER, PEER_TWO = "plain twin, USL GIMP", "yardstick", "yardstick, 2 threads"
WANTED = {"USL GIMP": "≥ 0.85", "USL linear": "≥ 1.2", "MUSL GIMP": "≥ 0.5"}


def compare_schemes(table, side, rounds, folder):
    """Time the schemes, the plain twin and perhaps a peer on a standing block."""
    contest = Contest(8 * side**3)
    for name, keys in KINDS.items():
        solver = simulation(standing(side, **keys)).solver
        contest.add(name, solver.step)
        if name == "USL GIMP":
            contest.add(TWO, solver.step, threads=2)
            contest.add(TWIN, PlainSolver(solver).step, steps=5)
    if folder:
        peer = Peer(folder, side)
        contest.add(PEER, peer.step)
        contest.add(PEER_TWO, peer.step, threads=2)
    contest.run(rounds)
    for name in contest.entries:
        table.add(name, "million particle-steps/s", *contest.speed(name))
    table.add(f"USL GIMP / {TWIN}", "", *contest.ratio("USL GIMP", TWIN), bar="≥ 2.8")
    table.add("USL GIMP, 2 threads / 1 thread", "", *contest.ratio(TWO, "USL GIMP"))
    if folder:
        compare_with_peer(table, contest)


def compare_with_peer(table, contest):
    """Add all ratios to the peer."""
    for name in KINDS:
        table.add(f"{name} / {PEER}", "", *contest.ratio(name, PEER), bar=WANTED.get(name))
    gain = contest.ratio(PEER_TWO, PEER)
    table.add("yardstick, 2 threads / 1 thread", "", *gain)
    ours = contest.ratio(TWO, "USL GIMP")
    table.add("gain of 2 threads / the yardstick's", "", ours[0] / gain[0], bar="≥ 0.95")


def compare_phases(table, side, rounds):
    """Time two phases beside one."""
    contest = Contest(8 * side**3)
    contest.add("one phase", simulation(standing(side)).solver.step)
    for name, keys in {
        "two phases": {},
        "two phases, MUSL": {"stress_scheme_update": "MUSL"},
        "two phases, pressures not shared": {"pore_pressure_smoothing": False},
    }.items():
        contest.add(name, simulation(saturated(side, **keys)).solver.step)
    contest.run(rounds)
    table.add("two phases", "million particle-steps/s", *contest.speed("two phases"), bar="≥ 3")
    for name in list(contest.entries)[1:]:
        table.add(f"{name} / one phase", "", *contest.ratio(name, "one phase"))


def compare_motions(table, side, rounds):
    """Time a floating block at rest, moving, with restless particles, in a huge mesh."""
    contest = Contest(8 * side**3)
    contest.add("at rest", simulation(floating(side)).solver.step)
    contest.add("moving", simulation(floating(side, velocity=[SPEED, 0.0, 0.0])).solver.step)
    contest.add("restless", restless(side).solver.step)
    contest.add("lost in space", simulation(lost_in_space(side)).solver.step)
    contest.run(rounds)
    table.add("floating block at rest", "million particle-steps/s", *contest.speed("at rest"))
    for name, what, bar in (
        ("moving", "one cell in 20 steps / at rest", "≥ 0.7"),
        ("restless", "random velocities of that size / at rest", "≥ 0.6"),
        ("lost in space", "in 1000 × 1000 × 400 cells / at rest", "1"),
    ):
        table.add(what, "", *contest.ratio(name, "at rest"), bar=bar)


def weigh(table, side):
    """Add bytes per particle and per node of touched blocks, and the memory of a huge mesh."""
    tracemalloc.start()
    begin, _ = tracemalloc.get_traced_memory()
    block = simulation(standing(side))
    guard = Guard(EverySteps(10))
    guard.begin(block)
    tracemalloc.reset_peak()
    block.step()
    now, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    count, grid = block.solver.count, block.solver.grid
    held = now - begin - grid.nbytes()
    table.add("held per particle, with the guard's copy", "bytes", held / count, bar="≤ 400")
    table.add("more of it while sorting all", "bytes", (peak - now) / count)
    nodes = 64 * len(grid.active)
    bound = 64 + 64 * grid.record / 8 / 64
    table.add("per node of touched blocks", "bytes", grid.nbytes() / nodes, bar=f"≤ {bound:.0f}")
    with multiprocessing.get_context("spawn").Pool(1) as pool:
        huge = pool.apply(peak_of_a_huge_mesh, (side,))
    table.add("process with 1000 × 1000 × 400 cells", "MiB", huge / 2**20, bar="< 1024")


def peak_of_a_huge_mesh(side):
    """Return the peak memory of this process after a few steps in the huge mesh [bytes]."""
    simulation(lost_in_space(side)).step(3).check()
    return peak_memory()


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--particles", type=int, default=512_000)
    parser.add_argument("--rounds", type=int, default=7)
    parser.add_argument("--yardstick", help="folder of a module `yardstick` to run beside")
    arguments = parser.parse_args()
    side = side_of(arguments.particles)
    table = Table("throughput")
    table.add("particles", "", 8 * side**3)
    compare_schemes(table, side, arguments.rounds, arguments.yardstick)
    compare_phases(table, side, arguments.rounds)
    compare_motions(table, side, arguments.rounds)
    weigh(table, side)
    table.write()


if __name__ == "__main__":
    main()
