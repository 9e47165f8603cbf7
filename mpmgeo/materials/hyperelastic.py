"""Laws whose stress follows from the deformation gradient F alone, not from its increments.

F leads from the positions at rest to those now, J = det F. The symbols of such a law say
`HYPERELASTIC = True`; then the particles keep F, and the law has `stress_of` and `energy_of` in the
place of `update_stress` and `strain_energy`.

Source: Holzapfel, Nonlinear Solid Mechanics (2000), section 6.1.
"""

from mpmgeo.numerics.dispatch import generic


def is_hyperelastic(law) -> bool:
    """Tell whether the law of some symbols wants the deformation gradient."""
    return getattr(law, "HYPERELASTIC", False)


@generic
def stress_of(law, F):
    """Return the effective Cauchy stress [Pa] at a deformation gradient, six components.

    `law`: NamedTuple of the law's symbols. `F`: xx xy xz yx yy yz zx zy zz [-].
    """


@generic
def energy_of(law, F):
    """Return the elastic energy in a unit of the deformed volume [J/m³]."""
