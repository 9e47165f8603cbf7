"""The simulation as scripts use it."""

import numba
import numpy as np
import pytest
from assembly import simulate, two_blocks

import mpmgeo


def test_public_names():
    assert {"CaseError", "Simulation", "load_case"} <= set(mpmgeo.__all__)
    assert all(callable(getattr(mpmgeo, name)) for name in mpmgeo.__all__)
    assert set(mpmgeo.__all__) <= set(dir(mpmgeo))
    assert mpmgeo.Simulation.__name__ == "Simulation"
    with pytest.raises(AttributeError, match="nothing"):
        _ = mpmgeo.nothing


# Running


def test_run_returns_the_simulation_at_the_end_of_the_case():
    simulation = simulate(two_blocks())
    assert simulation.time == 0.0 and simulation.steps == 0
    assert simulation.run() is simulation
    assert simulation.steps == 50 and simulation.time == pytest.approx(0.05)
    assert not simulation.interrupted


def test_run_until_and_on():
    """In pieces or at once, in steps or as a run: the same bits."""
    whole = simulate(two_blocks()).run()
    pieces = simulate(two_blocks()).run(until=0.0102)
    assert pieces.steps == 11
    pieces.step(9).step()
    assert pieces.steps == 21
    pieces.run()
    assert pieces.steps == 50
    for key in ("position", "velocity", "stress", "volume"):
        assert (pieces.field(key) == whole.field(key)).all()


def test_a_run_that_is_over_does_nothing():
    simulation = simulate(two_blocks()).run()
    assert simulation.run().steps == 50


def test_watchers_see_every_step():
    class Watcher:
        def begin(self, simulation):
            self.times = [simulation.time]

        def after_step(self, simulation):
            self.times.append(simulation.time)

        def end(self, simulation, error):
            self.error = error

    watcher = Watcher()
    simulate(two_blocks()).run(watchers=[watcher])
    assert watcher.times == pytest.approx(1e-3 * np.arange(51)) and watcher.error is None


def test_free_particles_fall_freely():
    """Until the blocks meet, nothing but gravity acts; velocities are half a step early."""
    simulation = simulate(two_blocks(gravity=[0, 0, -10.0])).step(20)
    start = np.repeat([[0, 0, 0], [3.0, 1.0, -2.0]], [64, 32], axis=0)
    speed = simulation.field("velocity") - start
    assert speed == pytest.approx(np.tile([0, 0, -10.0 * 19.5e-3], (96, 1)), abs=1e-9)


def test_threads():
    most = numba.config.NUMBA_NUM_THREADS
    assert simulate(two_blocks()).threads == 1
    assert simulate(two_blocks(), threads=2).threads == 2
    case = two_blocks()
    del case["n_threads"]
    assert simulate(case).threads == most
    greedy = simulate(two_blocks(), threads=10_000)
    assert greedy.threads == most
    assert any("10000 asked for" in message for message in greedy.messages)


def test_threads_are_set_for_each_simulation(threads):
    one, two = simulate(two_blocks()), simulate(two_blocks(), threads=2)
    for simulation in (one, two, one):
        simulation.step()
        assert numba.get_num_threads() == simulation.threads


# Fields


def test_fields_have_a_row_for_each_particle():
    simulation = simulate(two_blocks()).step(5)
    for key, shape in {
        "position": (96, 3),
        "displacement": (96, 3),
        "velocity": (96, 3),
        "stress": (96, 6),
        "mass": (96,),
        "volume": (96,),
        "active": (96,),
        "id": (96,),
        "Su": (96,),
    }.items():
        assert simulation.field(key).shape == shape
    with pytest.raises(KeyError):
        simulation.field("no such field")


def test_initial_state():
    simulation = simulate(two_blocks())
    assert simulation.field("mass") == pytest.approx(np.repeat([2000 / 64, 1000 / 64], [64, 32]))
    assert simulation.field("volume") == pytest.approx(np.full(96, 1 / 64))
    assert not simulation.field("stress").any() and not simulation.field("displacement").any()
    assert (simulation.field("velocity")[64:] == [3.0, 1.0, -2.0]).all()
    assert simulation.kinetic_energy() == pytest.approx(0.5 * 500.0 * 14.0)


def test_assigned_state_is_in_row_order():
    """Before the first step, when arrays are still in row order, and after, when they are not."""
    case = two_blocks()
    case["mesh"]["origin"] = [-0.5, -0.5, -0.5]  # the lower block lies in eight blocks of nodes
    simulation = simulate(case)
    for seed in range(2):
        random = np.random.default_rng(seed)
        velocity, stress = random.normal(size=(96, 3)), random.normal(size=(96, 6))
        simulation.assign("velocity", velocity)
        simulation.assign("stress", stress.tolist())
        assert (simulation.field("velocity") == velocity).all()
        assert (simulation.field("stress") == stress).all()
        simulation.step(20)
    assert not (simulation.solver.sets[1].row == np.arange(64)).all()


@pytest.mark.parametrize("key", ["position", "mass", "volume", "pressure", "nothing"])
def test_other_fields_cannot_be_assigned(key):
    with pytest.raises(KeyError):
        simulate(two_blocks()).assign(key, np.zeros((96, 3)))


def test_a_displaced_state_can_be_assigned():
    """Positions, volumes, and of a law that keeps F also that and the stress, to the last bit."""
    case = two_blocks()
    case["materials"][1]["type"] = "neo-hookean"
    simulation = simulate(case)
    random = np.random.default_rng(3)
    for _ in range(2):
        displacement = random.uniform(-0.2, 0.2, (96, 3))
        F = np.eye(3) + random.uniform(-0.2, 0.2, (96, 3, 3))
        simulation.assign("displacement", displacement)
        simulation.assign("deformation_gradient", F)
        assert simulation.field("displacement") == pytest.approx(displacement, abs=1e-15)
        found = simulation.field("deformation_gradient")
        assert (found[:64] == F[:64]).all() and not found[64:].any()
        assert simulation.field("volume") == pytest.approx(np.linalg.det(F) / 64)
        assert simulation.field("stress")[:64].any(axis=1).all()
        simulation.step(20)
        assert simulation.field("active").all()


def test_a_state_that_cannot_be_is_refused():
    case = two_blocks()
    simulation = simulate(case)
    F = np.tile(np.eye(3), (96, 1, 1))
    F[7, 1, 1] = -1.0
    with pytest.raises(ValueError, match="deformation_gradient: det is -1 in row 7"):
        simulation.assign("deformation_gradient", F)
    case["materials"][0]["type"] = "neo-hookean"
    with pytest.raises(ValueError, match="assign that"):
        simulate(case).assign("stress", np.zeros((96, 6)))


@pytest.mark.parametrize("shape", [(95, 3), (97, 3), (96, 6), (96,), (3,)])
def test_assigned_state_must_fit(shape):
    simulation = simulate(two_blocks())
    before = simulation.field("velocity")
    with pytest.raises((ValueError, IndexError)):
        simulation.assign("velocity", np.ones(shape))
    assert (simulation.field("velocity") == before).all()


# Nodes


def test_no_nodes_before_the_first_step():
    assert len(simulate(two_blocks()).nodes().mass) == 0


def test_nodes_carry_the_mass_and_momentum():
    case = two_blocks()
    case["mesh"]["origin"] = [-0.25, 0.0, 0.5]
    simulation = simulate(case).step()
    nodes = simulation.nodes()
    mass, velocity = simulation.field("mass"), simulation.field("velocity")
    assert nodes.mass.sum() == pytest.approx(mass.sum()) and (nodes.mass > 0).all()
    assert nodes.mass @ nodes.velocity == pytest.approx(mass @ velocity)
    assert nodes.position == pytest.approx((nodes.index - 2) * 0.5 + [-0.25, 0.0, 0.5])
    centre = simulation.solver.population.position + case["mesh"]["origin"]
    assert nodes.mass @ nodes.position == pytest.approx(mass @ centre)
    assert len(np.unique(nodes.index, axis=0)) == len(nodes.index)
    assert nodes.index.min() >= 0


# Messages


def test_departures_are_told():
    """When the first particle leaves, and how many have left at the end."""
    case = two_blocks(time=0.5)
    case["body"][1]["initial_velocity"] = [20.0, 0.0, 0.0]
    simulation = simulate(case).run()
    first, last = [m for m in simulation.messages if "mesh" in m and "particle" in m]
    gone = np.flatnonzero(simulation.field("active") == 0)
    departures = simulation.solver.departures
    assert 0 < len(gone) == sum(len(d.rows) for d in departures)
    assert f"particle {departures[0].rows[0]}, at (" in first
    assert f"after {departures[0].time:.6g} s" in first
    assert last.startswith(f"{len(gone)} particles left the mesh")
    assert f"{departures[-1].time:.6g} s" in last
    energies = 0.5 * simulation.field("mass") * (simulation.field("velocity") ** 2).sum(axis=1)
    assert simulation.kinetic_energy() == pytest.approx(np.delete(energies, gone).sum())


def test_loads_on_empty_nodes_are_told():
    loads = [[[1.5, 1.5, 2.0], [0, 0, -1.0]], [[3.5, 2.5, 4.5], [0, 0, -1.0]]]
    simulation = simulate(two_blocks(nodal_point_load=loads)).step(3)
    (message,) = [m for m in simulation.messages if "nodal_point_load" in m]
    assert "entry 2" in message


def test_box_loads_push_the_particles_inside():
    """The load is shared equally; the momentum grows by its impulse."""
    box = {"point_p1": [0, 0, 2.9], "point_p2": [9, 9, 9], "load": [320.0, 0.0, 64.0]}
    simulation = simulate(two_blocks(load_distributed_box=[box]))
    force = simulation.field("external_force")
    assert force == pytest.approx(np.repeat([[0, 0, 0], [10.0, 0, 2.0]], [64, 32], axis=0))
    mass, before = simulation.field("mass"), simulation.field("velocity")
    simulation.step(2)
    gained = mass @ (simulation.field("velocity") - before)
    assert gained == pytest.approx([320.0 * 1.5e-3, 0, 64.0 * 1.5e-3])


def test_messages_begin_with_those_of_the_case():
    case = mpmgeo.load_case(two_blocks(shape_functions="GIMP", unknown=1))
    assert case.warnings or case.notes
    simulation = mpmgeo.Simulation(case)
    first = [*case.notes, *case.warnings]
    assert simulation.messages[: len(first)] == first
