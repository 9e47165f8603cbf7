"""Saturated materials: the fluid in their pores, what holds it back, and the waves of both phases.

    c = m_f n g₀/k,   n = m_f/(ρ_f V)                 drag on the fluid of a particle, Darcy's law
    c² = ½ (a + √(a² − 4b)),   a = (M + (1 − n)² K/n)/ρ₁ + n K/ρ₂,   b = M n K/(ρ₁ ρ₂)

k: hydraulic conductivity, g₀: acceleration in the unit weight ρ_f g₀ that belongs to it, K: bulk
modulus of the fluid, M: stiffness of the dry skeleton without lateral strain, ρ₁ = (1 − n) ρ_s and
ρ₂ = n ρ_f. c is the faster wave where no drag ties the phases together; drag only makes it slower.

Source: Biot (1956), J. Acoust. Soc. Am. 28, 168–178, for grains that do not change their volume.
"""

from math import inf, sqrt
from typing import NamedTuple

from mpmgeo.values import is_usable

KEYS = ("density_fluid", "porosity", "bulk_fluid", "hydraulic_conductivity")
"""Keys of a material that only two phases need."""


class Symbols(NamedTuple):
    """Bulk modulus [Pa] and densities [kg/m³] of fluid and grains; g₀/(k ρ) along x, y, z."""

    K: float
    ρ: float
    ρs: float
    dx: float
    dy: float
    dz: float


def pore_fluid(law, gravity: float) -> Symbols:
    """Return what kernels need of a law's fluid; `gravity`: that of its unit weight [m/s²]."""
    drags = (gravity / (k * law.density_fluid) for k in law.hydraulic_conductivity)
    return Symbols(law.bulk_fluid, law.density_fluid, law.density, *drags)


def densities(law) -> tuple[float, float]:
    """Return the masses of solid and of fluid in a volume of the mixture [kg/m³]."""
    return (1 - law.porosity) * law.density, law.porosity * law.density_fluid


def wave_speed(law) -> float:
    """Return the speed of the faster compression wave [m/s]."""
    return sqrt(_fastest(law, law.density * law.sound_speed() ** 2, law.bulk_fluid))


def frequency(law, slopes, smooth: bool, shared: bool = False, drag: float = 0.0) -> float:
    """Return ω² [1/s²] of motions with the `slopes` of `mpm.stability`, K Σ in the place of K.

    `smooth`, `shared`: whether the particles of a cell share their pressure, their volume strain;
    `drag`: rate of the drag times the step, which divides accelerations of the phases against each
    other by 1 + drag.
    """
    Σ = slopes.mean_divergence if smooth else slopes.divergence
    return _fastest(law, law.resistance(slopes, shared)[0], law.bulk_fluid * Σ, 1 / (1 + drag))


def drag_rate(law, gravity: float) -> float:
    """Return the least rate [1/s] at which drag brings the phases together; see `pore_fluid`."""
    ρ1, ρ2 = densities(law)
    c = law.porosity * ρ2 * gravity / max(law.hydraulic_conductivity)
    return c / ρ1 + c / ρ2


def _fastest(law, M, K, θ=1.0):
    """Return c² of the faster wave for the stiffness M of the skeleton and K of the fluid.

    `θ`: share that drag leaves of what accelerates the phases against each other.
    """
    n, (ρ1, ρ2) = law.porosity, densities(law)
    both = (1 - θ) / (ρ1 + ρ2)
    w1, w2 = θ / ρ1 + both, θ / ρ2 + both
    a = w1 * (M + (1 - n) ** 2 * K / n) + w2 * n * K + 2 * both * (1 - n) * K
    b = (w1 * w2 - both * both) * M * n * K
    return (a + sqrt(max(a * a - 4 * b, 0.0))) / 2


def problem(law, gravity: float) -> str | None:
    """Return what is wrong if a law with its fluid cannot be calculated with; see `pore_fluid`."""
    try:
        numbers = (wave_speed(law), *densities(law), *pore_fluid(law, gravity))
    except (ZeroDivisionError, OverflowError):
        numbers = (inf,)
    if all(map(is_usable, numbers)):
        return None
    return "grains, pores and fluid make no usable wave speed, density or drag"


def critical_time_step(law, cell: float, speed: float) -> float:
    """Return the time [s] of a wave across a `cell` [m], particles moving at `speed` [m/s].

    Not longer than that of the law by itself, of the dry skeleton.
    """
    return min(law.critical_time_step(cell, speed), cell / (wave_speed(law) + speed))
