"""Hooke's law against formulas of textbooks, in other constants than the file uses."""

from math import sqrt

import numpy as np
import pytest
from numba import njit

from mpmgeo.materials.elastic import Elastic
from mpmgeo.materials.law import update_stress

E, ν, ρ = 2.0e7, 0.3, 1800.0
SOIL = Elastic(id=3, density=ρ, young=E, poisson=ν)
ZERO = 6 * (0.0,)


def stress_of(strain, law=SOIL.symbols, stress=ZERO):
    return np.array(update_stress(law, stress, tuple(strain), (), 1e-3))


def test_uniaxial_strain():
    M = E * (1 - ν) / ((1 + ν) * (1 - 2 * ν))
    side = M * ν / (1 - ν)
    expected = 1e-3 * np.array([side, M, side, 0, 0, 0])
    assert stress_of([0, 1e-3, 0, 0, 0, 0]) == pytest.approx(expected, rel=1e-13)


def test_uniaxial_stress():
    """Stretched along x, with the sides free to contract."""
    assert stress_of([1e-3, -ν * 1e-3, -ν * 1e-3, 0, 0, 0]) == pytest.approx(
        [E * 1e-3, 0, 0, 0, 0, 0], abs=1e-9 * E
    )


@pytest.mark.parametrize("component", [3, 4, 5])
def test_shear_is_a_tensor_component(component):
    """γ = 2 ε, so τ = G γ = 2 G ε."""
    strain = np.zeros(6)
    strain[component] = 1e-3
    expected = np.zeros(6)
    expected[component] = E / (1 + ν) * 1e-3
    assert stress_of(strain) == pytest.approx(expected, rel=1e-13)


def test_increments_add_up_to_the_old_stress():
    old = np.array([1.0, -2.0, 3.0, 4.0, -5.0, 6.0]) * 1e3
    strain = np.array([1.0, 2.0, -3.0, 0.5, -0.25, 2.0]) * 1e-4
    assert stress_of(strain, stress=tuple(old)) == pytest.approx(old + stress_of(strain), rel=1e-13)


def test_compiled_and_python_agree():
    @njit
    def compiled(law, stress, strain):
        return update_stress(law, stress, strain, (), 1e-3)

    strain = (1e-3, -2e-3, 5e-4, 3e-4, -4e-4, 7e-4)
    old = (1e4, 2e4, 3e4, 4e4, 5e4, 6e4)
    assert compiled(SOIL.symbols, old, strain) == pytest.approx(
        stress_of(strain, stress=old), rel=1e-14
    )


def test_sound_speed():
    assert SOIL.sound_speed() == pytest.approx(sqrt(E * (1 - ν) / ((1 + ν) * (1 - 2 * ν) * ρ)))


def test_auxetic_material():
    law = Elastic(id=1, density=1.0, young=1.0, poisson=-0.5)
    assert stress_of([1e-3, 0.5e-3, 0.5e-3, 0, 0, 0], law.symbols) == pytest.approx(
        [1e-3, 0, 0, 0, 0, 0], abs=1e-15
    )
