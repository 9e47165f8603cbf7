"""Names of materials and bodies in the place of their numbers.

Entries of an object have names, entries of a list have not. Bodies are numbered in alphabetical
order, active ones only; one that makes several numbered bodies cannot be named.
"""

from collections.abc import Iterator

from mpmgeo.case.kinds import declared
from mpmgeo.case.reading.places import places
from mpmgeo.case.report import nearest
from mpmgeo.case.spec import Case
from mpmgeo.values import shown


def named_places(cls=Case, place=()) -> Iterator[tuple[tuple[str, ...], str]]:
    """Yield the place of every number that may be a name, and the key of the entries with names."""
    for key, kind, field in declared(cls):
        here, entries = (*place, key), field.metadata["names"]
        if entries:
            yield (*here, "*") if kind.name == "map" else here, entries
        item = kind.item if kind.is_container else kind
        for inner in item.classes:
            yield from named_places(inner, (*here, "*") if kind.is_container else here)


def number_names(tree, report):
    """Replace names by numbers wherever a number of a material or body is wanted."""
    where = list(dict.fromkeys(named_places()))
    for entries, numbered in NUMBERED.items():
        numbers = numbered(tree)
        for place in [place for place, named in where if named == entries]:
            for path, node in places(tree, place[:-1]):
                keys = node if place[-1] == "*" else place[-1:]
                for key in [key for key in keys if isinstance(node.get(key), str)]:
                    found = numbers.get(node[key], [])
                    if len(found) == 1:
                        node[key] = found[0]
                    elif path[:-1] != ("body",) or "type" in node:  # else its keys are not known
                        message = _refusal(node[key], found, entries, numbers)
                        report.error((*path, key), message)


def _materials(tree):
    """Return the ids of the materials by name, a list each."""
    ids = ((path[-1], law.get("id")) for path, law in places(tree, ("materials", "*")))
    return {name: [id] for name, id in ids if isinstance(name, str) and _is_whole(id)}


def _bodies(tree):
    """Return the numbers of the active bodies by name, a list each."""
    bodies, numbers, last = tree.get("body"), {}, 0
    for name in sorted(bodies) if isinstance(bodies, dict) else ():
        body = bodies[name]
        if not isinstance(body, dict) or body.get("active") is False:
            continue
        groups = body.get("physical_to_material") if body.get("type") == "gmsh" else None
        if isinstance(groups, dict):
            count = sum(_is_whole(id) and id > 0 for id in groups.values())
        else:
            count = 1
        numbers[name] = list(range(last + 1, last + count + 1))
        last += count
    return numbers


NUMBERED = {"materials": _materials, "body": _bodies}
"""Key of entries with names → what finds their numbers; materials first, which bodies name."""


def _is_whole(value):
    return isinstance(value, int | float) and not isinstance(value, bool) and value == value // 1


def _refusal(word, found, entries, numbers):
    if len(found) > 1:
        text = ", ".join(map(str, found))
        return f"{shown(word)} stands for several bodies; write the number of one of them: {text}"
    text = f"{shown(word)} is not accepted; accepted: a whole number, without quotes"
    if numbers:
        near = nearest(word, numbers)
        hint = f"; did you mean {shown(near)}?" if near else ""
        text += f", or a name out of {entries}: {', '.join(map(shown, sorted(numbers)))}{hint}"
    return text
