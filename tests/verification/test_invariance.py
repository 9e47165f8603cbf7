"""The laws of motion know no preferred place, side or axis, and neither does the program."""

import numpy as np
import pytest
from scenes import RUBBER, cuboid, initial_position, scene, simulate

SCHEMES = ["USL", "MUSL", "USF"]
CELL = 0.1
CELLS = np.array([12, 10, 14])
LENGTHS = CELLS * CELL
BLOCK = np.array([[0.1, 0.2, 0.6], [0.4, 0.6, 0.9]])
VELOCITY = np.array([-1.0, 0.4, -0.7])
PLANES = {"plane_X0": "fixed", "plane_Z0": "sliding", "plane_Y0": "free"}
FIELDS = {"displacement": 1, "velocity": 1}


def crash(cells, block, velocity, planes, scheme):
    """Throw a block into the corner and return initial positions, displacements, velocities."""
    case = scene(
        [int(n) for n in cells],
        CELL,
        [cuboid(block[0], block[1], initial_velocity=[float(v) for v in velocity])],
        time=0.25,
        time_step=1e-3,
        stress_scheme_update=scheme,
        boundary_conditions=planes,
    )
    simulation = simulate(case).run()
    fields = (initial_position(simulation), *map(simulation.field, FIELDS))
    order = np.lexsort(np.round(fields[0], 6).T)
    return [values[order] for values in fields]


def compare(value, expected):
    """Return the largest difference relative to the largest value."""
    return np.abs(value - expected).max() / np.abs(expected).max()


@pytest.mark.parametrize("scheme", SCHEMES)
def test_mirrored_case_gives_mirrored_result(scheme):
    original = crash(CELLS, BLOCK, VELOCITY, PLANES, scheme)
    sign = np.array([-1.0, 1.0, 1.0])
    far = np.array([LENGTHS[0], 0.0, 0.0])
    low, high = BLOCK * sign + far
    block = np.array([np.minimum(low, high), np.maximum(low, high)])
    planes = {"plane_Xn": "fixed", "plane_Z0": "sliding", "plane_Y0": "free"}
    x, *mirrored = crash(CELLS, block, VELOCITY * sign, planes, scheme)
    order = np.lexsort(np.round(x * sign + far, 6).T)
    for value, expected in zip(mirrored, original[1:], strict=True):
        assert compare(value[order] * sign, expected) < 1e-10


@pytest.mark.parametrize("scheme", SCHEMES)
def test_swapped_axes_give_swapped_result(scheme):
    original = crash(CELLS, BLOCK, VELOCITY, PLANES, scheme)
    turn = [2, 0, 1]
    planes = {"plane_Y0": "fixed", "plane_X0": "sliding", "plane_Z0": "free"}
    x, *swapped = crash(CELLS[turn], BLOCK[:, turn], VELOCITY[turn], planes, scheme)
    back = np.argsort(turn)
    order = np.lexsort(np.round(x[:, back], 6).T)
    for value, expected in zip(swapped, original[1:], strict=True):
        assert compare(value[order][:, back], expected) < 1e-10


@pytest.mark.parametrize("scheme", SCHEMES)
def test_moved_origin_gives_the_same_result(scheme):
    """Mesh and block moved together, by a number that is no multiple of the cell."""
    original = crash(CELLS, BLOCK, VELOCITY, PLANES, scheme)
    shift = np.array([-3.37, 0.81, 12.25])
    case = scene(
        [int(n) for n in CELLS],
        CELL,
        [cuboid(BLOCK[0] + shift, BLOCK[1] + shift, initial_velocity=list(VELOCITY))],
        time=0.25,
        time_step=1e-3,
        stress_scheme_update=scheme,
        boundary_conditions=PLANES,
        origin=list(shift),
    )
    simulation = simulate(case).run()
    order = np.lexsort(np.round(initial_position(simulation) - shift, 6).T)
    for name, expected in zip(FIELDS, original[1:], strict=True):
        assert compare(simulation.field(name)[order], expected) < 1e-9


@pytest.mark.parametrize("shape", ["GIMP", "linear"])
@pytest.mark.parametrize("scheme", SCHEMES)
def test_a_body_in_steady_flight_feels_nothing(scheme, shape):
    """It crosses seven cells; velocities stay, no stress appears."""
    velocity = [3.0, 1.0, 2.0]
    case = scene(
        [14, 10, 12],
        CELL,
        [cuboid([0.2, 0.2, 0.2], [0.5, 0.5, 0.5], initial_velocity=velocity)],
        time=0.25,
        stress_scheme_update=scheme,
        shape_function=shape,
    )
    simulation = simulate(case).run()
    assert np.abs(simulation.field("velocity") - velocity).max() < 1e-10
    assert np.abs(simulation.field("stress")).max() < 1e-10 * RUBBER["young"]


def one_step(gradient, scheme):
    """Return the stresses (n, 6) of inner particles after a step with velocity gradient (3, 3)."""
    case = scene(
        [20, 20, 20],
        CELL,
        [cuboid([0.5, 0.5, 0.5], [1.5, 1.5, 1.5])],
        time=1.0,
        time_step=1e-4,
        stress_scheme_update=scheme,
    )
    simulation = simulate(case)
    offset = simulation.field("position") - 1.0
    simulation.assign("velocity", offset @ np.transpose(gradient))
    simulation.step()
    inner = (np.abs(offset) < 0.2).all(axis=1)
    return simulation.field("stress")[inner], simulation.time_step


@pytest.mark.parametrize("scheme", SCHEMES)
def test_rigid_spin_makes_no_stress(scheme):
    spin = np.array([[0.0, -3.0, 2.0], [3.0, 0.0, -1.0], [-2.0, 1.0, 0.0]])
    stress, dt = one_step(spin, scheme)
    # What remains is quadratic: the centrifugal motion of the step itself.
    assert np.abs(stress).max() < 10 * RUBBER["young"] * (3.0 * dt) ** 2


@pytest.mark.parametrize("scheme", SCHEMES)
def test_homogeneous_deformation_follows_hooke(scheme):
    gradient = np.array([[1.0, 0.5, 0.2], [0.1, -2.0, 0.4], [0.3, 0.6, 0.7]])
    stress, dt = one_step(gradient, scheme)
    strain = (gradient + gradient.T) / 2 * dt
    G2 = RUBBER["young"] / (1 + RUBBER["poisson"])
    λ = G2 * RUBBER["poisson"] / (1 - 2 * RUBBER["poisson"])
    hooke = λ * np.trace(strain) * np.eye(3) + G2 * strain
    expected = hooke[[0, 1, 2, 0, 1, 0], [0, 1, 2, 1, 2, 2]]
    assert np.abs(stress - expected).max() < 1e-3 * np.abs(expected).max()
