"""Why a run diverged: the first bad particle and the likely cause, in words."""

from math import hypot

import numpy as np

from mpmgeo.positions import shown


def diagnose(simulation, error, last_stress):
    """Return a message about the particle that an Unsound error names.

    `last_stress` (6,) is the particle's in the last sound state [Pa], or None without one.
    """
    dt = simulation.time_step
    where = shown(error.position, digits=4)
    stress = error.stress if last_stress is None else last_stress
    stress = ", ".join(f"{s:.4g}" for s in stress)
    speed = hypot(*error.velocity)  # squares of such speeds may overflow
    return (
        f"the run diverged in step {error.step} (time {error.time:.6g} s): particle {error.row} of "
        f"material {error.material} at {where} has a speed of {speed:.4g} m/s, its last "
        f"stress was ({stress}) Pa; {_cause(simulation, dt)}; the files show the last sound state"
    )


def last_stress(kept, row):
    """Return the stress (6,) [Pa] that a kept state, or None, has of the particle in a row."""
    for name, rows in (kept or {}).items():
        if name.endswith(".row") and (found := rows == row).any():
            return kept[name.removesuffix("row") + "stress"][found][0]
    return None


def _cause(simulation, dt):
    stable = simulation.stable_time_step
    if stable == 0:
        return f"likely cause: {method(simulation)} is stable with no time step, try MUSL"
    if dt > stable:
        return too_long(simulation)
    lightest = simulation.nodes().mass.min(initial=np.inf) / simulation.field("mass").min()
    if lightest < 1e-6:
        return (
            "likely cause: nodes of very little mass, the lightest with "
            f"{lightest:.1g} of a particle's; try MUSL, or half the time step"
        )
    return (
        f"the time step of {dt:.4g} s is below {stable:.4g} s, up to which {method(simulation)} "
        "is stable; likely causes: very large loads or speeds, or particles squeezed to a fraction "
        "of their size"
    )


def too_long(simulation):
    """Return that a time step beyond the stable one is the likely cause, and what to try."""
    stable = simulation.stable_time_step
    return (
        f"likely cause: the time step of {simulation.time_step:.4g} s exceeds {stable:.4g} s, up "
        f"to which {method(simulation)} is stable, try {0.5 * stable:.2g} s or less"
    )


def method(simulation):
    """Return the scheme and the shape of a simulation, in words."""
    return f"{simulation.case.stress_scheme_update} with {simulation.case.shape_function}"
