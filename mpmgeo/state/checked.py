"""What a state that comes from a file holds, taken out of it by name and checked before use.

Each function raises KeyError if the name is missing and ValueError, with the name, if the value is
not what a state can hold.
"""

from contextlib import suppress
from math import isfinite
from numbers import Integral, Real

import numpy as np

from mpmgeo.state.snapshot import Entry

MOST = 2**53  # above which doubles skip whole numbers


def array_from(state: dict, name: str, like: np.dtype | str, shape: tuple) -> np.ndarray:
    """Take out an array of a type and shape; None stands for any length along an axis.

    One that is still in a file, an `Entry`, is read if it fits.
    """
    found, dtype = state.pop(name), np.dtype(like)
    if not isinstance(found, np.ndarray | Entry):
        raise ValueError(f"{name} is {brief(found)} where the case needs an array")
    fits = len(shape) == len(found.shape) and all(
        wanted in (None, length) for wanted, length in zip(shape, found.shape, strict=True)
    )
    if found.dtype != dtype or not fits:
        lengths = ", ".join("any" if length is None else str(length) for length in shape)
        raise ValueError(
            f"{name} is an array {found.dtype} {found.shape} where the case needs {dtype} "
            f"({lengths}{',' * (len(shape) == 1)})"
        )
    if isinstance(found, np.ndarray):
        return found
    if None in shape and max(found.shape) > found.most:
        raise ValueError(f"{name} has the shape {found.shape}, more than the case can need")
    return found.read()


def number_from(state: dict, name: str, least: float = -np.inf) -> float:
    """Take out a finite number that is not below `least`."""
    value = state.pop(name)
    if not _is_finite(value) or value < least:
        raise ValueError(f"{name} is {brief(value)} where the case needs a finite number")
    return float(value)


def whole_from(state: dict, name: str) -> int:
    """Take out a whole number from 0 on."""
    value = state.pop(name)
    if not isinstance(value, Integral) or isinstance(value, bool) or not 0 <= value < MOST:
        raise ValueError(f"{name} is {brief(value)} where the case needs a whole number")
    return value


def truth_from(state: dict, name: str) -> bool:
    """Take out true or false."""
    value = state.pop(name)
    if not isinstance(value, bool):
        raise ValueError(f"{name} is {brief(value)} where the case needs true or false")
    return value


def vector_from(state: dict, name: str) -> tuple:
    """Take out three finite numbers."""
    value = state.pop(name)
    is_list = isinstance(value, list | tuple | np.ndarray) and len(value) == 3
    if not (is_list and all(map(_is_finite, value))):
        raise ValueError(f"{name} is {brief(value)} where the case needs three finite numbers")
    return tuple(map(float, value))


def demand(is_sound: bool, message: str) -> None:
    """Raise ValueError with the message unless something is sound."""
    if not is_sound:
        raise ValueError(message)


def brief(value) -> str:
    """Return a value of a file as a message shows it."""
    if isinstance(value, np.ndarray | Entry):
        return f"an array {value.dtype} {value.shape}"
    kind = {dict: "an object", list: "a list", str: "a text", type(None): "null"}.get(type(value))
    return kind or str(value)[:40]


def _is_finite(value):
    if isinstance(value, Real) and not isinstance(value, bool):
        with suppress(OverflowError):  # a whole number that no double can hold
            return isfinite(value)
    return False
