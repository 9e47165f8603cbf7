"""From the user's coordinates to those of the mesh, which begins at (0, 0, 0).

The solver works in the latter alone: far from the user's (0, 0, 0) its positions have the same
digits as anywhere else. Subtracting the origin of the mesh is exact wherever the mesh is small in
comparison with its coordinates. Declarations mark what is a position (`parameters.py`).
"""

from dataclasses import fields, is_dataclass, replace

from mpmgeo.parameters import HEIGHT, Placed


def in_mesh(part, origin, axis=None):
    """Return a case, or a part of one, in coordinates of the mesh that begins at `origin` (3,) [m].

    What does not change is the same object, with all that it has read from files. `axis`: of the
    case's gravity, for heights.
    """
    changes = {}
    axis = _axis_of_gravity(part.gravity) if hasattr(part, "gravity") else axis
    for item in fields(part):
        old, place = getattr(part, item.name), item.metadata.get("place")
        if place == HEIGHT:
            new = old if old is None or not origin[axis] else old - origin[axis]
        else:
            new = _minus(old, origin) if place else _inside(old, origin, axis)
        if new is not old:
            changes[item.name] = new
    counts_from_there = not isinstance(part, Placed) or part.zero == origin
    if counts_from_there and not changes:
        return part
    made = replace(part, **changes)
    if isinstance(part, Placed):
        vars(made)["zero"] = origin
    return made


def reading_in_mesh(part, origin):
    """Return a part whose positions are all in files such that it reads them as those of the mesh.

    Other parts are returned as they are.
    """
    places = (item.name for item in fields(part) if item.metadata.get("place"))
    is_elsewhere = all(getattr(part, name) is None for name in places)
    return in_mesh(part, origin) if isinstance(part, Placed) and is_elsewhere else part


def _axis_of_gravity(gravity):
    """Return the axis along which gravity, constant or in time, is largest."""
    return max(range(3), key=lambda axis: abs(getattr(gravity, "value", gravity)[axis]))


def _inside(value, origin, axis):
    """Return what a field holds with all parts of a case in it moved."""
    if is_dataclass(value):
        return in_mesh(value, origin, axis)
    if not isinstance(value, tuple) or not any(map(is_dataclass, value[:1])):
        return value
    moved = tuple(in_mesh(entry, origin, axis) for entry in value)
    return value if all(a is b for a, b in zip(value, moved, strict=True)) else moved


def _minus(place, origin):
    """Return a position, a tuple of positions or None less the origin."""
    if place is None or not any(origin):
        return place
    if place and isinstance(place[0], tuple):
        return tuple(_minus(entry, origin) for entry in place)
    return tuple(x - o for x, o in zip(place, origin, strict=True))
