"""Write ground.stl, level with a ramp on one side, and its motion, base_acceleration.csv."""

from itertools import pairwise
from pathlib import Path

LEVEL, RAMP, LENGTH, WIDTH, RISE = 1.0, 4.0, 12.0, 6.0, 2.0  # m
PULSE, PUSH = 0.5, 3.0  # s and m/s²: there and back
END = 1.4  # s
INSTANT = 1e-6  # s


def pulse(t):
    """Return the acceleration along x at time t [s]."""
    return PUSH if t < PULSE else -PUSH if t < 2 * PULSE else 0.0


def main():
    folder = Path(__file__).parent
    profile = [(0.0, LEVEL + RISE), (RAMP, LEVEL), (LENGTH, LEVEL)]
    lines = ["solid ground"]
    for (x0, z0), (x1, z1) in pairwise(profile):
        a, b, c, d = (x0, 0.0, z0), (x1, 0.0, z1), (x1, WIDTH, z1), (x0, WIDTH, z0)
        for triangle in ((a, b, c), (a, c, d)):
            lines += ["facet normal 0 0 0", "  outer loop"]
            lines += [f"    vertex {x:g} {y:g} {z:g}" for x, y, z in triangle]
            lines += ["  endloop", "endfacet"]
    (folder / "ground.stl").write_text("\n".join([*lines, "endsolid ground"]) + "\n")
    instants = [n / 100 for n in range(round(100 * END) + 10)]
    instants += [PULSE - INSTANT, 2 * PULSE - INSTANT]  # so that the pulses end at once
    rows = [(t, pulse(t)) for t in sorted(instants)]
    text = "".join(f"{t:.9g},{a:g},0,0\n" for t, a in rows)
    (folder / "base_acceleration.csv").write_text("t,ax,ay,az\n" + text)


if __name__ == "__main__":
    main()
