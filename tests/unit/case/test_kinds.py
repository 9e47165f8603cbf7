"""What the annotations of declarations stand for."""

from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

import pytest

from mpmgeo.case.kinds import Kind, declared, kind_of, word_of
from mpmgeo.parameters import Counts, Vector, parameter


@dataclass(frozen=True)
class Ball:
    """A ball."""

    type: ClassVar[str] = "ball"
    size: float = parameter("Size", above=0)
    name: str | None = parameter("Name", default=None)


@dataclass(frozen=True)
class Box:
    """A box."""

    type: ClassVar[str] = "box"


@pytest.mark.parametrize(
    ("annotation", "kind"),
    [
        (float, Kind("number")),
        (int | None, Kind("integer")),
        (bool, Kind("boolean")),
        (Path | None, Kind("file")),
        (dict | None, Kind("free")),
        (Vector, Kind("fixed", Kind("number"), 3)),
        (Counts, Kind("fixed", Kind("integer"), 3)),
        (tuple[Vector, ...], Kind("list", Kind("fixed", Kind("number"), 3))),
        (tuple[str, ...], Kind("list", Kind("text"))),
        (Ball, Kind("object", classes=(Ball,))),
        (Vector | Ball, Kind("fixed", Kind("number"), 3, (Ball,))),
        (Ball | Box | None, Kind("object", classes=(Ball, Box))),
        (tuple[Ball | Box, ...], Kind("list", Kind("object", classes=(Ball, Box)))),
    ],
)
def test_kinds(annotation, kind):
    assert kind_of(annotation) == kind


@pytest.mark.parametrize("annotation", [complex, float | str, tuple[int, str], list, Ball | int])
def test_annotations_without_a_kind(annotation):
    with pytest.raises(TypeError):
        kind_of(annotation)


def test_only_lists_of_objects_are_containers():
    assert kind_of(tuple[Ball, ...]).is_container
    assert not kind_of(tuple[str, ...]).is_container
    assert not kind_of(Vector).is_container


def test_declared_keys_come_in_order_without_the_type():
    keys = list(declared(Ball))
    assert [item.key for item in keys] == ["size", "name"]
    assert [item.is_required for item in keys] == [True, False]
    assert word_of(Ball) == "ball"
    assert word_of(object) is None
