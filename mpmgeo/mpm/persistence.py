"""The state of a solver as named arrays and facts, and back.

The state is all that a step changes and a later step depends on: a solver of the same case that
takes it over goes on bit for bit as the first one would have done.
"""

import numpy as np

from mpmgeo.mpm.incidents import Departure
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
    if solver.departures:
        arrays |= _departed(solver.departures)
    facts = {name: getattr(solver, name) for name in NUMBERS}
    if solver.base is not None:
        facts |= {"base_velocity": solver.base.velocity, "base_ended": bool(solver.base.ended)}
    if solver.contact is not None:
        facts |= {"ground_offset": solver.contact.offset, "ground_way": solver.contact.way}
    return Snapshot(arrays, facts)


def take_over(solver, state: Snapshot) -> None:
    """Give a solver that has made no step a state; raises ValueError if it does not fit."""
    arrays, facts = dict(state.arrays), state.facts
    try:
        for number, s in enumerate(solver.sets):
            for name, array in s.arrays().items():
                np.copyto(array, _fitting(arrays.pop(f"set{number}.{name}"), array))
            s.start, s.chunk = (arrays.pop(f"set{number}.{name}") for name in ("start", "chunk"))
        solver.grid.cover(arrays.pop("grid.keys"))
        np.copyto(solver.grid.records(), arrays.pop("grid.records"))
        solver.reactions = arrays.pop("reactions", None)
        solver.departures = _departures(arrays) if "departures.time" in arrays else []
        for name in NUMBERS:
            setattr(solver, name, facts[name])
        if solver.base is not None:
            _take_over_base(solver, facts)
        if solver.contact is not None:
            solver.contact.offset = tuple(facts["ground_offset"])
            solver.contact.way = facts["ground_way"]
    except KeyError as error:
        raise ValueError(f"the snapshot lacks {error.args[0]}, which the case needs") from None
    if arrays:
        raise ValueError(f"the snapshot has {min(arrays)}, which the case does not know")


def _fitting(found, array):
    """Return an array if it can take the place of another; raises ValueError otherwise."""
    if found.shape != array.shape or found.dtype != array.dtype:
        raise ValueError(
            f"the snapshot has an array {found.dtype} {found.shape} where the case needs "
            f"{array.dtype} {array.shape}"
        )
    return found


def _take_over_base(solver, facts):
    solver.base.velocity = tuple(facts["base_velocity"])
    solver.base.ended = facts["base_ended"]
    if solver.base.ended:
        solver.planes = solver.base.planes_after(solver.planes)


def _departed(departures):
    times, rows, positions = zip(*departures, strict=True)
    return {
        "departures.time": np.array(times),
        "departures.count": np.array([len(r) for r in rows]),
        "departures.rows": np.concatenate(rows),
        "departures.position": np.array(positions),
    }


def _departures(arrays):
    """Return the departures, and take them out of the arrays."""
    columns = [arrays.pop(f"departures.{name}") for name in ("time", "count", "rows", "position")]
    time, count, rows, position = columns
    parts = np.split(rows, np.cumsum(count)[:-1])
    return list(map(Departure, time.tolist(), parts, position))
