"""How a solver takes up the state of a snapshot, whether of a layer or of all particles."""

from dataclasses import replace

from mpmgeo.case.building.solver import build
from mpmgeo.mpm.persistence import state_of, take_over, take_snapshot


def take_up(solver, snapshot, original, body_force) -> None:
    """Give a solver the state of a stored snapshot; ValueError if it does not fit.

    One of a layer goes to a solver of all, or of other layers, by way of the case that the snapshot
    is of, which `original()` returns.
    """
    across = snapshot.facts.get("across")
    if across is None or across == getattr(solver, "across", None):
        take_snapshot(solver, snapshot)
    else:
        of_layer, _ = build(replace(original(), plane_strain="auto"), body_force, starts=False)
        take_snapshot(of_layer, snapshot)
        of_layer.unfold()
        take_over(solver, state_of(of_layer.acting))
    if hasattr(solver, "fold"):
        solver.fold()
