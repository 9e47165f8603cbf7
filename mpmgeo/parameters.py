"""Declare a parameter of a case once: schema, checks, messages and manual read it from here."""

from dataclasses import MISSING, field
from typing import ClassVar

Vector = tuple[float, float, float]
Components = tuple[float | None, float | None, float | None]
Counts = tuple[int, int, int]

HEIGHT = "height"
"""`place` of a coordinate on the axis of gravity."""


def parameter(
    doc,
    *,
    unit="",
    default=MISSING,
    above=None,
    minimum=None,
    below=None,
    maximum=None,
    choices=None,
    file=False,
    place=False,
    key=None,
    several=False,
    word=False,
    names=None,
    words=(),
    last=False,
):
    """Return the dataclass field of one JSON key.

    `doc` is one sentence; `unit` is SI ("" for none); `above`/`below` are open bounds, `minimum`/
    `maximum` closed ones, and bound every component of a vector; `choices` lists the accepted
    words; `file` marks the name of a file, resolved against the case's folder; `place` marks a
    position, or several, in the user's coordinates, HEIGHT the one on the axis of gravity; `key` is
    the JSON key where it is not the name of the field; `several`: a list of objects is accepted in
    the place of one; `word`: the word of its type is, if it says nothing else; `names`: the key of
    the entries of the case whose names are accepted in the place of a number; `words`: words that
    are accepted in the place of one; `last`: the key comes after those of the classes that inherit
    it. Without a `default` the key is required.
    """
    bounds = {"above": above, "minimum": minimum, "below": below, "maximum": maximum}
    metadata = {
        "doc": doc,
        "unit": unit,
        "bounds": {name: value for name, value in bounds.items() if value is not None},
        "choices": choices,
        "file": file,
        "place": place,
        "key": key,
        "several": several,
        "word": word,
        "names": names,
        "words": words,
        "last": last,
    }
    return field(default=default, metadata=metadata, kw_only=True)


class Placed:
    """What says positions, itself or in a file.

    `zero` (3,) [m]: where they count from in the user's coordinates; the origin of the mesh where
    the solver works with them.
    """

    zero: ClassVar[Vector] = (0.0, 0.0, 0.0)
