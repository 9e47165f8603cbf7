"""Keys for parts that mpmgeo does not have: accepted while they switch nothing on."""

from typing import NamedTuple

from mpmgeo.case.aliases import places


class Unsupported(NamedTuple):
    """What a value at a place would ask for; `values` empty: every value that is not neutral."""

    part: str
    values: tuple = ()


UNSUPPORTED = {
    ("n_phases",): Unsupported("two phases", (2,)),
}


FROM_OUTSIDE = ("particles", "particles_list", "particles_from_file", "gmsh")
"""Kinds of body whose particles or files may be missing while the body is inactive."""


SWITCHES = {
    "earthquake": "active",
    "terrain_contact": "active",
    "hydro_mechanical_coupling": "enabled",
}
"""Top-level keys of parts that a key of their own switches on."""


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
    for key, switch in SWITCHES.items():
        part = tree.get(key)
        if isinstance(part, dict) and part.get(switch, False) is False:
            if part and switch not in part:
                report.warn((key,), f'without effect, since "{switch}" is not true')
            del tree[key]
