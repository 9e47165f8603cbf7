"""The generalised vortex: circles of a neo-Hookean ring turn against each other and back.

    α = A sin(πt/T) (1 − 8s² + 16s⁴),    s = (R − 1)/(Rᵢ − Rₒ),    Rᵢ ≤ R ≤ Rₒ

A point turns by the angle α about the centre, so that J = 1 and the displacement, strain and stress
of both edges, which are free, vanish. With e_r and e_θ those of the turned point,

    b = (−R α̇² + μ/ρ R α′²) e_r + (R α̈ − μ/ρ (3α′ + R α″)) e_θ.

Source: Brannon, Kamojjala and Sadeghirad (2011), Establishing credibility of particle methods
through verification testing, Particle-Based Methods II (Particles 2011).
"""

from dataclasses import dataclass
from math import cos, pi, sin
from typing import ClassVar

import numpy as np

from mpmgeo.verify.problem import Problem, plane_strain, sector


@dataclass(frozen=True)
class Vortex(Problem):
    """Ring of the radii `inner` and `outer` [m] whose middle turns by `amplitude` [rad]."""

    name: ClassVar[str] = "vortex"
    time: ClassVar[float] = 1.0
    length: ClassVar[float] = 0.5  # across the ring

    young: float = 1e3
    poisson: float = 0.3
    density: float = 1e3
    amplitude: float = 1.0
    inner: float = 0.75
    outer: float = 1.25

    @property
    def fastest(self) -> float:
        """Return the largest speed of a particle [m/s], nearly in the middle of the ring."""
        return self.amplitude * pi / self.time * (self.inner + self.outer) / 2

    def case(self, cell: float, particles: int) -> dict:
        """Return the case but for its step; `cell` [m]."""
        reach = self.outer + 2 * cell
        return {
            "title": f"Generalised vortex, {self.length / cell:.0f} cells across the ring",
            "gravity": [0, 0, 0],
            "mesh": plane_strain(cell, (-reach, -reach), (reach, reach)),
            "materials": [self.material("neo-hookean")],
            "body": [sector(self.inner, self.outer, 2 * pi, cell, particles)],
        }

    def displacement(self, X: np.ndarray, t: float) -> np.ndarray:
        """Return the displacement (n, 3) [m] of the points X (n, 3) [m] at time t [s]."""
        R, e_r, _ = self._turned(X, t)
        u = R * e_r - X
        u[:, 2] = 0.0
        return u

    def velocity(self, X: np.ndarray, t: float) -> np.ndarray:
        """Return the velocity (n, 3) [m/s] of the points X (n, 3) [m] at time t [s]."""
        R, _, e_θ = self._turned(X, t)
        return self._rate(t, 1) * self._profile(R)[0] * R * e_θ

    def gradient(self, X: np.ndarray, t: float) -> np.ndarray:
        """Return the deformation gradient (n, 3, 3) at the points X (n, 3) [m] at time t [s]."""
        R, e_r, e_θ = self._turned(X, t)
        E_r = np.pad(X[:, :2] / R, ((0, 0), (0, 1)))
        E_θ = np.stack([-E_r[:, 1], E_r[:, 0], E_r[:, 2]], axis=1)
        E_z = np.broadcast_to([0.0, 0.0, 1.0], X.shape)
        sheared = e_r + R * self._rate(t, 0) * self._profile(R)[1] * e_θ
        pairs = ((sheared, E_r), (e_θ, E_θ), (E_z, E_z))
        return sum(a[:, :, None] * b[:, None, :] for a, b in pairs)

    def body_force(self, t: float, X: np.ndarray) -> np.ndarray:
        """Return the acceleration (n, 3) [m/s²] that the motion needs."""
        R, e_r, e_θ = self._turned(X, t)
        h, slope, curvature = self._profile(R)
        g, rate, acceleration = (self._rate(t, order) for order in range(3))
        k = self.lame[1] / self.density
        along = -R * (rate * h) ** 2 + k * R * (g * slope) ** 2
        across = R * acceleration * h - k * g * (3 * slope + R * curvature)
        return along * e_r + across * e_θ

    def _turned(self, X, t):
        """Return R (n, 1), and the unit vectors e_r and e_θ (n, 3) of the turned points."""
        R = np.hypot(X[:, :1], X[:, 1:2])
        φ = np.arctan2(X[:, 1:2], X[:, :1]) + self._rate(t, 0) * self._profile(R)[0]
        c, s, zero = np.cos(φ), np.sin(φ), 0 * φ
        return R, np.hstack([c, s, zero]), np.hstack([-s, c, zero])

    def _rate(self, t, order):
        """Return A sin(πt/T) or one of its first two derivatives in time."""
        ω = pi / self.time
        angle = ω * t
        return self.amplitude * (sin(angle), ω * cos(angle), -(ω**2) * sin(angle))[order]

    def _profile(self, R):
        """Return 1 − 8s² + 16s⁴ and its first two derivatives by R; its edges are at rest."""
        k = 1 / (self.inner - self.outer)
        s = np.clip((R - (self.inner + self.outer) / 2) * k, -0.5, 0.5)
        return 1 - 8 * s**2 + 16 * s**4, k * (64 * s**3 - 16 * s), k**2 * (192 * s**2 - 16)
