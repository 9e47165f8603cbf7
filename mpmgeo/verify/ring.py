"""An expanding ring: one of neo-Hookean material (ν = 0) with free edges breathes.

    u = A sin(cπt) (c₃R³ + c₂R² + c₁R),    u′ = 0 at both edges,    u(Rₒ) = A sin(cπt)
    c₁ = −6Rᵢ/(Rₒ(Rₒ − 3Rᵢ)),    c₂ = 3(Rₒ + Rᵢ)/(Rₒ²(Rₒ − 3Rᵢ)),    c₃ = −2/(Rₒ²(Rₒ − 3Rᵢ))

With Λr = 1 + u′, Λθ = 1 + u/R and P = μ(Λ − 1/Λ) of either,

    b = −(cπ)² u − (μ (1 + 1/Λr²) u″ + (Pr − Pθ)/R)/ρ    along the radius.

Source: Kamojjala, Brannon, Sadeghirad and Guilkey (2015), Verification tests in solid mechanics,
Eng. Comput. 31, 193–213. The ring is the quarter between two planes of symmetry.
"""

from dataclasses import dataclass
from math import ceil, cos, pi, sin
from typing import ClassVar

import numpy as np

from mpmgeo.verify.problem import Problem, plane_strain, sector


@dataclass(frozen=True)
class Ring(Problem):
    """Ring of the radii `inner` and `outer` [m]; `amplitude` [m], `speed` c [1/s]."""

    name: ClassVar[str] = "ring"
    time: ClassVar[float] = 0.02
    length: ClassVar[float] = 0.2  # across the ring

    young: float = 1e7
    poisson: float = 0.0
    density: float = 1e3
    amplitude: float = 0.1
    speed: float = 100.0
    inner: float = 0.4
    outer: float = 0.6

    @property
    def fastest(self) -> float:
        """Return the largest speed of a particle [m/s], that of the inner edge."""
        return self.speed * pi * float(self._profile(self.inner)[0])

    def case(self, cell: float, particles: int) -> dict:
        """Return the case but for its step; `cell` [m]."""
        side = cell * (ceil((self.outer + self.amplitude) / cell - 1e-9) + 3)
        symmetry = dict.fromkeys(("plane_X0", "plane_Y0"), "sliding")
        return {
            "title": f"Expanding ring, {self.length / cell:.0f} cells across",
            "gravity": [0, 0, 0],
            "mesh": plane_strain(cell, (0.0, 0.0), (side, side), **symmetry),
            "materials": [self.material("neo-hookean")],
            "body": [sector(self.inner, self.outer, pi / 2, cell, particles)],
        }

    def displacement(self, X: np.ndarray, t: float) -> np.ndarray:
        """Return the displacement (n, 3) [m] of the points X (n, 3) [m] at time t [s]."""
        R, E_r = _polar(X)
        return sin(self.speed * pi * t) * self._profile(R)[0] * E_r

    def velocity(self, X: np.ndarray, t: float) -> np.ndarray:
        """Return the velocity (n, 3) [m/s] of the points X (n, 3) [m] at time t [s]."""
        R, E_r = _polar(X)
        ω = self.speed * pi
        return ω * cos(ω * t) * self._profile(R)[0] * E_r

    def gradient(self, X: np.ndarray, t: float) -> np.ndarray:
        """Return the deformation gradient (n, 3, 3) at the points X (n, 3) [m] at time t [s]."""
        R, E_r = _polar(X)
        u, slope, _ = (sin(self.speed * pi * t) * f[:, :, None] for f in self._profile(R))
        radial = E_r[:, :, None] * E_r[:, None, :]
        flat = np.diag([1.0, 1.0, 0.0])
        return np.eye(3) + slope * radial + u / R[:, :, None] * (flat - radial)

    def body_force(self, t: float, X: np.ndarray) -> np.ndarray:
        """Return the acceleration (n, 3) [m/s²] that the motion needs."""
        R, E_r = _polar(X)
        ω, μ = self.speed * pi, self.lame[1]
        u, slope, curvature = (sin(ω * t) * f for f in self._profile(R))
        Λr, Λθ = 1 + slope, 1 + u / R
        turn = (μ * (Λr - 1 / Λr) - μ * (Λθ - 1 / Λθ)) / R
        return (-(ω**2) * u - (μ * (1 + 1 / Λr**2) * curvature + turn) / self.density) * E_r

    def _profile(self, R):
        """Return the largest displacement and its first two derivatives by R."""
        a, b = self.inner, self.outer
        k = self.amplitude / (b**2 * (b - 3 * a))
        c1, c2, c3 = -6 * a * b * k, 3 * (a + b) * k, -2 * k
        return (
            c3 * R**3 + c2 * R**2 + c1 * R,
            3 * c3 * R**2 + 2 * c2 * R + c1,
            6 * c3 * R + 2 * c2,
        )


def _polar(X):
    """Return R (n, 1) and the unit vectors along the radius (n, 3)."""
    R = np.hypot(X[:, :1], X[:, 1:2])
    return R, np.pad(X[:, :2] / R, ((0, 0), (0, 1)))
