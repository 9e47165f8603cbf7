"""Newmark's explicit method, a predictor and a corrector, with accelerations on the particles.

In the paper's form, with α = 1 − γ, stresses between the strain and the force of a',

    ṽ = Σ S m (v + α Δt a) / Σ S m,    Δε = Δt sym Σ ṽ ⊗ ∇S,    a' = f/m
    v ← v + Δt a',    x ← x + Δt Σ S (ṽ + γ Δt a') + ½ Δt² a'

and in that of central differences

    Δu = Σ S m (Δt v + ½ Δt² a) / Σ S m,    Δε = sym Σ Δu ⊗ ∇S,    a' = f/m
    v ← v + α Δt a + γ Δt a',    x ← x + Σ S Δu

The first strains with velocities ahead of those of a leapfrog by α Δt a: it damps a vibration of
frequency ω by ½ α ωΔt of the critical damping, and bears ωΔt = 2/√(3 − 2γ). The second damps
nothing with γ = ½, and bears ωΔt = √(2/γ); with γ = 1 it is the first with γ = ½. Nodes make whole
steps, so that what contact and tools ask of them reaches the particles.

Source: Molinos, Navas, Pastor and Martín Stickle (2021), Comput. Methods Appl. Mech. Engrg 374,
113567, for the first.
"""

from dataclasses import dataclass
from typing import ClassVar

from mpmgeo.parameters import parameter


@dataclass(frozen=True)
class NewmarkNumbers:
    """The numbers of the schemes NPC and NPC-CD."""

    gamma: float = parameter(
        "Share of the new acceleration in the velocity", above=0, maximum=1, default=0.5
    )


@dataclass(frozen=True)
class Newmark:
    """What both forms have in common. `γ`: share of the new acceleration in the velocity."""

    γ: float = 0.5

    def with_numbers(self, numbers):
        """Return the scheme with the numbers of a case."""
        return type(self)(numbers.gamma)


@dataclass(frozen=True)
class PredictorCorrector(Newmark):
    """The paper's form."""

    @property
    def longest(self):
        """Return the largest (ω Δt)² of a vibration that it bears."""
        return 4.0 / (3.0 - 2.0 * self.γ)

    def __call__(self, s, h):
        """Make a step; h is the whole step."""
        s.predict((1.0 - self.γ) * h)
        s.update_velocity(after=False)
        s.strain_and_force()
        s.update_momentum(h)
        s.correct(h, 0.0, h, (self.γ - 0.5) * h * h)


@dataclass(frozen=True)
class CentralDifferences(Newmark):
    """The form of central differences."""

    least: ClassVar[float] = 0.5  # γ, below which it diverges

    @property
    def longest(self):
        """Return the largest (ω Δt)² of a vibration that it bears."""
        return 2.0 / self.γ if self.γ >= self.least else 0.0

    def __call__(self, s, h):
        """Make a step; h is the whole step."""
        s.predict(0.5 * h)
        s.update_velocity(after=False)
        s.strain_and_force()
        s.update_momentum(h)
        s.correct(h, (1.0 - self.γ) * h, self.γ * h, -h * h)
