"""Write ground.stl, level with a ramp on one side, and its motion, base_acceleration.csv."""

from itertools import pairwise
from pathlib import Path

LEVEL, RAMP, LENGTH, WIDTH, RISE = 1.0, 4.0, 12.0, 6.0, 2.0  # m
PULSE, PUSH = 0.5, 3.0  # s and m/s²: there and back
END = 1.4  # s


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
    instant = 1e-6
    rows = [
        (0.0, PUSH),
        (PULSE - instant, PUSH),
        (PULSE, -PUSH),
        (2 * PULSE - instant, -PUSH),
        (2 * PULSE, 0.0),
        (END + 0.1, 0.0),
    ]
    text = "".join(f"{t:.9g},{a:g},0,0\n" for t, a in rows)
    (folder / "base_acceleration.csv").write_text("t,ax,ay,az\n" + text)


if __name__ == "__main__":
    main()
