"""Write slope.stl and block.json: a plane that falls by 30 degrees, and particles on it."""

import json
from math import cos, radians, sin
from pathlib import Path

ANGLE = radians(30)
SPACING = 0.5  # m, half a cell
COUNT = (8, 6, 4)  # particles downhill, across, upwards from the plane
LOW, HIGH, WIDTH = -4.0, 14.0, 12.0  # m: ends of the plane downhill, its width


def on_plane(downhill, across, above):
    """Return a point by its distances [m] along and above the plane through the origin."""
    return [
        downhill * cos(ANGLE) + above * sin(ANGLE),
        across,
        -downhill * sin(ANGLE) + above * cos(ANGLE),
    ]


def main():
    folder = Path(__file__).parent
    corners = [(LOW, -WIDTH), (HIGH, -WIDTH), (HIGH, WIDTH), (LOW, WIDTH)]
    a, b, c, d = (on_plane(x, y, 0.0) for x, y in corners)
    lines = ["solid slope"]
    for triangle in ((a, b, c), (a, c, d)):
        lines += [f"facet normal {sin(ANGLE):.9g} 0 {cos(ANGLE):.9g}", "  outer loop"]
        lines += ["    vertex " + " ".join(f"{x:.9g}" for x in point) for point in triangle]
        lines += ["  endloop", "endfacet"]
    (folder / "slope.stl").write_text("\n".join([*lines, "endsolid slope"]) + "\n")
    places = [
        [round(x, 9) for x in on_plane(*((n + 0.5) * SPACING for n in (i, j, k)))]
        for i in range(COUNT[0])
        for j in range(COUNT[1])
        for k in range(COUNT[2])
    ]
    particles = [{"position": place, "volume": SPACING**3} for place in places]
    rows = ",\n".join(json.dumps(particle) for particle in particles)
    (folder / "block.json").write_text(f"[\n{rows}\n]\n")


if __name__ == "__main__":
    main()
