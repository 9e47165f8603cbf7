"""Bearing capacity of a strip footing on weightless ground without friction.

    q = (2 + π) c

Source: Prandtl (1921), Z. angew. Math. Mech. 1, 15–20; exact, for smooth and rough footings alike.
"""

from math import pi


def bearing_capacity(cohesion: float) -> float:
    """Return the mean pressure [Pa] under a strip footing at failure; cohesion in Pa."""
    return (2 + pi) * cohesion
