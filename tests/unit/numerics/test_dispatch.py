"""One name, many implementations, chosen by type in Python and in compiled code."""

import pickle
from typing import NamedTuple

import numba
import pytest
from numba import njit

from mpmgeo.numerics.dispatch import generic


class Circle(NamedTuple):
    r: float


class Square(NamedTuple):
    a: float


class Unknown(NamedTuple):
    r: float


class Disc(Circle):
    """A circle by another name."""

    __slots__ = ()


@pytest.fixture
def area():
    """A function of a model and a number, with implementations for two types and for None."""

    @generic
    def area(model, factor):
        """The area."""

    @area.register(Circle)
    def circle(model, factor):
        return 3.0 * model.r * model.r * factor

    @area.register(Square)
    def square(model, factor):
        return model.a * model.a * factor

    return area


def test_python_chooses_by_type(area):
    assert area(Circle(2.0), 10.0) == 120.0
    assert area(Square(2.0), 10.0) == 40.0
    assert area(Disc(2.0), 10.0) == 120.0


class Squares:
    """Where another class has the name of one above."""

    class Square(NamedTuple):
        α: float


class Cubes:
    """Where yet another has it; without its Greek letters it is the same to numba."""

    class Square(NamedTuple):
        β: float


def test_classes_of_the_same_name_are_different_types(area):
    @area.register(Squares.Square)
    def many(model, factor):
        return 100.0 * model.α * factor

    @area.register(Cubes.Square)
    def cubes(model, factor):
        return model.β * factor

    @njit
    def of_all(models):
        return area(models[0], 10.0)

    assert of_all((Squares.Square(2.0),)) == 2000.0
    assert of_all((Cubes.Square(2.0),)) == 20.0
    assert pickle.loads(pickle.dumps(Cubes.Square(2.0))) == Cubes.Square(2.0)


def test_compiled_code_chooses_by_type(area):
    @njit
    def twice(model):
        return 2.0 * area(model, 10.0)

    assert twice(Circle(2.0)) == 240.0
    assert twice(Square(2.0)) == 80.0
    assert twice(Disc(2.0)) == 240.0


def test_function_is_that_of_the_stub(area):
    assert area.__doc__ == "The area." and area.__name__ == "area"
    assert area.__module__ == __name__


def test_unknown_type(area):
    @njit
    def compiled(model):
        return area(model, 1.0)

    with pytest.raises(TypeError, match="area has no implementation for Unknown"):
        area(Unknown(1.0), 1.0)
    with pytest.raises((TypeError, numba.TypingError), match=r"area|Unknown"):
        compiled(Unknown(1.0))
    with pytest.raises((TypeError, numba.TypingError), match=r"area|float64"):
        compiled(1.0)


def test_late_registration_reaches_new_kernels(area):
    """What is registered later, by a user's file, counts as much."""

    @area.register(Unknown)
    def unknown(model, factor):
        return -1.0

    @njit
    def compiled(model):
        return area(model, 1.0)

    assert area(Unknown(1.0), 1.0) == compiled(Unknown(1.0)) == -1.0


def test_none_is_a_type(area):
    @area.register(type(None))
    def nothing(model, factor):
        return 0.0

    @njit
    def compiled(model):
        return area(model, 1.0)

    assert area(None, 1.0) == compiled(None) == 0.0


def test_second_registration(area):
    with pytest.raises(ValueError, match="area has an implementation for Circle"):

        @area.register(Circle)
        def again(model, factor):
            return 0.0

    assert area(Circle(1.0), 1.0) == 3.0


def test_wrong_signature(area):
    with pytest.raises(ValueError, match=r"area takes \(model, factor\), not \(model, scale\)"):

        @area.register(Unknown)
        def renamed(model, scale):
            return 0.0

    with pytest.raises(TypeError):
        area(Unknown(1.0), 1.0)
