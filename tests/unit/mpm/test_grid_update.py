"""The step of the nodes: which take part, and how damping acts on them."""

import numpy as np
import pytest
from assembly import assemble, by_row, nodes, planes

DT = 1e-3
G = np.array([3.0, 0.0, -4.0])


@pytest.mark.parametrize("cutoff, moves", [(1e-12, False), (0.0, True)])
def test_forces_do_not_move_nodes_of_round_off_mass(cutoff, moves):
    """A particle whose edge passes a node by 1e-9 cells has 1e-18 of its mass there.

    Such a node keeps the particle's velocity, which is safe; its share of the force still reaches
    the particle.
    """
    l = 0.25
    velocity = (1.0, 0.0, 0.0)
    place = [[5 + l - 1e-9, 5.0, 5.0]]
    solver = assemble(place, cutoff=cutoff, velocity=velocity, gravity=tuple(G))
    solver.step()
    index, mass, found, _ = nodes(solver)
    light = index[:, 0] == 4
    assert light.any() and (mass[light] < 1e-15).all()
    assert mass.sum() == pytest.approx(1.0, rel=1e-14)
    moved = np.array(velocity) + DT / 2 * G
    assert found[~light] == pytest.approx(np.tile(moved, ((~light).sum(), 1)))
    expected = moved if moves else np.array(velocity)
    assert found[light] == pytest.approx(np.tile(expected, (light.sum(), 1)))
    assert by_row(solver, "v")[0] == pytest.approx(moved, rel=1e-14)


def test_light_nodes_above_the_cut_off_stay():
    solver = assemble([[5.25 - 1e-5, 5.5, 5.5]], cutoff=1e-12)
    solver.step()
    index, mass, _, _ = nodes(solver)
    light = mass[index[:, 0] == 4]
    # 1e-10 along x, shared by the four nodes around
    assert light == pytest.approx(np.full(4, 0.25e-10), rel=1e-6)


def test_nodes_left_behind_are_empty():
    solver = assemble([[5.0, 5.0, 5.0]], velocity=(1000.0, 0.0, 0.0))
    solver.step()
    solver.step()
    index, mass, _, _ = nodes(solver)
    assert mass.sum() == pytest.approx(1.0) and index[:, 0].min() == 5


def test_local_damping_acts_against_the_present_velocity():
    """Every node has the particle's velocity: f = g − α |g| v / |v|."""
    velocity, α = np.array([0.0, 0.6, 0.8]), 0.2
    solver = assemble([[5.3, 5.1, 5.9]], velocity=velocity, gravity=tuple(G), local=α)
    solver.step()
    v = velocity + DT / 2 * (G - α * 5.0 * velocity)
    assert by_row(solver, "v")[0] == pytest.approx(v, rel=1e-14)
    solver.step()
    v = v + DT * (G - α * 5.0 * v / np.linalg.norm(v))
    assert by_row(solver, "v")[0] == pytest.approx(v, rel=1e-14)


def test_delayed_damping_acts_against_the_last_velocity():
    """None in the first step, then that of the step before."""
    velocity, α = np.array([0.0, 0.6, 0.8]), 0.2
    solver = assemble([[5.3, 5.1, 5.9]], velocity=velocity, gravity=tuple(G), delayed=α)
    solver.step()
    first = velocity + DT / 2 * G
    assert by_row(solver, "v")[0] == pytest.approx(first, rel=1e-14)
    solver.step()
    second = first + DT * (G - α * 5.0 * first / np.linalg.norm(first))
    assert by_row(solver, "v")[0] == pytest.approx(second, rel=1e-14)
    solver.step()
    third = second + DT * (G - α * 5.0 * second / np.linalg.norm(second))
    assert by_row(solver, "v")[0] == pytest.approx(third, rel=1e-14)


def test_damping_at_rest_is_none():
    for kind in ("local", "delayed"):
        solver = assemble([[5.3, 5.1, 5.9]], gravity=tuple(G), **{kind: 0.5})
        solver.step()
        assert by_row(solver, "v")[0] == pytest.approx(DT / 2 * G, rel=1e-14)


def on_floor(kind, floor, velocity):
    """Return the acceleration of the floor's nodes after two steps, damped by half."""
    solver = assemble(
        [[5.3, 5.1, 0.3]],
        velocity=velocity,
        volume=0.0,  # no stress can push the nodes
        gravity=tuple(G),
        planes=planes(plane_Z0=floor),
        **{kind: 0.5},
    )
    solver.step()
    solver.step()
    index, _, _, acceleration = nodes(solver)
    assert (index[:, 2] <= 0).any()
    return acceleration[index[:, 2] <= 0]


def test_wall_reactions_do_not_damp():
    """On a smooth floor only the force along it counts, 3 of 3 and 4."""
    acceleration = on_floor("local", "sliding", (2.0, 0.0, 0.0))
    expected = [3.0 - 0.5 * 3.0, 0.0, 0.0]
    assert acceleration == pytest.approx(np.tile(expected, (len(acceleration), 1)))


def test_wall_reactions_damp_in_the_old_form():
    acceleration = on_floor("delayed", "sliding", (2.0, 0.0, 0.0))
    expected = [3.0 - 0.5 * 5.0, 0.0, 0.0]
    assert acceleration == pytest.approx(np.tile(expected, (len(acceleration), 1)))


@pytest.mark.parametrize("kind", ["local", "delayed"])
def test_damping_moves_no_held_node(kind):
    assert not on_floor(kind, "fixed", (2.0, 0.0, -1.0)).any()
    assert not on_floor(kind, "sliding", (2.0, 1.0, -1.0))[:, 2].any()
