"""What a case comes down to: all that its results depend on, files by their content."""

import hashlib
from pathlib import Path

from mpmgeo.case.kinds import declared, word_of

TEXTS = ("title", "reference", "expected")
FREE = (*TEXTS, "time", "n_threads", "plane_strain", "snapshot", "load_state", "save_state")
"""Keys that may change while a run goes on."""


def fingerprint(case) -> dict:
    """Return the content of a case as JSON; raises OSError for a file that cannot be read."""
    return {key: value for key, value in _content(case).items() if key not in FREE}


def differences(one: dict, other: dict) -> list[str]:
    """Return the paths at which two fingerprints differ."""
    first, second = dict(leaves(one)), dict(leaves(other))
    keys = dict.fromkeys([*first, *second])
    return [key for key in keys if first.get(key) != second.get(key)]


def _content(value):
    if isinstance(value, Path):
        with value.open("rb") as file:
            return hashlib.file_digest(file, "sha256").hexdigest()
    if isinstance(value, tuple):
        return [_content(entry) for entry in value]
    if not hasattr(value, "__dataclass_fields__"):
        return value
    word = word_of(type(value))
    content = {} if word is None else {"type": word}
    for item in declared(type(value)):
        content[item.key] = _content(getattr(value, item.field.name))
    return content


def leaves(node, path=""):
    """Yield (path, value) of all values in a tree that are neither list nor object."""
    if isinstance(node, dict):
        for key, value in node.items():
            yield from leaves(value, f"{path}.{key}" if path else key)
    elif isinstance(node, list):
        for index, value in enumerate(node):
            yield from leaves(value, f"{path}[{index}]")
    else:
        yield path, node
