"""A saturated column that consolidates under a load, drained at its top, between smooth walls.

    p₀ = q/(1 + n M/K),    c_v = k M/(γ (1 + n M/K)),    T = c_v t/H²
    p/p₀ = Σ 2/m sin(m (1 − z/H)) exp(−m² T),    U = 1 − Σ 2/m² exp(−m² T),    m = π/2, 3π/2, …

p₀: pressure under the sudden load q, before anything drains; the skeleton bears the rest. U: share
of the pressure that has drained, in the mean over the height.

Sources: Terzaghi (1925), Erdbaumechanik; Verruijt (2013), Theory and Problems of Poroelasticity,
sections 2.2 and 2.3, for the fluid that is compressible.
"""

from dataclasses import dataclass

import numpy as np

TERMS = 200


@dataclass(frozen=True)
class Terzaghi:
    """Column of height H [m] under a load q [Pa]; its base is tight.

    modulus: stiffness of the skeleton without lateral strain M [Pa]; porosity n; bulk_fluid K [Pa];
    conductivity k [m/s]; unit_weight of the fluid γ [N/m³].
    """

    height: float
    load: float
    modulus: float
    porosity: float
    bulk_fluid: float
    conductivity: float
    unit_weight: float

    @property
    def _storage(self):
        return 1 + self.porosity * self.modulus / self.bulk_fluid

    @property
    def initial_pressure(self) -> float:
        """Return p₀ [Pa]."""
        return self.load / self._storage

    @property
    def coefficient(self) -> float:
        """Return the coefficient of consolidation c_v [m²/s]."""
        return self.conductivity * self.modulus / (self.unit_weight * self._storage)

    def time(self, factor: float) -> float:
        """Return the time [s] that belongs to a time factor T."""
        return factor * self.height**2 / self.coefficient

    def degree(self, time: float) -> float:
        """Return the degree of consolidation U at a time > 0 [s]."""
        m = np.pi * (np.arange(TERMS) + 0.5)
        factor = time * self.coefficient / self.height**2
        return 1 - float((2 / m**2 * np.exp(-(m**2) * factor)).sum())

    def pressure(self, z: np.ndarray, time: float) -> np.ndarray:
        """Return the pressure (n,) [Pa] at heights z (n,) [m] above the base, at a time > 0 [s]."""
        m = np.pi * (np.arange(TERMS) + 0.5)
        factor = time * self.coefficient / self.height**2
        depth = 1 - np.asarray(z)[:, None] / self.height
        series = 2 / m * np.sin(m * depth) * np.exp(-(m**2) * factor)
        return self.initial_pressure * series.sum(axis=1)

    def settlement(self, time: float) -> float:
        """Return how far the top has sunk [m] at a time > 0 [s], with what it sank at once."""
        at_once = self.load - self.initial_pressure
        drained = self.initial_pressure * self.degree(time)
        return (at_once + drained) * self.height / self.modulus
