"""Cracks open at the tensile strength and close before pressure; volume without them is kept."""

from dataclasses import replace
from math import sqrt

import numpy as np
import pytest

from mpmgeo.materials.mohr_coulomb import MohrCoulomb
from mpmgeo.verify.element import Element, advance_points

T = 5e3
SOIL = MohrCoulomb(
    id=1, density=2e3, young=2e7, poisson=0.3, friction=30.0, cohesion=1e4, tensile=T
)
SAND = replace(SOIL, cohesion=0.0, tensile=0.0)
λ, G2 = SOIL.symbols.λ, SOIL.symbols.G2
STIFFNESS = λ + G2


def opening(element):
    return element.state[1]


def turned(stress):
    """Return the six components of a diagonal tensor on axes that are none of the mesh."""
    random = np.random.default_rng(5)
    Q, _ = np.linalg.qr(random.normal(size=(3, 3)))
    full = Q @ np.diag(stress) @ Q.T
    return full[[0, 1, 2, 0, 1, 0], [0, 1, 2, 1, 2, 2]]


@pytest.mark.parametrize(
    "axes", [lambda a: np.array([*a, 0, 0, 0]), turned], ids=["mesh", "turned"]
)
@pytest.mark.parametrize("steps", [1, 77])
def test_a_crack_opens_and_closes(axes, steps):
    """It bears T while open; what it was opened by closes it, and all is as before."""
    start = axes([0.0, -3e3, -1e4])
    element = Element(SOIL, stress=start)
    element.drive(axes([0.01, 0, 0]), steps=100)
    elastic = T / STIFFNESS
    assert opening(element) == pytest.approx(0.01 - elastic, rel=1e-12)
    assert element.stress == pytest.approx(axes([T, -3e3 + λ * elastic, -1e4 + λ * elastic]))
    plastic = element.state[0]
    assert plastic == pytest.approx(sqrt(2 / 3) * opening(element))
    element.drive(axes([-0.01 + elastic, 0, 0]), steps=steps)
    assert opening(element) == pytest.approx(0.0, abs=1e-15)
    element.drive(axes([-elastic, 0, 0]), steps=3)
    assert element.stress == pytest.approx(start, abs=1e-7)
    assert opening(element) == 0.0
    assert element.state[0] == pytest.approx(plastic), "what closes has not flown"


def test_pressure_along_a_crack_is_none_of_its_concern():
    element = Element(SOIL, stress=(0, 0, -5e3, 0, 0, 0))
    element.drive([0.01, 0, 0, 0, 0, 0], steps=10)
    before = element.stress
    element.drive([0, 0, -2e-4, 0, 0, 0], steps=7)
    change = element.stress - before
    assert change[0] == pytest.approx(0.0, abs=1e-7)
    assert change[2] == pytest.approx(-2e-4 * (STIFFNESS - λ * λ / STIFFNESS))
    assert change[1] == pytest.approx(-2e-4 * (λ - λ * λ / STIFFNESS))


def test_sand_bears_nothing_while_anything_is_open():
    """Wherever it was torn, pressure comes back when the volume does."""
    element = Element(SAND)
    element.drive([0.02, 0, 0, 0, 0, 0], steps=10)
    assert opening(element) == pytest.approx(0.02)
    element.drive([0, 0, -0.01, 0.003, 0, 0], steps=10)
    assert element.stress == pytest.approx(np.zeros(6), abs=1e-9)
    assert opening(element) == pytest.approx(0.01)
    element.drive([0, -0.005, -0.005, 0, 0, 0], steps=10)
    assert opening(element) == pytest.approx(0.0, abs=1e-15)
    element.drive([-1e-4] * 3 + [0, 0, 0])
    assert element.stress[:3] == pytest.approx(3 * [-3e-4 * (λ + G2 / 3)])


@pytest.mark.parametrize("law", [SOIL, SAND], ids=["soil", "sand"])
@pytest.mark.parametrize("dilation", [0.0, 10.0])
def test_strain_is_elastic_or_open_or_dilation(law, dilation):
    """tr ε = tr σ/(3K) + θ + dilation on any path; without an angle of it there is no dilation."""
    law = replace(law, dilation=dilation)
    random = np.random.default_rng(3)
    K = law.young / (3 * (1 - 2 * law.poisson))
    for _ in range(10):
        element, rest = Element(law), 0.0
        for _ in range(100):
            element.drive(random.normal(size=6) * random.choice([1e-5, 1e-4, 1e-3]))
            grown = element.strain[:3].sum() - element.stress[:3].sum() / (3 * K) - opening(element)
            assert grown >= rest - 1e-14 if dilation else abs(grown) < 1e-13
            rest = grown
        assert rest > 1e-3 or not dilation


def test_volume_without_openings():
    """V grows by what dilation and elasticity ask for, e^θ times that is the whole."""
    n, dilating = 500, replace(SAND, dilation=10.0)
    random = np.random.default_rng(8)
    V, stress, state = np.ones(n), np.zeros((n, 6)), np.zeros((n, 2))
    whole = np.ones(n)
    for _ in range(200):
        strain = random.normal(size=(n, 6)) * 1e-4 + np.array([1e-5, 1e-5, 1e-5, 0, 0, 0])
        advance_points(dilating.symbols, None, strain, np.zeros((n, 3)), V, stress, state, 1.0)
        whole *= 1 + strain[:, :3].sum(axis=1)
    assert (state[:, 1] > 1e-3).any()
    assert V * np.exp(state[:, 1]) == pytest.approx(whole, rel=1e-5)
    assert (whole > V).any()


def trials(count, seed):
    """Return stresses (n, 6) and openings (n,), many with equal principal stresses."""
    random = np.random.default_rng(seed)
    stress = 1e4 * random.normal(size=(count, 6)) * random.choice([0.1, 1, 10], (count, 1))
    stress[::3, 3:] = 0.0
    stress[::6, 1] = stress[::6, 0]
    stress[::12, 2] = stress[::12, 1]
    return stress, random.choice([1e-6, 1e-4, 1e-2, 1.0], count) * random.uniform(size=count)


def returned(law, stress, θ):
    n = len(θ)
    stress, state = np.array(stress), np.column_stack([np.zeros(n), θ])
    nothing = (np.zeros((n, 6)), np.zeros((n, 3)), np.ones(n))
    advance_points(law.symbols, None, *nothing, stress, state, 1.0)
    return stress, state[:, 1]


def test_open_states_are_admissible():
    """What is open bears the tensile strength, and nobody's stress is beyond the surface."""
    stress, θ = trials(200_000, seed=1)
    found, left = returned(SOIL, stress, θ)
    s = np.linalg.eigvalsh(found[:, [[0, 3, 5], [3, 1, 4], [5, 4, 2]]])
    size = np.abs(stress).max(axis=1) + STIFFNESS * θ
    assert (left >= 0).all()
    assert (3 * s[:, 2] - s[:, 0] - 2e4 * sqrt(3) <= 1e-12 * size).all()
    assert (s[:, 2] <= T + 1e-12 * size).all()
    assert (np.abs(s[:, 2] - T)[left > 0] <= 1e-12 * size[left > 0]).all()
    assert 0.1 < (left > 0).mean() < 0.9


def test_equal_stresses_share_what_is_open():
    """Round-off in the stresses is round-off in the result, also where they are equal."""
    stress, θ = trials(50_000, seed=2)
    noise = 1e-14 * np.random.default_rng(4).normal(size=stress.shape)
    size = np.abs(stress).max(axis=1, keepdims=True) + STIFFNESS * θ[:, None]
    found, left = returned(SOIL, stress, θ)
    noisy, also = returned(SOIL, stress + noise * size, θ)
    assert (np.abs(noisy - found) <= 1e-10 * size).all()
    assert (np.abs(also - left) <= 1e-10 * size[:, 0] / STIFFNESS + 1e-10 * θ).all()
