"""What a snapshot says about its case, and whether a case is the one of a snapshot."""

from mpmgeo.case.load import load_case, resolved
from mpmgeo.case.meaning.fingerprint import differences, fingerprint

MOST_DIFFERENCES = 5
"""Differences that a message names."""


def case_facts(case) -> dict:
    """Return the facts by which a snapshot knows its case; OSError if a file cannot be read."""
    return {"case": resolved(case), "fingerprint": fingerprint(case)}


def case_of(path, facts, case=None):
    """Return the case with which a run goes on: `case`, or the one in the facts of a snapshot.

    Raises ValueError if `case` is not that of the snapshot at `path`, or its files have changed.
    """
    if not all(isinstance(facts.get(key), dict) for key in ("case", "fingerprint")):
        raise ValueError(f"{path}: is no snapshot of a run")
    case = load_case(facts["case"]) if case is None else case
    try:
        found = differences(facts["fingerprint"], fingerprint(case))
    except RecursionError:  # no case is nested so deep
        raise ValueError(f"{path}: is no snapshot of a run") from None
    if found:
        named = ", ".join(found[:MOST_DIFFERENCES])
        more = f" and {len(found) - MOST_DIFFERENCES} more" if found[MOST_DIFFERENCES:] else ""
        raise ValueError(f"{path}: is of another case, or its files have changed: {named}{more}")
    return case
