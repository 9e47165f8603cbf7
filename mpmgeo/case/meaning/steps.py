"""Whether a run can come to its end."""

import math

from mpmgeo.case.stepping import ADAPTIVE
from mpmgeo.materials import saturation
from mpmgeo.values import shown

MOST_STEPS = 1e12
"""Steps beyond which no run comes to its end."""


def check_steps(draft, report):
    """Report that more time steps are needed than can be made."""
    case = draft.whole.values
    if "time" not in case or "time_step" not in case:
        return
    time, step = case["time"], case["time_step"]
    if step == ADAPTIVE and case.get("compatibility") is not None:
        message = f"MPM-Geomechanics keeps its step; leave {shown(ADAPTIVE)} or compatibility out"
        report.error(("time_step",), message)
    step = None if step == ADAPTIVE else step
    key = "time" if step is None else "time_step"
    if step is None:
        step = _automatic_step(draft)
    if step is not None and not time <= MOST_STEPS * step:
        count = time / step if step else math.inf
        report.error((key,), f"{count:.3g} steps of {step:.3g} s are needed, more than can be made")


def _automatic_step(draft):
    """Return about the time step that will be chosen [s]; None if it cannot be told yet."""
    case, mesh, laws = draft.whole.values, draft.made("mesh"), draft.made("materials")
    share, two = case.get("critical_time_step_multiplier"), case.get("n_phases") == 2
    if share is None or not mesh or not laws or len(laws) < len(draft.of("materials")):
        return None
    if two and any(getattr(law, key) is None for law in laws for key in saturation.KEYS):
        return None
    if two and any(saturation.problem(law, case.get("conductivity_gravity", 1.0)) for law in laws):
        return None
    cell = min(mesh[0].cells_dimension)
    if two:
        steps = [saturation.critical_time_step(law, cell, 0.0) for law in laws]
    else:
        steps = [law.critical_time_step(cell, 0.0) for law in laws]
    return share * min(steps)
