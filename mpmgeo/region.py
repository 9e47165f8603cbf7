"""A box in space that chooses particles."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from mpmgeo.parameters import Placed, Vector, parameter
from mpmgeo.positions import NOWHERE, coordinate, resolution


def turned(low, high) -> Iterator[tuple[str, str]]:
    """Yield (key, message) for every axis along which a box is turned round."""
    for name, lower, upper in zip("xyz", low, high, strict=True):
        if upper < lower:
            text = f"{coordinate(upper)}, below that of point_p1, {coordinate(lower)}"
            yield "point_p2", f"{name} is {text}"


def bounds(low, high, zero=NOWHERE) -> tuple[np.ndarray, np.ndarray]:
    """Return the corners (3,) [m] of a closed box, widened by what doubles do not resolve there."""
    return low - resolution(zero, low), high + resolution(zero, high)


def within(low, high, position: np.ndarray, zero=NOWHERE) -> np.ndarray:
    """Tell which of the positions (n, 3) [m] lie in a closed box."""
    low, high = bounds(low, high, zero)
    return ((position >= low) & (position <= high)).all(axis=1)


@dataclass(frozen=True)
class Box(Placed):
    """A closed box along the axes."""

    point_p1: Vector = parameter("Corner of lowest coordinates", unit="m", place=True)
    point_p2: Vector = parameter("Corner of highest coordinates", unit="m", place=True)

    def problems(self) -> Iterator[tuple[str, str]]:
        """Yield (key, message) for every axis along which the box is turned round."""
        yield from turned(self.point_p1, self.point_p2)

    def contains(self, position: np.ndarray) -> np.ndarray:
        """Tell which of the positions (n, 3) [m] lie in the box."""
        return within(self.point_p1, self.point_p2, position, self.zero)
