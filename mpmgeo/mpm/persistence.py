"""The state of a solver as named arrays and facts, and back.

The state is all that a step changes and a later step depends on: a solver of the same case that
takes it over goes on bit for bit as the first one would have done.
"""

import numpy as np

from mpmgeo.mpm.solver import Departure
from mpmgeo.state.snapshot import Snapshot

NUMBERS = ("time", "steps", "last_energy", "peak_energy", "gone")


def state_of(solver) -> Snapshot:
    """Return the state; its arrays are those of the solver, not copies."""
    arrays = {"grid.keys": solver.grid.keys, "grid.records": solver.grid.records()}
    for number, s in enumerate(solver.sets):
        for name, array in (s.arrays() | {"start": s.start, "chunk": s.chunk}).items():
            arrays[f"set{number}.{name}"] = array
    if solver.reactions is not None:
        arrays["reactions"] = solver.reactions
    for number, departure in enumerate(solver.departures):
        for name, value in departure._asdict().items():
            arrays[f"departure{number}.{name}"] = np.asarray(value)
    facts = {name: getattr(solver, name) for name in NUMBERS}
    if solver.base is not None:
        facts |= {"base_velocity": solver.base.velocity, "base_ended": solver.base.ended}
    return Snapshot(arrays, facts)


def take_over(solver, state: Snapshot) -> None:
    """Give a solver that has made no step a state; raises ValueError if it does not fit."""
    arrays, facts = dict(state.arrays), state.facts
    for number, s in enumerate(solver.sets):
        for name, array in s.arrays().items():
            found = arrays.pop(f"set{number}.{name}", None)
            if found is None or found.shape != array.shape or found.dtype != array.dtype:
                raise ValueError(f"{name} of particle set {number} does not fit the case")
            np.copyto(array, found)
        s.start, s.chunk = (arrays.pop(f"set{number}.{name}") for name in ("start", "chunk"))
    solver.grid.cover(arrays.pop("grid.keys"))
    np.copyto(solver.grid.records(), arrays.pop("grid.records"))
    solver.reactions = arrays.pop("reactions", None)
    solver.departures = list(_departures(arrays))
    if arrays:
        raise ValueError(f"{min(arrays)} has no place in the case")
    for name in NUMBERS:
        setattr(solver, name, facts[name])
    if solver.base is not None:
        solver.base.velocity = tuple(facts["base_velocity"])
        solver.base.ended = facts["base_ended"]
        if solver.base.ended:
            solver.planes = solver.base.planes_after(solver.planes)


def _departures(arrays):
    number = 0
    while f"departure{number}.time" in arrays:
        time, rows, position = (
            arrays.pop(f"departure{number}.{name}") for name in Departure._fields
        )
        yield Departure(float(time), rows, position)
        number += 1
