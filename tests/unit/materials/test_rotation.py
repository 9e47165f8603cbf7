"""Objective rates: old stress turns with the material, as exactly as its rate says."""

from math import cos, pi, sin

import numpy as np
import pytest
from numba import njit

from mpmgeo.materials import LAWS
from mpmgeo.materials.rotation import (
    ROTATIONS,
    HughesWinget,
    Jaumann,
    increments,
    rotate_stress,
)

VOIGT = [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2)]
STRESS = np.array([-3.0, 1.0, 2.0, 0.5, -1.5, 0.7]) * 1e5


def full(σ):
    out = np.zeros((3, 3))
    for (i, j), value in zip(VOIGT, σ, strict=True):
        out[i, j] = out[j, i] = value
    return out


def six(σ):
    return np.array([σ[i, j] for i, j in VOIGT])


def spin(w):
    """Return W_xy, W_yz, W_xz and the matrix W of a rotation vector."""
    W = np.array([[0, -w[2], w[1]], [w[2], 0, -w[0]], [-w[1], w[0], 0]])
    return (W[0, 1], W[1, 2], W[0, 2]), W


def turned_about_z(angle, σ=STRESS):
    Q = np.array([[cos(angle), -sin(angle), 0], [sin(angle), cos(angle), 0], [0, 0, 1]])
    return six(Q @ full(σ) @ Q.T)


def rotated(rotation, angle, steps):
    """Return the stress after a turn about z in steps."""
    σ = tuple(STRESS)
    for _ in range(steps):
        σ = rotate_stress(rotation, σ, spin([0, 0, angle / steps])[0])
    return np.array(σ)


@pytest.mark.parametrize("seed", range(5))
def test_formulas(seed):
    w = np.random.default_rng(seed).normal(size=3)
    components, W = spin(w)
    σ = full(STRESS)
    jaumann = rotate_stress(Jaumann(), tuple(STRESS), components)
    assert np.array(jaumann) == pytest.approx(six(σ + W @ σ + σ @ W.T), rel=1e-13)
    R = np.linalg.solve(np.eye(3) - W / 2, np.eye(3) + W / 2)
    hughes_winget = rotate_stress(HughesWinget(), tuple(STRESS), components)
    assert np.array(hughes_winget) == pytest.approx(six(R @ σ @ R.T), rel=1e-12)


def parts(L):
    """Return the six components of the symmetric part of L, and xy, yz, xz of the other."""
    W = (L - L.T) / 2
    return tuple(six((L + L.T) / 2)), (W[0, 1], W[1, 2], W[0, 2])


@pytest.mark.parametrize("seed", range(5))
def test_gradient_in_the_middle_of_the_step(seed):
    L = 0.3 * np.random.default_rng(seed).normal(size=(3, 3))
    G = L @ np.linalg.inv(np.eye(3) + L / 2)
    for found, expected in zip(increments(HughesWinget(), *parts(L)), parts(G), strict=True):
        assert found == pytest.approx(expected, rel=1e-13, abs=1e-15)


def test_other_rates_take_the_gradient_as_it_is():
    strain, spin = parts(np.random.default_rng(0).normal(size=(3, 3)))
    for rotation in (None, Jaumann()):
        assert increments(rotation, strain, spin) == (strain, spin)


def test_a_whole_turn_in_steps_of_rigid_turns():
    """Displacements of a rigid turn strain nothing and turn the stress exactly."""
    axis = np.array([1.0, -2.0, 2.0]) / 3
    W = spin(axis * 2 * pi / 100)[1]
    angle = 2 * pi / 100
    R = np.eye(3) + sin(angle) / angle * W + (1 - cos(angle)) / angle**2 * W @ W
    σ, expected = tuple(STRESS), full(STRESS)
    for _ in range(100):
        strain, turn = increments(HughesWinget(), *parts(R - np.eye(3)))
        assert np.abs(strain).max() < 1e-16
        σ, expected = rotate_stress(HughesWinget(), σ, turn), R @ expected @ R.T
        assert np.array(σ) == pytest.approx(six(expected), rel=1e-11)
    assert np.array(σ) == pytest.approx(STRESS, rel=1e-11)


def test_compiled_and_python_agree():
    def both(rotation, stress, strain, spin):
        strain, spin = increments(rotation, strain, spin)
        return rotate_stress(rotation, stress, spin) + strain

    values = tuple(STRESS), (0.1, 0.2, -0.1, 0.3, 0.1, -0.2), (0.1, -0.2, 0.3)
    for rotation in ROTATIONS.values():
        expected = both(rotation, *values)
        assert njit(both)(rotation, *values) == pytest.approx(expected, rel=1e-13)


def test_none_leaves_the_stress():
    assert rotate_stress(None, tuple(STRESS), (1.0, 2.0, 3.0)) == tuple(STRESS)


@pytest.mark.parametrize(
    ("word", "order"), [("jaumann", 1), ("hughes-winget", 2)], ids=["jaumann", "hughes-winget"]
)
def test_order_of_a_rigid_turn(word, order):
    """A quarter turn in more and more steps: the error falls with the order of the rate."""
    exact = turned_about_z(pi / 2)
    errors = [np.abs(rotated(ROTATIONS[word], pi / 2, n) - exact).max() for n in (100, 200, 400)]
    assert np.log2(errors[:-1]) - np.log2(errors[1:]) == pytest.approx(order, abs=0.05)
    assert errors[-1] < 1e-2 / 400 ** (order - 1) * np.abs(exact).max()


def test_hughes_winget_keeps_the_invariants():
    """Many large turns leave the principal stresses alone."""
    random = np.random.default_rng(0)
    σ = tuple(STRESS)
    for _ in range(1000):
        σ = rotate_stress(HughesWinget(), σ, tuple(random.normal(size=3)))
    before, after = (np.linalg.eigvalsh(full(s)) for s in (STRESS, σ))
    assert after == pytest.approx(before, rel=1e-12)


def test_jaumann_lets_the_deviator_grow():
    """The first-order form is kept for MPM-Geomechanics: the mean stays, a turn w adds ½(2w)²."""
    w = 1e-2
    σ = np.array(rotate_stress(Jaumann(), (1.0, -1.0, 0.0, 0.0, 0.0, 0.0), (-w, 0.0, 0.0)))
    assert σ[:3].sum() == pytest.approx(0.0, abs=1e-15)
    assert np.linalg.norm(full(σ)) / np.sqrt(2) == pytest.approx(np.sqrt(1 + (2 * w) ** 2))


@pytest.mark.parametrize("law", LAWS, ids=[law.__name__ for law in LAWS])
def test_every_law_can_choose(law):
    default = law.__dataclass_fields__["objective_rate"].default
    assert default == ("jaumann" if law.type == "mohr-coulomb" else "none")
    assert law.__dataclass_fields__["objective_rate"].metadata["choices"] == tuple(ROTATIONS)
