"""What a case switches off, which is not read."""

from mpmgeo.case.reading.places import places
from mpmgeo.case.spec import ACTIONS
from mpmgeo.materials.saturation import KEYS

FROM_OUTSIDE = ("particles", "particles_list", "particles_from_file", "gmsh")
"""Kinds of body whose particles or files may be missing while the body is inactive."""


OF_TWO_PHASES = {("mesh",): ("boundary_conditions_fluid",), ("materials", "*"): KEYS}
"""Place → keys that are not read with one phase, whatever their values."""


def drop_inactive(tree, report):
    """Remove what a case switches off itself and what would be wrong if it were read."""
    bodies = tree.get("body")
    idle = [
        path[-1]
        for path, body in places(tree, ("body", "*"))
        if body.get("active") is False and body.get("type") in FROM_OUTSIDE
    ]
    for name in idle:
        report.note(("body", name), "inactive")
    if idle and isinstance(bodies, dict):
        tree["body"] = {name: body for name, body in bodies.items() if name not in idle}
    elif idle:
        kept = [index for index in range(len(bodies)) if index not in idle]
        tree["body"] = [bodies[index] for index in kept]
        report.written |= {("body", new): old for new, old in enumerate(kept)}
    if tree.get("n_phases") != 2:
        for place, keys in OF_TWO_PHASES.items():
            for _, part in places(tree, place):
                for key in keys:
                    part.pop(key, None)
    for key, switch in ((cls.key, cls.switch) for cls in ACTIONS if cls.switch):
        part = tree.get(key)
        if isinstance(part, dict) and part.get(switch, False) is False:
            if part and switch not in part:
                report.warn((key,), f'without effect, since "{switch}" is not true')
            del tree[key]
