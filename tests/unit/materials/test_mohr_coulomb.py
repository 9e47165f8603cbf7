"""Mohr–Coulomb: return against Koiter's rule, a million trial states, equal stresses, strengths."""

from dataclasses import replace
from math import exp, inf, pi, radians, sin, sqrt, tan

import numpy as np
import pytest
from koiter import returns
from numba import njit

from mpmgeo.materials.mohr_coulomb import Constant, MohrCoulomb, Softening, Undrained, strength
from mpmgeo.materials.mohr_coulomb_return import return_to_surface
from mpmgeo.verify.element import Element, advance_points

SOIL = MohrCoulomb(
    id=1, density=2000.0, young=2e7, poisson=0.3, friction=30.0, cohesion=1e4, dilation=10.0
)
FULL = np.array([[0, 3, 5], [3, 1, 4], [5, 4, 2]])

LAWS = {
    "friction": SOIL,
    "associated": replace(SOIL, dilation=30.0),
    "no dilation": replace(SOIL, dilation=0.0),
    "no cohesion": replace(SOIL, cohesion=0.0),
    "no tension": replace(SOIL, tensile=0.0),
    "some tension": replace(SOIL, tensile=5e3),
    "no friction": replace(SOIL, friction=0.0, dilation=0.0, tensile=2e3),
    "Tresca": replace(SOIL, friction=0.0, dilation=0.0),
    "steep": replace(SOIL, friction=80.0, dilation=80.0, poisson=0.45),
    "auxetic": replace(SOIL, poisson=-0.5),
}
BY_LAW = pytest.mark.parametrize("law", LAWS.values(), ids=LAWS)


@njit
def compiled_return(s1, s2, s3, r, N, M, σc, T):
    return return_to_surface(s1, s2, s3, r, N, M, σc, T)


def parameters(law):
    """Return N, M, σc, T."""
    return strength(law.symbols, 0.0, 0.0)


def from_trial(law, trial, plastic=0.0):
    """Return stress (n, 6) and plastic strain (n,) that trial stresses (n, 6) return to."""
    n, names = len(trial), law.symbols.STATE
    stress, state = np.array(trial), np.zeros((n, len(names)))
    state[:, names.index("plastic_strain")] = plastic
    nothing = (np.zeros((n, 6)), np.zeros((n, 3)), np.ones(n))
    advance_points(law.symbols, None, *nothing, stress, state, 1.0)
    return stress, state[:, 0] - plastic


def excess(law, stress):
    """Return how far stresses (n, 6) are beyond the surface, relative to their size (n,)."""
    N, _, σc, T = parameters(law)
    s = np.linalg.eigvalsh(stress[:, FULL])
    size = np.abs(s).max(axis=1) + σc / N + 1e-12
    shear = (N * s[:, 2] - s[:, 0] - σc) / N
    return np.maximum(shear, s[:, 2] - T) / size


def trials(count, seed=0, scale=1e5):
    """Return trial stresses (n, 6) of all kinds, also with equal principal stresses."""
    random = np.random.default_rng(seed)
    stress = scale * random.normal(size=(count, 6)) * random.choice([0.1, 1, 10], (count, 1))
    stress[:, :3] += scale * random.choice([-10, -1, 0, 1, 10], (count, 1))
    stress[::5, 3:] = 0.0
    stress[::10, 1] = stress[::10, 0]
    stress[::20, 2] = stress[::20, 1]
    stress[1::10, 3:] *= 1e-9
    return stress


# The return


@pytest.mark.parametrize("seed", range(20))
def test_koiter(seed):
    """All surfaces tried in all combinations lead to one stress, that of the law."""
    random = np.random.default_rng(seed)
    for _ in range(40):
        φ, ν = random.uniform(0, 1.2), random.uniform(-0.9, 0.49)
        ψ = random.choice([0.0, φ, random.uniform(0, φ), random.uniform(0, 1)])
        N, M = ((1 + sin(angle)) / (1 - sin(angle)) for angle in (φ, ψ))
        σc = random.choice([0.0, 1.0, 5.0]) * sqrt(N)
        T = random.choice([1.0, 0.0, random.uniform()]) * σc / (N - 1)
        trial = np.sort(random.normal(size=3) * random.choice([1, 5, 20]) + random.uniform(-10, 5))
        if N * trial[2] - trial[0] <= σc and trial[2] <= T:
            continue
        found = compiled_return(*trial, ν / (1 - ν), N, M, σc, T)
        assert found[0] <= found[1] + 1e-12 and found[1] <= found[2] + 1e-12
        expected = [np.sort(σ) for σ in returns(trial, ν, N, M, σc, T)]
        assert expected
        size = np.abs(trial).max() + σc + T
        for σ in expected:
            assert np.array(found) == pytest.approx(σ, abs=1e-7 * size)


@BY_LAW
def test_a_million_states_are_admissible(law):
    """On the surface or inside to 1e-9 of its size, whatever the trial stress."""
    stress, plastic = from_trial(law, trials(1_000_000 // len(LAWS) + 1))
    assert np.isfinite(stress).all()
    assert (excess(law, stress) < 1e-12).all()
    assert (plastic >= 0).all() and (plastic > 0).mean() > 0.3


@BY_LAW
def test_only_states_beyond_the_surface_change(law):
    """What the cheap bound or the exact check calls elastic is so, and comes out bit for bit."""
    trial = trials(200_000, seed=1)
    stress, plastic = from_trial(law, trial)
    beyond = excess(law, trial)
    assert (plastic[beyond > 1e-12] > 0).all()
    same = (stress == trial).all(axis=1)
    assert same[beyond < -1e-12].all()
    assert not plastic[same].any()


@BY_LAW
def test_a_returned_state_stays(law):
    """The return is a projection: a second one does nothing."""
    once, _ = from_trial(law, trials(50_000, seed=2))
    twice, _ = from_trial(law, once)
    size = np.abs(once).max(axis=1, keepdims=True) + law.cohesion
    assert (np.abs(twice - once) <= 1e-11 * size).all()


@BY_LAW
def test_equal_principal_stresses_do_not_depend_on_round_off(law):
    """Round-off in the trial stress is round-off in the result, also where stresses are equal."""
    trial = trials(100_000, seed=3)
    noise = 1e-14 * np.random.default_rng(4).normal(size=trial.shape)
    size = np.abs(trial).max(axis=1, keepdims=True)
    stress, _ = from_trial(law, trial)
    noisy, _ = from_trial(law, trial + noise * size)
    assert (np.abs(noisy - stress) <= 1e-12 * (size + law.cohesion)).all()


def test_returned_stress_keeps_the_axes():
    trial = trials(2000, seed=5)
    stress, _ = from_trial(SOIL, trial)
    a, b = trial[:, FULL], stress[:, FULL]
    size = np.abs(a).max(axis=(1, 2), keepdims=True) * np.abs(b).max(axis=(1, 2), keepdims=True)
    assert (np.abs(a @ b - b @ a) <= 1e-12 * size).all()


def test_associated_return_is_the_nearest_point():
    """(σ − σ*)·C·(z − σ*) ≤ 0 for every admissible z: the projection in the energy norm."""
    law = replace(SOIL, dilation=30.0, tensile=8e3)
    trial = trials(500, seed=6)
    found, _ = from_trial(law, trial)
    others, _ = from_trial(law, trials(500, seed=7))
    strain = compliance(law, trial - found)
    strain[:, 3:] *= 2
    work = np.einsum("ni,mni->mn", strain, others[:, None] - found[None])
    size = np.abs(strain).max() * np.abs(others).max()
    assert work.max() <= 1e-9 * size


def compliance(law, stress):
    """Return the elastic strains (n, 6) of stresses."""
    E, ν = law.young, law.poisson
    strain = (1 + ν) / E * stress
    strain[:, :3] -= ν / E * stress[:, :3].sum(axis=1, keepdims=True)
    return strain


def test_plastic_strain_is_that_of_the_lost_stress():
    trial = trials(1000, seed=8)
    stress, plastic = from_trial(SOIL, trial)
    ε = compliance(SOIL, trial - stress)
    expected = np.sqrt(2 / 3 * ((ε[:, :3] ** 2).sum(axis=1) + 2 * (ε[:, 3:] ** 2).sum(axis=1)))
    assert plastic == pytest.approx(expected, rel=1e-6, abs=1e-12)


def test_flow_has_the_angle_of_dilation():
    """In plane strain sin ψ is volume strain over largest shear."""
    element = Element(SOIL, stress=(-1e5, -1e5, -1e5, 0, 0, 0))
    element.drive([0.02, 0, -0.02, 0, 0, 0], steps=200)
    before = element.stress
    increment = np.array([[1e-4, 0, -1e-4, 0, 0, 0]])
    element.drive(increment[0])
    flow = (increment - compliance(SOIL, (element.stress - before)[None]))[0]
    volume, shear = flow[:3].sum(), flow[0] - flow[2]
    assert volume / shear == pytest.approx(sin(radians(10)), rel=1e-6)


# Strengths


def test_symbols():
    assert type(SOIL.symbols) is Constant
    expected = 3.0, (1 + sin(pi / 18)) / (1 - sin(pi / 18)), 2e4 * sqrt(3), 1e4 / tan(pi / 6)
    assert parameters(SOIL) == pytest.approx(expected)


def test_tensile():
    """Absent: c/tan φ; 0 means 0; never beyond the apex; without friction no limit of its own."""
    apex = 1e4 / tan(pi / 6)
    for tensile, expected in ((None, apex), (0.0, 0.0), (5e3, 5e3), (1e5, apex)):
        assert parameters(replace(SOIL, tensile=tensile))[3] == pytest.approx(expected)
    assert parameters(replace(SOIL, friction=0.0))[3] == inf
    assert parameters(replace(SOIL, friction=0.0, tensile=0.0))[3] == 0.0


def test_softening():
    law = replace(
        SOIL,
        softening="exponential",
        eta=30.9,
        friction_residual=20.0,
        friction_active=True,
        cohesion_residual=1e3,
        cohesion_active=True,
        dilation_residual=0.0,
        dilation_active=True,
        tensile=4e3,
        tensile_residual=0.0,
        tensile_active=True,
    )
    assert type(law.symbols) is Softening
    for εp in (0.0, 0.01, 0.3, 10.0):
        w = exp(-30.9 * εp)
        N, M = ((1 + sin(radians(a))) / (1 - sin(radians(a))) for a in (20 + 10 * w, 10 * w))
        expected = N, M, 2 * (1e3 + 9e3 * w) * sqrt(N), 4e3 * w
        assert strength(law.symbols, 0.0, εp) == pytest.approx(expected, rel=1e-12, abs=1e-9)


def test_only_active_strengths_soften():
    law = replace(
        SOIL, softening="exponential", eta=50.0, cohesion_active=True, cohesion_residual=0.0
    )
    found = strength(law.symbols, 0.0, 100.0)
    assert found[:2] == pytest.approx(parameters(SOIL)[:2])
    assert found[2:] == pytest.approx((0.0, 0.0)), "the apex moves with the cohesion"


def test_residuals_that_are_not_given():
    """The peak value; for tension that is absent, 0, as in MPM-Geomechanics."""
    law = replace(SOIL, softening="exponential", eta=1.0, tensile_active=True, friction_active=True)
    assert strength(law.symbols, 0.0, 100.0)[3] == pytest.approx(0.0)
    assert strength(law.symbols, 0.0, 100.0)[0] == pytest.approx(3.0)
    law = replace(law, tensile=2e3)
    assert strength(law.symbols, 0.0, 100.0)[3] == pytest.approx(2e3)


def test_undrained():
    law = replace(SOIL, su_vertical_stress=0.25)
    assert type(law.symbols) is Undrained
    _, M, _, T = parameters(SOIL)
    assert strength(law.symbols, -8e4, 0.0) == pytest.approx((1.0, M, 4e4, T))
    assert strength(law.symbols, 1e4, 0.0)[2] == 0.0
    trial = trials(10_000, seed=9)
    stress, _ = from_trial(law, trial)
    s = np.linalg.eigvalsh(stress[:, FULL])
    cohesion = 0.25 * np.maximum(-trial[:, 2], 0.0)
    size = np.abs(trial).max(axis=1)
    assert (s[:, 2] - s[:, 0] <= 2 * cohesion + 1e-12 * size).all()


# As in MPM-Geomechanics


def test_old_return_leaves_corners_alone():
    """The example of that program's description: (−6, −2, −2) goes to (−4, −2, −4)."""
    law = MohrCoulomb(id=1, density=1.0, young=1e3, poisson=0.0, friction=0.0, cohesion=0.0)
    element = Element(law, stress=(-2, -2, -6, 0, 0, 0), as_mpm_geomechanics=True)
    element.drive(np.zeros(6))
    assert np.sort(np.linalg.eigvalsh(element.stress[FULL])) == pytest.approx([-4, -4, -2])
    proper = Element(law, stress=(-2, -2, -6, 0, 0, 0))
    proper.drive(np.zeros(6))
    assert proper.stress == pytest.approx([-10 / 3] * 3 + [0.0] * 3)


def test_old_tension():
    """0 means c/tan φ, and without friction it means 0."""
    for law, expected in (
        (replace(SOIL, tensile=0.0), 1e4 / tan(pi / 6)),
        (SOIL, 1e4 / tan(pi / 6)),
        (replace(SOIL, tensile=3e3), 3e3),
        (replace(SOIL, friction=0.0), 0.0),
    ):
        symbols = law.symbols_as_mpm_geomechanics
        assert symbols._asdict()["T"] == pytest.approx(expected)


def test_distinct_stresses_get_no_shear_in_the_old_return():
    """Equal ones are told apart by a small one: which of the two flows, no axis says."""
    flowing = Element(SOIL, [-1e5, -2.5e5, -9e5, 0, 0, 0], as_mpm_geomechanics=True)
    flowing.drive([1e-5, 0, -1e-5, 0, 0, 0])
    assert flowing.state[0] > 0
    assert not flowing.stress[3:].any()
    level = Element(SOIL, [-1e5, -1e5, -9e5, 0, 0, 0], as_mpm_geomechanics=True)
    level.drive([0, 0, -1e-5, 0, 0, 0])
    assert level.state[0] > 0
    assert level.stress[3:].any()


def test_both_returns_agree_on_planes():
    """Where the principal stresses stay apart the old return is the new one."""
    law = replace(SOIL, tensile=5e3)
    for stress in ([-1e5, -2.5e5, -4e5, 0, 0, 0], [8e3, 2e3, -5e3, 0, 0, 0]):
        new, old = Element(law, stress=stress), Element(law, stress, as_mpm_geomechanics=True)
        for element in (new, old):
            element.drive([1e-5, 2e-6, -1e-5, 3e-6, 0, 0])
        assert old.state[0] == pytest.approx(new.state[0], rel=1e-6)
        assert old.stress == pytest.approx(new.stress, abs=1e-3)
        assert new.state[0] > 0
