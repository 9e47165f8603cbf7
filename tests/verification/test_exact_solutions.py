"""The exact solutions satisfy the equations they are solutions of (derivatives by differences)."""

import numpy as np
import pytest

from mpmgeo.verify import free_fall
from mpmgeo.verify.bar import Bar
from mpmgeo.verify.base_motion import SineMotion
from mpmgeo.verify.beam import Cantilever
from mpmgeo.verify.column import Column
from mpmgeo.verify.convergence import Convergence, refine, relative_error
from mpmgeo.verify.half_space import HalfSpace

GROUND = HalfSpace(young=200e6, poisson=0.25, force=3.0)
POINTS = np.array([[0.3, 0.2, -0.4], [-0.1, 0.7, -0.05], [0.5, -0.5, -2.0], [-1.0, -0.2, -0.6]])
STEP = 1e-5


def gradient(function, points):
    """Return the central differences (n, …, 3) of a field at points (n, 3)."""
    shifts = STEP * np.eye(3)
    pairs = [(function(points + shift), function(points - shift)) for shift in shifts]
    return np.stack([(after - before) / (2 * STEP) for after, before in pairs], axis=-1)


def tensor(voigt):
    return voigt[..., [[0, 3, 5], [3, 1, 4], [5, 4, 2]]]


def test_half_space_obeys_hooke():
    strain = gradient(GROUND.displacement, POINTS)
    strain = (strain + strain.swapaxes(1, 2)) / 2
    G = GROUND.young / (2 * (1 + GROUND.poisson))
    λ = 2 * G * GROUND.poisson / (1 - 2 * GROUND.poisson)
    trace = np.trace(strain, axis1=1, axis2=2)
    hooke = λ * trace[:, None, None] * np.eye(3) + 2 * G * strain
    assert relative_error(tensor(GROUND.stress(POINTS)), hooke) < 1e-7


def test_half_space_is_in_equilibrium():
    slopes = gradient(lambda x: tensor(GROUND.stress(x)), POINTS)
    divergence = np.einsum("nijj->ni", slopes)
    assert np.abs(divergence).max() < 1e-7 * np.abs(slopes).max()


def test_half_space_carries_the_force_and_nothing_else_at_its_surface():
    r = np.linspace(0, 40, 20001)
    plane = np.stack([r, 0 * r, 0 * r - 0.5], axis=-1)
    carried = -np.trapezoid(GROUND.stress(plane)[:, 2] * 2 * np.pi * r, r)
    assert carried == pytest.approx(GROUND.force, rel=1e-3)
    surface = GROUND.stress(np.array([[0.3, 0.2, 0.0], [-2.0, 0.0, 0.0]]))
    assert np.abs(surface[:, [2, 4, 5]]).max() == 0


def test_half_space_on_the_axis():
    """The tabulated settlement 5P/(8πGz) for ν = 1/4, and stress −3P/(2πz²), below the force."""
    ground = HalfSpace(young=200e6, poisson=0.25, force=1.0)
    below = np.array([[0.0, 0.0, -0.1], [0.0, 0.0, -0.3]])
    assert ground.displacement(below)[:, 2] == pytest.approx([-2.4868e-8, -8.289e-9], rel=1e-4)
    assert ground.stress(below)[:, 2] == pytest.approx([-47.75, -5.305], rel=1e-4)


def test_bar_obeys_the_wave_equation():
    bar = Bar(velocity_peak=0.1, mode=2)
    x, t, e = np.linspace(0, bar.length, 7), 1.3, 1e-3
    u = bar.displacement
    ahead = (u(x, t + e) - 2 * u(x, t) + u(x, t - e)) / e**2
    curvature = (u(x + e, t) - 2 * u(x, t) + u(x - e, t)) / e**2
    assert relative_error(bar.density * ahead, bar.young * curvature) < 1e-5
    assert relative_error((u(x, t + e) - u(x, t - e)) / (2 * e), bar.velocity(x, t)) < 1e-5
    assert u(np.array([bar.length + e]), t) == pytest.approx(u(np.array([bar.length - e]), t))


def test_bar_of_the_literature():
    """Nairn's bar: β 0.0628, period 10 s, tip displacement 0.159 m for 0.1 m/s."""
    bar = Bar(velocity_peak=0.1)
    assert bar.wave_number == pytest.approx(0.0628319, rel=1e-5)
    assert bar.period == pytest.approx(10.0)
    assert bar.displacement_peak == pytest.approx(0.159155, rel=1e-5)


def test_sine_motion_integrates():
    motion = SineMotion(amplitude=(0.3, 0.3, 0.1), frequency=(1.0, 0.5, 2.0), phase=0.4)
    t, e = np.linspace(0, 2, 9), 1e-5
    for function, slope in (
        (motion.displacement, motion.velocity),
        (motion.velocity, motion.acceleration),
    ):
        assert relative_error((function(t + e) - function(t - e)) / (2 * e), slope(t)) < 1e-8
    assert np.abs(motion.displacement(np.zeros(1))).max() == 0


def test_beam_carries_its_load():
    """Bending alone: EI w″″ = q, and no moment at the free end; shear adds a few per cent."""
    beam = Cantilever(length=2.0, depth=1e-3, young=1e8, poisson=0.25)
    x, e = np.array([0.5, 1.0, 1.5]), 1e-2

    def curvature(x, load):
        w = load(1.0, x + e) - 2 * load(1.0, x) + load(1.0, x - e)
        return w / e**2 * beam.bending_stiffness

    assert curvature(x, beam.under_uniform_load) == pytest.approx((2 - x) ** 2 / 2, rel=1e-3)
    assert curvature(x, beam.under_end_load) == pytest.approx(2 - x, rel=1e-3)
    deep = Cantilever(length=2.0, depth=0.4, young=1e8, poisson=0.25)
    tip = np.array([2.0])
    assert deep.under_uniform_load(2000 * 9.81 * 0.4, tip) == pytest.approx(0.0287678, rel=1e-5)


def test_column_carries_its_weight():
    column = Column(height=10.0, young=1e7, poisson=0.2, density=2000.0, gravity=9.81)
    z, e = np.array([1.0, 5.0, 9.0]), 1e-4
    u = column.vertical_displacement
    strain = (u(z + e) - u(z - e)) / (2 * e)
    assert column.confined_modulus * strain == pytest.approx(column.vertical_stress(z), rel=1e-6)


def test_free_fall_sums_to_the_parabola():
    """Positions summed from the velocities of the scheme are those of the parabola."""
    dt, g = 0.01, np.array([0.0, 0.0, -9.81])
    velocities = [free_fall.velocity(g, n * dt, dt) for n in range(1, 51)]
    assert sum(velocities) * dt == pytest.approx(free_fall.displacement(g, 50 * dt), rel=1e-13)
    assert free_fall.kinetic_energy(64000.0, g, 0.1, 1e-3) == pytest.approx(
        0.5 * 64000 * 9.81**2 * 0.0995**2
    )


def test_order_of_a_power_law():
    study = refine(lambda n: 3 * (10 / n) ** 2, [10, 20, 40], length=10)
    assert study.order == pytest.approx(2)
    assert study.orders == pytest.approx([2, 2])
    bent = Convergence(np.array([1.0, 0.5, 0.25]), np.array([1.0, 0.5, 0.125]))
    assert bent.orders == pytest.approx([1, 2])
