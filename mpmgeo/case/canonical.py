"""The canonical form of what a case says: one way to write each value, defaults filled in."""

from mpmgeo.case.kinds import declared, listed, word_of


def plain(value):
    """Return a declared value, such as a default, as JSON: objects whole, tuples as lists."""
    if isinstance(value, tuple):
        return [plain(v) for v in value]
    if not hasattr(value, "__dataclass_fields__"):
        return value if isinstance(value, bool | int | float | str | dict | None) else str(value)
    word = word_of(type(value))
    result = {} if word is None else {"type": word}
    for key, _, field in declared(type(value)):
        item = getattr(value, field.name)
        if item is not None:
            result[key] = plain(item)
    keys = listed(type(value))
    return list(result.values()) if keys and result.keys() == keys.keys() else result
