"""What a snapshot says about its case, and with which case a run may go on from it."""

from mpmgeo.case.load import load_case, resolved
from mpmgeo.case.meaning.fingerprint import FREE, differences, fingerprint, leaves
from mpmgeo.case.report import nearest
from mpmgeo.instants import has_come_to

MOST_DIFFERENCES = 5
"""Differences that a message names."""

SETTLED = (
    *("mesh.cells_number", "mesh.cells_dimension", "mesh.origin", "body"),
    *("n_phases", "compatibility", "load_distributed_box", "hydro_mechanical_coupling"),
    *("initial_stress", "initial_pressure_box", "initial_pressure_material"),
    *("prescribed_pressure_box", "pressure_force_box"),
)
"""Keys whose effect is in the particles of a snapshot, so that they cannot change any more."""

LEDGER = "results.energy"

SETTLED_OF_MATERIALS = (
    "id",
    "type",
    "density",
    "density_fluid",
    "porosity",
    "k0",
    "density_saturated",
)


def case_facts(case) -> dict:
    """Return the facts by which a snapshot knows its case; OSError if a file cannot be read."""
    return {"case": resolved(case), "fingerprint": fingerprint(case)}


def branch_of(path, facts, case=None, allow=()):
    """Return the case with which a run goes on, and what it changes: {key: (old, new)}.

    That is `case`, or the one in the facts of the snapshot at `path`. Raises ValueError if they
    differ in more than the keys in `allow`, each one of the case or the beginning of one.
    """
    if not all(isinstance(facts.get(key), dict) for key in ("case", "fingerprint")):
        raise ValueError(f"{path}: is no snapshot of a run")
    case = load_case(facts["case"]) if case is None else case
    old, new = facts["fingerprint"], fingerprint(case)
    try:
        before, after = dict(leaves(old)), dict(leaves(new))
    except RecursionError:  # no case is nested so deep
        raise ValueError(f"{path}: is no snapshot of a run") from None
    allow = _known([allow] if isinstance(allow, str) else allow, {**before, **after})
    found = differences(old, new)
    if any(key.startswith(LEDGER) and None in (before.get(key), after.get(key)) for key in found):
        raise ValueError(
            f"{path}: {LEDGER} can neither be added nor left out: the balance is a part of the "
            "snapshot, and of the work that its particles know of"
        )
    strange = [key for key in found if not _is_within(key, allow)]
    if strange:
        named = ", ".join(strange[:MOST_DIFFERENCES])
        more = f" and {len(strange) - MOST_DIFFERENCES} more" if strange[MOST_DIFFERENCES:] else ""
        raise ValueError(
            f"{path}: is of another case, or its files have changed: {named}{more}; "
            "keys that are to change are named by --allow, in Python by allow=[…]"
        )
    settled = [key for key in found if _is_settled(key)]
    if settled:
        raise ValueError(f"{path}: {settled[0]} cannot change: the snapshot's particles have it")
    return case, {key: (before.get(key), after.get(key)) for key in found}


def _known(allow, keys):
    """Return keys that may change as they are; raises ValueError for one that there is not."""
    for wanted in allow:
        if wanted not in FREE and not any(_is_within(key, [wanted]) for key in keys):
            guess = nearest(wanted, [*keys, *(key.partition("[")[0] for key in keys)])
            hint = f"; did you mean {guess}?" if guess else ""
            raise ValueError(f"allow: the case has no key {wanted}{hint}")
    return allow


def _is_within(key, parts):
    return any(key == part or key.startswith((f"{part}.", f"{part}[")) for part in parts)


def _is_settled(key):
    material = key.startswith("materials") and key.rpartition(".")[2] in SETTLED_OF_MATERIALS
    return material or _is_within(key, SETTLED)


def topics_of(path, facts) -> set:
    """Return what the user has been told of before; raises ValueError for no snapshot of a run."""
    told = facts.get("told")
    if not (isinstance(told, list) and all(isinstance(topic, str) for topic in told)):
        raise ValueError(f"{path}: is no snapshot of a run")
    return set(told)


def check_force(path, facts, body_force) -> None:
    """Raise ValueError unless a `body_force` is given for a run that had one, and only then."""
    had = facts.get("body_force", False)
    if had and body_force is None:
        raise ValueError(
            f"{path}: the run has a body_force, a function that no file holds; in Python give it "
            "again, Simulation.resume(path, body_force=…)"
        )
    if body_force is not None and not had:
        raise ValueError(f"{path}: the run has no body_force; leave it out")


def record_of(simulation, changed, facts) -> list:
    """Return what snapshots record of values that changed whenever a run went on."""
    earlier = list(facts.get("changes", ()))
    if not changed:
        return earlier
    return [*earlier, {"time": simulation.time, "steps": simulation.steps, "values": changed}]


def remarks_on(simulation, changed):
    """Yield what to tell of a run that goes on: values that changed, or that it is at its end."""
    for key, (old, new) in changed.items():
        yield f"{key}: {new} from {simulation.time:.6g} s on, {old} before"
    if has_come_to(simulation, simulation.case.time):
        yield (
            f"the run is at its end already, {simulation.case.time:.6g} s; "
            "it goes on if a case says a later time"
        )
