"""The state of a solver as named arrays and facts, and back.

The state is all that a step changes and a later step depends on: a solver of the same case that
takes it over goes on bit for bit as the first one would have done. Each owner of a part of it has
`held()`, which returns the part, and `take(state)`, which goes on with it, taking out what it
knows; snapshots, the copy that the guard keeps and going back to it all come from there.
"""

import numpy as np

from mpmgeo.state.snapshot import Snapshot

SPARE = 100
"""Rows that an array without a row for each particle or block may have beyond their number."""


def state_of(solver) -> dict:
    """Return the state by name; its arrays are those of the solver, not copies."""
    return {
        f"{owner}.{name}" if owner else name: value
        for owner, part in solver.owners().items()
        for name, value in part.held().items()
    }


def copy_of(state, kept) -> dict:
    """Return a copy of a state, in the arrays of the older one `kept` where they fit."""
    copy = {}
    for name, value in state.items():
        if isinstance(value, np.ndarray):
            old = kept.get(name)
            fits = old is not None and old.shape == value.shape
            copy[name] = old if fits else np.empty_like(value)
            np.copyto(copy[name], value)
        else:
            copy[name] = value
    return copy


def take_over(solver, state) -> None:
    """Give a solver a state; raises ValueError if it does not fit."""
    solver = solver.solver_of(state)
    parts = {}
    for name, value in state.items():
        owner, _, inner = name.rpartition(".")
        parts.setdefault(owner, {})[inner] = value
    for owner, part in solver.owners().items():
        here = f"{owner}." if owner else ""
        found = parts.pop(owner, {})
        try:
            part.take(found)
        except KeyError as error:
            raise ValueError(
                f"the snapshot lacks {here}{error.args[0]}, which the case needs"
            ) from None
        except ValueError as error:
            raise ValueError(f"the snapshot does not fit the case: {here}{error}") from None
        parts |= {owner: found} if found else {}
    unknown = sorted(f"{owner}.{name}" for owner, part in parts.items() for name in part)
    if unknown:
        raise ValueError(
            f"the snapshot has {unknown[0].removeprefix('.')}, which the case does not know"
        )


def snapshot_of(solver) -> Snapshot:
    """Return the state as it is written to a file."""
    state = state_of(solver)
    arrays = {name: value for name, value in state.items() if isinstance(value, np.ndarray)}
    return Snapshot(arrays, {"state": {n: v for n, v in state.items() if n not in arrays}})


def take_snapshot(solver, stored) -> None:
    """Give a solver the state in a file; raises ValueError if it does not fit.

    `stored`: a `StoredSnapshot`; nothing is read that is larger than the case can need. If it does
    not fit, or proves to be broken, the solver is of no use any more.
    """
    entries, state = stored.entries(most=solver.count + SPARE), stored.facts.get("state")
    if not isinstance(state, dict) or state.keys() & entries.keys():
        raise ValueError(f"{stored.path}: is no snapshot of a run")
    take_over(solver, entries | state)
    stored.verify()
