"""The particles that a body generates."""

from typing import NamedTuple

import numpy as np


class Cloud(NamedTuple):
    """Particles of one body in creation order.

    position (n, 3): centres [m]; size (n, 3): full edge lengths [m], whose product is the volume;
    notes: what the user should know about the result, one sentence each; material: id of the one
    material, or (n,) of each particle's.
    """

    position: np.ndarray
    size: np.ndarray
    notes: tuple[str, ...] = ()
    material: int | np.ndarray | None = None
