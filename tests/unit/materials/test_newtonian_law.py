"""Newtonian fluid: stress of MPM-Geomechanics' formulas, wave speed, stable time step."""

from dataclasses import replace
from math import sqrt

import numpy as np
import pytest

from mpmgeo.materials.newtonian import Newtonian
from mpmgeo.verify.element import Element

WATER = Newtonian(id=1, density=1000.0, viscosity=5.0, bulk=2.5e6)
DT = 1e-3


def flow(strain, stress=(0.0,) * 6, law=WATER):
    element = Element(law, stress=stress, time_step=DT)
    element.drive(strain)
    return element.stress


def test_compression():
    """Pressure by the bulk modulus, and viscous stress of the deviator of the strain rate."""
    ε = -1e-4
    p, τ = 2.5e6 * ε, 2 * 5.0 * ε / DT
    expected = [p - τ / 3, p - τ / 3, p + 2 * τ / 3, 0, 0, 0]
    assert flow([0, 0, ε, 0, 0, 0]) == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize("component", [3, 4, 5])
def test_shear(component):
    """τ = 2 μ D; nothing of the shear stress before is left."""
    strain = np.zeros(6)
    strain[component] = 1e-4
    stress = np.array([-7.0, -9.0, -11.0, 3.0, 4.0, 5.0])
    expected = np.array([-9.0, -9.0, -9.0, 0.0, 0.0, 0.0])
    expected[component] = 2 * 5.0 * 1e-4 / DT
    assert flow(strain, stress) == pytest.approx(expected, rel=1e-12)


def test_pressure_adds_up():
    once = flow([1e-4, 1e-4, 1e-4, 0, 0, 0])
    assert flow([1e-4, 1e-4, 1e-4, 0, 0, 0], once) == pytest.approx(2 * once, rel=1e-12)
    assert (once[:3] > 0).all(), "without a tensile strength there are no voids"


def test_tensile_strength_opens_and_closes_voids():
    """Beyond the strength strain makes void, and the same strain closes it before pressure."""
    element = Element(replace(WATER, viscosity=0.0, tensile=100.0), time_step=DT)
    ε = np.array([1e-4, 1e-4, 1e-4, 0, 0, 0])
    element.drive(ε)
    assert element.stress[:3] == pytest.approx([100.0] * 3)
    assert element.state == pytest.approx([3e-4 - 100.0 / 2.5e6])
    element.drive(-ε)
    assert element.stress[:3] == pytest.approx([0.0] * 3, abs=1e-9)
    assert element.state == pytest.approx([0.0], abs=1e-15)
    element.drive(-ε)
    assert element.stress[:3] == pytest.approx([-750.0] * 3)


def test_tensile_strength_changes_nothing_under_pressure():
    strain, stress = [-1e-4, 2e-5, -3e-5, 1e-5, 2e-5, 3e-5], [-900.0] * 3 + [0.0] * 3
    limited = flow(strain, stress, replace(WATER, tensile=0.0))
    assert limited == pytest.approx(flow(strain, stress), rel=1e-12)


def test_sound_speed():
    assert WATER.sound_speed() == pytest.approx(50.0)


def test_critical_time_step_without_viscosity():
    law = replace(WATER, viscosity=0.0)
    assert law.critical_time_step(0.1, 3.0) == pytest.approx(0.1 / 53.0)


def test_critical_time_step_of_a_thick_fluid():
    """3ρh²/(8μ): half the square of the cell over the diffusivity of compression, 4μ/(3ρ)."""
    law = replace(WATER, viscosity=1e7)
    expected = 3 * 1000.0 * 0.1**2 / (8 * 1e7)
    assert law.critical_time_step(0.1, 0.0) == pytest.approx(expected, rel=1e-3)


def test_critical_time_step_between():
    ξ = 4 * 5.0 / (3 * 1000.0 * 50.0 * 0.01)
    expected = 0.01 / 50.0 * (sqrt(1 + ξ**2) - ξ)
    assert WATER.critical_time_step(0.01, 0.0) == pytest.approx(expected, rel=1e-12)
