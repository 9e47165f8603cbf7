"""The kinds of value that the annotations of declarations stand for."""

from collections.abc import Iterator
from dataclasses import MISSING, Field, fields, is_dataclass
from functools import cache
from pathlib import Path
from types import NoneType, UnionType
from typing import NamedTuple, Union, get_args, get_origin, get_type_hints

SCALARS = {
    float: "number",
    int: "integer",
    bool: "boolean",
    str: "text",
    Path: "file",
    dict: "free",
}


class Kind(NamedTuple):
    """One of number, integer, boolean, text, file, free, object, list (any length), fixed (length),
    map (any names).

    `item`: kind of the entries of list, fixed and map; `classes`: the dataclasses an object may be,
    with fixed those of an object that may stand in its place; `is_nullable`: whether an entry may
    be null.
    """

    name: str
    item: "Kind | None" = None
    length: int = 0
    classes: tuple[type, ...] = ()
    is_nullable: bool = False

    @property
    def is_container(self) -> bool:
        """Return whether it is a list of objects, which a case may also write as an object."""
        return self.name == "list" and self.item.name == "object"


class Declared(NamedTuple):
    """One JSON key of a dataclass: its name, the kind of its value and its dataclass field."""

    key: str
    kind: Kind
    field: Field

    @property
    def is_required(self) -> bool:
        """Return whether the key has no default."""
        return self.field.default is MISSING


def kind_of(annotation) -> Kind:
    """Return the kind of value an annotation stands for; TypeError if it has none."""
    if annotation in SCALARS:
        return Kind(SCALARS[annotation])
    if is_dataclass(annotation):
        return Kind("object", classes=(annotation,))
    origin, arguments = get_origin(annotation), get_args(annotation)
    if origin in (Union, UnionType):
        kinds = [kind_of(a) for a in arguments if a is not NoneType]
        if len(kinds) == 1:
            return kinds[0]
        if all(kind.name == "object" for kind in kinds):
            return Kind("object", classes=sum((kind.classes for kind in kinds), ()))
        if [kind.name for kind in kinds] == ["fixed", "object"]:
            return kinds[0]._replace(classes=kinds[1].classes)
    if origin is dict and arguments[0] is str:
        return Kind("map", kind_of(arguments[1]))
    if origin is tuple and arguments[-1] is Ellipsis:
        return Kind("list", kind_of(arguments[0]))
    if origin is tuple and len(set(arguments)) == 1:
        item = kind_of(arguments[0])._replace(is_nullable=NoneType in get_args(arguments[0]))
        return Kind("fixed", item, len(arguments))
    raise TypeError(f"{annotation} stands for no kind of JSON value")


@cache
def declared(cls) -> tuple[Declared, ...]:
    """Return the JSON keys of a dataclass in the order of their declaration, the last ones last."""
    hints = get_type_hints(cls)
    return tuple(
        Declared(item.metadata["key"] or item.name, kind_of(hints[item.name]), item)
        for item in sorted(fields(cls), key=lambda item: bool(item.metadata.get("last")))
        if "doc" in item.metadata
    )


def listed(cls) -> dict[str, int]:
    """Return the keys of a class whose objects may be lists of their values, with their places.

    They are those that are required; there are none for other classes.
    """
    if not getattr(cls, "may_be_list", False):
        return {}
    keys = [item.key for item in declared(cls) if item.is_required]
    return {key: place for place, key in enumerate(keys)}


def containers(cls, place=()) -> Iterator[tuple[tuple[str, ...], tuple[type, ...]]]:
    """Yield places of lists of objects, outside of such lists, with the classes of their entries.

    A case may write them as objects, too, and so gives their entries names.
    """
    for key, kind, _ in declared(cls):
        if kind.is_container:
            yield (*place, key), kind.item.classes
        for inner in kind.classes:
            yield from containers(inner, (*place, key))


def word_of(cls) -> str | None:
    """Return the JSON word by which `"type"` chooses a class, None for a class without one."""
    return getattr(cls, "type", None)
