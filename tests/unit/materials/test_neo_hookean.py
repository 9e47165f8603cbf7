"""Neo-Hookean elasticity at a point against closed forms, for strains of any size."""

from math import cos, log, pi, sin

import numpy as np
import pytest

from mpmgeo.materials.elastic import Elastic
from mpmgeo.materials.hyperelastic import energy_of, stress_of
from mpmgeo.materials.neo_hookean import NeoHookean
from mpmgeo.verify.element import Element

RUBBER = NeoHookean(id=1, density=1000.0, young=1e6, poisson=0.3)
λ, μ = RUBBER.symbols
VOIGT = [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2)]


def stress(F, law=RUBBER):
    """Return the Cauchy stress (3, 3) [Pa] at a deformation gradient."""
    out = np.zeros((3, 3))
    for (i, j), value in zip(VOIGT, stress_of(law.symbols, tuple(np.ravel(F))), strict=True):
        out[i, j] = out[j, i] = value
    return out


@pytest.mark.parametrize("stretch", [0.2, 0.7, 1.0, 1.5, 4.0])
def test_uniaxial_stretch(stretch):
    """P = μ (Λ − 1/Λ) without lateral strain for ν = 0; the area stays, so that σ = P."""
    law = NeoHookean(id=1, density=1.0, young=1e4, poisson=0.0)
    σ = stress(np.diag([1, 1, stretch]), law)
    assert σ[2, 2] == pytest.approx(5e3 * (stretch - 1 / stretch), rel=1e-14, abs=1e-10)
    assert np.abs(σ - np.diag([0, 0, σ[2, 2]])).max() < 1e-11


@pytest.mark.parametrize("stretch", [0.3, 0.9, 1.2, 3.0])
def test_equal_stretch_of_all_axes(stretch):
    J = stretch**3
    pressure = (λ * log(J) + μ * (stretch**2 - 1)) / J
    np.testing.assert_allclose(stress(stretch * np.eye(3)), pressure * np.eye(3), rtol=1e-13)


@pytest.mark.parametrize("γ", [1e-3, 0.5, 3.0])
def test_simple_shear(γ):
    """The shear stress is μ γ for shear of any size, the normal stress along it μ γ²."""
    σ = stress([[1, γ, 0], [0, 1, 0], [0, 0, 1]])
    exact = μ * np.array([[γ**2, γ, 0], [γ, 0, 0], [0, 0, 0]])
    np.testing.assert_allclose(σ, exact, rtol=1e-12, atol=1e-9)


def test_stress_is_the_derivative_of_the_energy():
    """J σ = ∂(J w)/∂F Fᵀ, by central differences."""
    F = np.eye(3) + np.random.default_rng(1).uniform(-0.3, 0.3, (3, 3))
    P, ε = np.zeros((3, 3)), 1e-6

    def energy(F):
        return np.linalg.det(F) * energy_of(RUBBER.symbols, tuple(F.ravel()))

    for i, j in np.ndindex(3, 3):
        E = np.zeros((3, 3))
        E[i, j] = ε
        P[i, j] = (energy(F + E) - energy(F - E)) / (2 * ε)
    np.testing.assert_allclose(P @ F.T / np.linalg.det(F), stress(F), rtol=0, atol=1e-8 * μ)


def test_a_full_turn_makes_no_stress():
    """A thousand steps of the motion of a rigid body, L Δt = R − I."""
    w, steps = 2 * pi / 1000, 1000
    c = steps * (cos(w) - 1)
    element = Element(RUBBER)
    path = element.drive([c, c, 0, 0, 0, 0], steps, spin=[steps * sin(w), 0, 0])
    assert np.abs(path.stress).max() < 1e-12 * RUBBER.young
    np.testing.assert_allclose(element.F, np.eye(3).ravel(), atol=1e-12)


def test_a_closed_path_leaves_no_stress():
    """Shear, stretch and the way back in other steps: stress is that of F, not of the path."""
    element = Element(RUBBER)
    element.drive([0.2, -0.1, 0, 0.3, 0, 0.1], steps=50, spin=[0.3, 0.1, 0])
    back = np.linalg.inv(element.F.reshape(3, 3)) - np.eye(3)
    strain, spin = (back + back.T) / 2, (back - back.T) / 2
    element.drive([strain[i, j] for i, j in VOIGT], spin=[spin[0, 1], spin[1, 2], spin[0, 2]])
    assert np.abs(element.stress).max() < 1e-12 * RUBBER.young


def test_a_laboratory_finds_the_lateral_stretch():
    """Uniaxial tension by stress control: lateral stresses vanish, as energy says."""
    element = Element(RUBBER)
    element.control(strain={"zz": 0.4}, stress={"xx": 0.0, "yy": 0.0}, steps=20)
    F = element.F.reshape(3, 3)
    J, lateral = np.linalg.det(F), F[0, 0]
    assert F[0, 0] == pytest.approx(F[1, 1], rel=1e-9)
    assert λ * log(J) + μ * (lateral**2 - 1) == pytest.approx(0, abs=1e-8 * μ)
    assert element.stress[2] == pytest.approx(stress(F)[2, 2], rel=1e-12)


def test_small_strains_are_those_of_hooke():
    hooke = Element(Elastic(id=1, density=1000.0, young=1e6, poisson=0.3))
    strain = 1e-6 * np.array([3, -1, 2, 1, -2, 1.5])
    hooke.drive(strain)
    element = Element(RUBBER)
    element.drive(strain)
    np.testing.assert_allclose(element.stress, hooke.stress, atol=1e-5 * abs(hooke.stress).max())
