"""A new beginning: time, displacements and strains from 0, with the stresses that there are."""

import numpy as np
import pytest
from scenes import cuboid, scene, simulate

import mpmgeo
from mpmgeo.run.watch import Diverged

SAND = {"type": "mohr-coulomb", "id": 1, "density": 2000.0, "young": 1e6, "poisson": 0.3}
SAND |= {"friction": 30.0, "cohesion": 1e3}


def column(**keys):
    """Return a case of a soft column that settles under its weight."""
    case = {"gravity": [0, 0, -10.0], "damping": {"type": "kinetic"}, "time": 0.05}
    case |= {"materials": [SAND], "results": {"material_point_results": ["strain"]}}
    return scene([2, 2, 10], 0.25, [cuboid([0, 0, 0], [0.5, 0.5, 2])], **case | keys)


def settled(**keys):
    return simulate(column(**keys)).step(300)


def test_what_counts_from_the_new_beginning():
    simulation = settled()
    before = {key: simulation.field(key).copy() for key in ("position", "stress", "volume")}
    assert np.abs(simulation.field("displacement")).max() > 1e-3
    simulation.reset_displacements()
    assert simulation.time == simulation.steps == 0
    for key in ("displacement", "velocity", "strain"):
        assert not simulation.field(key).any(), key
    for key, values in before.items():
        assert np.array_equal(simulation.field(key), values), key
    simulation.run()
    assert simulation.time >= simulation.case.time
    moved = simulation.field("position") - before["position"]
    np.testing.assert_allclose(simulation.field("displacement"), moved, atol=1e-15)


def test_it_is_a_case_that_begins_with_these_stresses():
    """A reset run moves as one whose particles are given positions and stresses do."""
    reset, given = simulate(column()).step(40), simulate(column())
    reset.reset_displacements()
    given.assign("displacement", reset.field("position") - given.field("position"))
    given.assign("stress", reset.field("stress"))
    ratio = reset.field("volume") / given.field("volume")
    given.assign("deformation_gradient", np.cbrt(ratio)[:, None, None] * np.eye(3))
    for simulation in (reset, given):
        simulation.step(20)
    for key in ("position", "velocity", "stress"):
        a, b = reset.field(key), given.field(key)
        np.testing.assert_allclose(a, b, rtol=0, atol=1e-9 * np.abs(b).max())


BRANCHES = {
    "energy": {"results": {"energy": {"every": 5}}},
    "loads in time": {
        "load_distributed_box": [
            {"point_p1": [0, 0, 1.75], "point_p2": [0.5, 0.5, 2], "load": [0, 0, -500]}
            | {"time": [0, 0.01], "factor": [0, 1]}
        ]
    },
    "prescribed velocity": {
        "prescribed_velocity": [
            {"point_p1": [0, 0, 1.75], "point_p2": [0.5, 0.5, 2], "velocity": [0, 0, -0.01]}
        ]
    },
    "no kinetic damping": {"damping": {"type": "local", "value": 0.1}},
    "Newmark": {"stress_scheme_update": "NPC", "damping": {"type": "local", "value": 0.1}},
}


@pytest.mark.parametrize("name", BRANCHES)
def test_resumed_equals_uninterrupted(name, tmp_path):
    simulation = settled(**BRANCHES[name])
    simulation.reset_displacements()
    simulation.step(12).save(tmp_path / "snapshot")
    resumed = mpmgeo.Simulation.resume(tmp_path / "snapshot")
    assert resumed.time == simulation.time
    for run in (simulation, resumed):
        run.step(20)
    for key in ("position", "velocity", "stress", "displacement", "external_force"):
        assert np.array_equal(simulation.field(key), resumed.field(key)), key
    assert simulation.energy() == resumed.energy()


def test_the_balance_of_energy_begins_anew():
    simulation = settled(results={"energy": {"every": 1}})
    simulation.reset_displacements()
    energy = simulation.step(50).energy()
    assert abs(energy["balance"]) < 1e-3 * abs(energy["strain"])


def test_a_force_of_a_script_knows_where_particles_begin_now():
    seen = []

    def force(t, X):
        seen.append((t, X.copy()))
        return np.zeros_like(X)

    simulation = mpmgeo.Simulation(column(), body_force=force).step(100)
    simulation.reset_displacements()
    simulation.step()
    assert np.array_equal(seen[-2][1], seen[-1][1])
    assert seen[-2][0] == 0.0
    assert np.abs(seen[-1][1] - seen[0][1]).max() > 1e-4


def test_a_record_of_the_base_begins_anew(tmp_path):
    path = tmp_path / "record.csv"
    path.write_text("t,x,y,z\n0,1,0,0\n0.02,1,0,0\n0.04,0,0,0\n1,0,0,0\n")
    simulation = settled(earthquake={"active": True, "file": str(path)})
    base = simulation.solver.effect("base").motion
    assert base.velocity[0] > 0
    simulation.reset_displacements()
    assert base.velocity == (0.0, 0.0, 0.0)
    simulation.step()
    assert base.velocity[0] == pytest.approx(0.5 * simulation.time_step)


def test_a_diverging_run_goes_back_to_the_new_beginning():
    simulation = settled()
    simulation.reset_displacements()
    where = simulation.field("position").copy()
    simulation.assign("velocity", np.full((simulation.solver.count, 3), 1e6))
    with pytest.raises(Diverged):
        simulation.run()
    assert np.array_equal(simulation.field("position"), where)
    assert not simulation.field("displacement").any()
