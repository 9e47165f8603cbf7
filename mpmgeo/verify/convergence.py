"""Order of convergence: how fast an error falls when the cells get smaller, error ≈ C hᵖ."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Convergence:
    """Errors (m,) that belong to cell sizes (m,) [m], from coarse to fine."""

    size: np.ndarray
    error: np.ndarray

    @property
    def order(self) -> float:
        """Return the slope p of the straight line through all log h, log error."""
        return float(np.polyfit(np.log(self.size), np.log(self.error), 1)[0])

    @property
    def orders(self) -> np.ndarray:
        """Return p (m − 1,) between each cell size and the next finer one."""
        return np.diff(np.log(self.error)) / np.diff(np.log(self.size))


def refine(error_at: Callable[[int], float], cells: Sequence[int], length: float) -> Convergence:
    """Return the errors of `error_at(n)` with n `cells` along `length` [m], for every n."""
    errors = np.array([error_at(n) for n in cells])
    return Convergence(length / np.array(cells), errors)


def relative_error(value: np.ndarray, exact: np.ndarray) -> float:
    """Return ‖value − exact‖ / ‖exact‖ in the L2 norm over all points and components."""
    return float(np.linalg.norm(np.subtract(value, exact)) / np.linalg.norm(exact))
