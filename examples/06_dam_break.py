"""A column of water collapses: front and height against an experiment.

The case inputs/dam_break, on a floor to which water sticks, and on a smooth one. The experiment of
Martin and Moyce (1952) begins with a gate that has to open, the computation does not: its front is
ahead by a hundredth of a second, and by nearly the same time all the way.
"""

import json
from pathlib import Path

import numpy as np

import mpmgeo
from mpmgeo.verify.dam_break import DamBreak, delay, difference

FOLDER = Path(__file__).parents[1] / "inputs" / "dam_break"
PROBLEM = DamBreak(width=0.05715, slenderness=2.0, gravity=9.81)

experiment = {
    name: np.loadtxt(FOLDER / f"{name}.csv", delimiter=",", skiprows=1)
    for name in ("front", "height")
}


def collapse(floor, cells=16):
    """Return Z(T) and H(τ) for a column so many cells wide on a "sliding" or "fixed" floor."""
    case = json.loads((FOLDER / "case.json").read_text(encoding="utf-8"))
    h = PROBLEM.width / cells
    case["mesh"]["cells_dimension"] = [h, h, h]
    case["mesh"]["cells_number"] = [18 * cells, 1, 3 * cells]
    case["mesh"]["boundary_conditions"]["plane_Z0"] = floor
    case["body"]["column"]["point_p2"][1] = h
    front, height = PROBLEM.follow(mpmgeo.Simulation(mpmgeo.load_case(case)))
    return {"front": front, "height": height}


def compare(curves):
    """Return by what share the front is ahead, how late the experiment is in T, the error of H."""
    front, height = experiment["front"], experiment["height"]
    return {
        "ahead": difference(curves["front"], front) / front[:, 1],
        "late": delay(curves["front"], front),
        "off": difference(curves["height"], height),
    }


def plot(curves):
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots(1, 2, figsize=(9, 3.6), layout="constrained")
    labels = {"front": ("T = t √(2g/a)", "Z = x/a"), "height": ("τ = t √(g/a)", "H = y/(2a)")}
    for axis, (name, (x, y)) in zip(axes, labels.items(), strict=True):
        axis.plot(*experiment[name].T, "ko", markersize=5, label="experiment")
        for (floor, found), line in zip(curves.items(), ("-", "--"), strict=True):
            axis.plot(*found[name].T, line, label=f"{floor} floor")
        span = experiment[name].max(axis=0) * (1.05, 1.1)
        axis.set(xlabel=x, ylabel=y, xlim=(0, span[0]), ylim=(0, span[1]))
        axis.grid(alpha=0.3)
    axes[0].legend(frameon=False)
    return figure


found = {floor: collapse(floor) for floor in ("fixed", "sliding")}

if __name__ == "__main__":
    for floor, curves in found.items():
        ahead, late, off = compare(curves).values()
        print(f"{floor} floor")
        print(
            f"  front ahead by {ahead.mean():.1%} in the mean, {ahead.max():.1%} at most,", end=""
        )
        print(f" or by {np.median(late):.2f} ± {late[1:].std():.2f} in T")
        print(f"  height off by {np.abs(off).mean():.3f} in H in the mean, {np.abs(off).max():.3f}")
    plot(found).show()
