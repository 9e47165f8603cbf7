"""What every material law declares, and what it gives to the kernels: the update of one point."""

from collections.abc import Iterator
from dataclasses import dataclass
from math import inf
from typing import ClassVar, NamedTuple

from mpmgeo.materials.hyperelastic import is_hyperelastic
from mpmgeo.materials.rotation import objective_rate
from mpmgeo.numerics.dispatch import generic
from mpmgeo.parameters import Vector, parameter
from mpmgeo.values import is_usable


class Moduli(NamedTuple):
    """How stiff and viscous a law is at its stiffest: λ, 2G [Pa], η [Pa s]."""

    λ: float
    G2: float
    η: float = 0.0


@dataclass(frozen=True)
class Law:
    """A material; laws add their parameters, `symbols` and `sound_speed()`.

    `is_fluid`: whether it has no pores, and at rest the same pressure in all directions.
    """

    is_fluid: ClassVar[bool] = False

    id: int = parameter("Number by which bodies refer to the material")
    density: float = parameter(
        "Initial density; with two phases that of the grains", unit="kg/m³", above=0
    )
    objective_rate: str = objective_rate("none")
    k0: float | None = parameter(
        "Horizontal over vertical effective stress with initial_stress; absent: that of all "
        "materials, or what the law has by itself",
        above=0,
        default=None,
    )
    density_saturated: float | None = parameter(
        "Density below the water table of initial_stress, with one phase; absent: `density`",
        unit="kg/m³",
        above=0,
        default=None,
    )
    density_fluid: float | None = parameter(
        "Density of the pore fluid; required with two phases", unit="kg/m³", above=0, default=None
    )
    porosity: float | None = parameter(
        "Initial share of the pores; required with two phases", above=0, below=1, default=None
    )
    bulk_fluid: float | None = parameter(
        "Bulk modulus of the pore fluid; required with two phases", unit="Pa", above=0, default=None
    )
    hydraulic_conductivity: Vector | None = parameter(
        "Hydraulic conductivity along x, y, z; required with two phases",
        unit="m/s",
        above=0,
        default=None,
    )

    def problems(self) -> Iterator[tuple[str, str]]:
        """Yield (key, message) if the material has no wave speed that can be calculated with."""
        try:
            speed = self.sound_speed()
        except (ZeroDivisionError, OverflowError):
            speed = inf
        if not (is_usable(self.density) and is_usable(speed)):
            yield "density", f"{self.density:g} kg/m³ and the stiffness make no usable wave speed"
        if self.density_saturated is not None and self.density_saturated < self.density:
            message = f"{self.density_saturated:g} kg/m³ is less than density, {self.density:g}"
            yield "density_saturated", f"{message}; water adds to it"

    @property
    def k0_at_rest(self) -> float:
        """Return horizontal over vertical effective stress at rest: of a law that is silent, 1."""
        return 1.0

    def k0_range(self, vertical: float) -> tuple[float, float]:
        """Return which k0 the law can bear under a vertical effective stress [Pa], above 0."""
        return -inf, inf

    @property
    def symbols_as_mpm_geomechanics(self):
        """Return the symbols of the law as the program MPM-Geomechanics has it."""
        return self.symbols

    @property
    def moduli(self) -> Moduli:
        """Return what limits the time step: of a law that does not say, as if it were a fluid."""
        return Moduli(self.density * self.sound_speed() ** 2, 0.0)

    def resistance(self, slopes, shared=False) -> tuple[float, float]:
        """Return ω² ρ [Pa/m²] and d ρ [Pa s/m²] of motions with the `slopes` of `mpm.stability`.

        `shared`: whether the particles of a cell share their volume strain.
        """
        λ, G2, η = self.moduli
        Σ = slopes.mean_divergence if shared else slopes.divergence
        return max(λ, 0.0) * Σ + G2 * slopes.gradient, 2 * η * slopes.deviator

    def critical_time_step(self, cell: float, speed: float) -> float:
        """Return the time [s] of a wave across a `cell` [m], particles moving at `speed` [m/s]."""
        return cell / (self.sound_speed() + speed)

    def stiffening(self, volume, F) -> float:
        """Return by how much ω² of the stiffest particle exceeds what it was at the start, ≥ 1.

        `volume` (n,): V/V₀; F (n, 9): deformation gradients, or None. Stiffness V M of a particle
        goes with its volume, where the law's moduli M are constant.
        """
        return float(volume.max(initial=1.0))


@generic
def update_stress(law, stress, strain, state, dt):
    """Return the new effective stress and state of one point, one flat tuple.

    `law`: NamedTuple of the law's symbols. `stress`, `strain`: old stress [Pa] and strain increment
    [-], six components xx yy zz xy yz xz, shear as tensor components, tension positive. `state`:
    the law's own variables in the order of its `STATE`, an empty tuple without any. `dt`: time
    step [s].
    """


@generic
def strain_energy(law, stress):
    """Return the elastic energy in a unit of volume under a stress (6,), [J/m³].

    Only laws with an elastic part have one; all the work on another counts as dissipated.
    """


@strain_energy.register(tuple)
def no_strain_energy(law, stress):
    return 0.0


def stores_energy(law) -> bool:
    """Tell whether the law of some symbols says what elastic energy a stress means."""
    return is_hyperelastic(law) or strain_energy.find(type(law)) is not no_strain_energy
