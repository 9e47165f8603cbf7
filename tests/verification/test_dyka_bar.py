"""The bar of Dyka and Ingel: known errors of many methods, and the paper's equations in 1D."""

import numpy as np
import pytest

import mpmgeo
from mpmgeo.verify.dyka_bar import GAUSS, DykaBar

BAR = DykaBar()
CELLS = (20, 40, 134)
# errors of velocity [m/s] with CELLS; independent results of the equations in one dimension
KNOWN = {
    ("USL", "linear"): (0.9270, 0.8173, 0.4942),
    ("MUSL", "linear"): (0.9865, 0.8458, 0.5367),
    ("NPC", "linear"): (0.8613, 0.7147, 0.4312),
    ("USF", "GIMP"): (0.9172, 0.9417, 0.5727),
    ("USL", "GIMP"): (0.9048, 0.8477, 0.5170),
    ("MUSL", "GIMP"): (0.9373, 0.9478, 0.5765),
    ("NPC", "GIMP"): (0.8516, 0.7253, 0.4470),
    ("NPC-CD", "GIMP"): (0.9269, 0.9445, 0.5744),
    ("USL", "LME"): (0.9650, 0.8790, 0.5173),
    ("NPC", "LME"): (0.8942, 0.7466, 0.4523),
}
QUICK = [("MUSL", "linear"), ("NPC", "LME"), *(pair for pair in KNOWN if pair[1] == "GIMP")]
WINDOWS = ((8.6e-6, 44.2e-6), (48.2e-6, 57.4e-6), (61.4e-6, 96.9e-6))
"""Times [s] in which the free end is at rest or moves steadily."""


def run(cells, scheme, shape, **keys):
    simulation = mpmgeo.Simulation(BAR.case(cells, scheme, shape, **keys))
    return simulation.step(round(BAR.time / simulation.time_step))


PAIRS = [pytest.param(*pair, marks=[pytest.mark.slow] * (pair not in QUICK)) for pair in KNOWN]


@pytest.mark.parametrize("scheme, shape", PAIRS)
def test_errors_are_those_known(scheme, shape):
    error, _ = BAR.errors(run(20, scheme, shape))
    assert error == pytest.approx(KNOWN[scheme, shape][0], rel=5e-3)


@pytest.mark.slow
@pytest.mark.parametrize("count", [1, 2])
@pytest.mark.parametrize("scheme, shape", KNOWN)
def test_errors_in_more_cells(scheme, shape, count):
    error, _ = BAR.errors(run(CELLS[count], scheme, shape))
    assert error == pytest.approx(KNOWN[scheme, shape][count], rel=5e-3)


def test_the_exact_solution():
    """Values at the ends and in the middle, and the energy, which stays what it was."""
    L, Z = BAR.length, BAR.density * BAR.wave_speed
    ends = np.array([0.0, L / 2, L])
    times = {3e-6: (-5, 0, 0), 10e-6: (0, -2.5, 0), 40e-6: (0, 2.5, 0), 55e-6: (5, 0, 0)}
    for time, expected in times.items():
        assert BAR.velocity_at(ends, time) == pytest.approx(np.array(expected), abs=1e-12)
    assert BAR.stress_at(L, 25e-6) == pytest.approx(-Z * BAR.velocity)
    assert BAR.stress_at(L, 80e-6) == pytest.approx(Z * BAR.velocity)
    x = (np.arange(40000) + 0.5) / 40000 * L
    for time in np.linspace(0, BAR.time, 7):
        v, σ = BAR.velocity_at(x, time), BAR.stress_at(x, time)
        energy = 0.5 * (BAR.density * v**2 + σ**2 / BAR.young).mean() * L
        assert energy == pytest.approx(3262.93, rel=1e-3)


def wiggles(scheme, shape, cells):
    """Return the error of the free end's velocity in WINDOWS, in the mean square [m/s]."""
    simulation = mpmgeo.Simulation(BAR.case(cells, scheme, shape))
    x = simulation.field("position")[:, 0]
    end = x < x.min() + 1e-9
    times, errors = [], []
    for _ in range(round(BAR.time / simulation.time_step)):
        simulation.step()
        times.append(simulation.time)
        exact = BAR.velocity_at(np.zeros(1), simulation.time)[0]
        errors.append(simulation.field("velocity")[end, 0].mean() - exact)
    times, squares = np.array(times), np.square(errors)
    return [np.sqrt(squares[(t0 < times) & (times < t1)].mean()) for t0, t1 in WINDOWS]


@pytest.mark.slow
def test_the_predictor_corrector_calms_the_free_end():
    """Known wiggles of both, and in the last window at most 0.55 of those without it."""
    usf, npc = wiggles("USF", "linear", 40), wiggles("NPC", "linear", 40)
    assert usf == pytest.approx([0.436, 0.793, 0.691], rel=0.02)
    assert npc == pytest.approx([0.266, 0.506, 0.295], rel=0.02)
    assert npc[2] < 0.55 * usf[2]


def in_one_dimension(cells, γ, S):
    """Return the velocities (n,) [m/s] of the paper's equations, written down as they stand."""
    h = BAR.length / cells
    steps = np.ceil(BAR.time / (0.1 * h / BAR.wave_speed))
    dt = BAR.time / steps
    X = h * (np.arange(cells)[:, None] + GAUSS).ravel()
    x, v, a = X.copy(), np.where(BAR.length / 4 > X, BAR.velocity, 0.0), np.zeros_like(X)
    V, σ = np.full_like(X, h / 2), np.zeros_like(X)
    m, nodes = BAR.density * V, np.arange(-8, cells + 1)
    for _ in range(int(steps)):
        g = x / h
        l = g[:, None] - nodes
        first = np.floor(g - (S - 2) / 2)[:, None]
        takes_part = (nodes >= first) & (nodes < first + S)
        N, r, J = of_largest_entropy(γ, l, takes_part)
        G = -N * (l - r[:, None]) / J[:, None] / h
        M = N.T @ m
        share = np.divide(1.0, M, where=M > 0, out=np.zeros_like(M))
        predicted = N.T @ (m * (v + 0.5 * dt * a)) * share
        predicted[-1] = 0.0
        ε = dt * (G @ predicted)
        V, σ = V * (1 + ε), σ + BAR.young * ε
        A = -(G.T @ (V * σ)) * share
        A[-1] = 0.0
        a = N @ A
        v = v + dt * a
        x = x + dt * (N @ (predicted + 0.5 * dt * A)) + 0.5 * dt * dt * a
    return X, v


def of_largest_entropy(γ, l, takes_part):
    """Return weights (n, nodes), mean and spread of l (n,); Newton's method in a bracket."""
    λ = np.zeros(len(l))
    low, high = λ - 60, λ + 60
    for _ in range(80):
        f = np.where(takes_part, -γ * l * l + λ[:, None] * l, -np.inf)
        e = np.exp(f - f.max(axis=1)[:, None])
        N = e / e.sum(axis=1)[:, None]
        r = (N * l).sum(axis=1)
        J = (N * l * l).sum(axis=1) - r * r
        if np.abs(r).max() < 1e-14:
            break
        low, high = np.where(r < 0, λ, low), np.where(r > 0, λ, high)
        new = λ - r / np.maximum(J, 1e-12)
        λ = np.where((low < new) & (new < high), new, 0.5 * (low + high))
    return N, r, J


def test_a_bar_of_three_dimensions_is_one_of_one():
    """One cell of cross-section, particles evenly around: its factors sum to one and cancel."""
    simulation = run(14, "NPC", "LME")
    X, expected = in_one_dimension(14, 3.0, 5)
    x = simulation.field("position")[:, 0] - simulation.field("displacement")[:, 0]
    velocity = simulation.field("velocity")
    nearest = np.abs(x[:, None] - X).argmin(axis=1)
    assert np.abs(velocity[:, 0] - expected[nearest]).max() < 1e-7 * -BAR.velocity
    assert np.abs(velocity[:, 1:]).max() < 1e-9 * -BAR.velocity
