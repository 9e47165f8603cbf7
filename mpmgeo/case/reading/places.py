"""Objects in the tree of a case, by their place.

A place is a path of canonical keys in which `*` stands for every entry of a container.
"""

from collections.abc import Iterator


def places(node, place, path=()) -> Iterator[tuple[tuple, dict]]:
    """Yield (path, object) for every object of a tree that a place stands for."""
    if not place:
        if isinstance(node, dict):
            yield path, node
        return
    key, *rest = place
    if key == "*":
        entries = enumerate(node) if isinstance(node, list) else ()
        entries = node.items() if isinstance(node, dict) else entries
        for name, entry in entries:
            yield from places(entry, rest, (*path, name))
    elif isinstance(node, dict) and key in node:
        yield from places(node[key], rest, (*path, key))
