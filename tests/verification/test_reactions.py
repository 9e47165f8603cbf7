"""Forces of the boundary planes: what the momentum of the particles lacks, to round-off."""

import numpy as np
import pytest
from scenes import cuboid, scene, simulate

GRAVITY = (1.0, -2.0, -9.81)
PLANES = {"type": "planes", "every": 1}


def momentum(simulation):
    """Return the momentum of all particles (3,) [kg m/s]."""
    return simulation.field("mass") @ simulation.field("velocity")


def tilted_box(**keys):
    """A block that fills the corner of a mesh with planes of all kinds, under oblique gravity."""
    kinds = {
        "plane_X0": "sliding",
        "plane_Y0": "fixed",
        "plane_Z0": "fixed",
        "plane_Xn": "sliding",
        "plane_Yn": "fixed",
        "plane_Zn": "free",
    }
    return scene(
        [4, 3, 5],
        0.1,
        [cuboid([0, 0, 0], [0.4, 0.3, 0.4])],
        boundary_conditions=kinds,
        time=1.0,
        time_step=5e-4,
        gravity=list(GRAVITY),
        results={"probes": [PLANES]},
        **keys,
    )


@pytest.mark.parametrize("scheme", ["USL", "MUSL", "USF"])
def test_planes_and_weight_change_the_momentum(scheme):
    simulation = simulate(tilted_box(stress_scheme_update=scheme))
    mass = simulation.field("mass").sum()
    before = momentum(simulation)
    for step in range(40):
        simulation.step()
        after, dt = momentum(simulation), simulation.time_step * (0.5 if step == 0 else 1.0)
        force = sum(simulation.reactions().values()) + mass * np.array(GRAVITY)
        scale = mass * np.linalg.norm(GRAVITY) * dt
        np.testing.assert_allclose(after - before, force * dt, rtol=0, atol=1e-9 * scale)
        before = after


def test_sliding_planes_bear_normal_forces_only():
    reactions = simulate(tilted_box()).step(20).reactions()
    assert reactions["X0"][1:].tolist() == reactions["Xn"][1:].tolist() == [0, 0]
    assert reactions["Zn"].tolist() == [0, 0, 0]
    assert reactions["X0"][0] >= 0 >= reactions["Xn"][0]
    assert reactions["Z0"][2] > 0


def test_damping_is_no_force_of_a_plane():
    """At rest the floor bears the weight and the walls the lateral stress, whatever the damping."""
    for damping in ({"type": "local", "value": 0.3}, {"type": "kinetic"}):
        case = scene(
            [2, 2, 8],
            0.1,
            [cuboid([0, 0, 0], [0.2, 0.2, 0.6])],
            time=2.0,
            critical_time_step_multiplier=0.5,
            gravity=[0, 0, -9.81],
            damping=damping,
            results={"probes": [PLANES]},
        )
        simulation = simulate(case).run()
        weight = 9.81 * simulation.field("mass").sum()
        reactions = simulation.reactions()
        assert reactions["Z0"][2] == pytest.approx(weight, rel=1e-3)
        # K0 = ν/(1 − ν) = 1/3 of the mean vertical stress, ½ρgH, on the area of a wall
        wall = 0.5 * weight / 0.04 * (0.2 * 0.6) / 3
        for plane, axis, sign in (("X0", 0, 1), ("Xn", 0, -1), ("Y0", 1, 1), ("Yn", 1, -1)):
            assert sign * reactions[plane][axis] == pytest.approx(wall, rel=0.02)


def test_moving_base_is_a_plane(tmp_path):
    """The force of the base is what a block on it lacks, and all the planes' forces lie in it."""
    record = tmp_path / "record.csv"
    record.write_text("t,x,y,z\n0,0,0,0\n0.1,2,1,0.5\n1,2,1,0.5\n")
    case = scene(
        [6, 6, 6],
        0.1,
        [cuboid([0.2, 0.2, 0], [0.4, 0.4, 0.2])],
        time=1.0,
        time_step=5e-4,
        earthquake={"active": True, "file": str(record)},
        results={"probes": [PLANES]},
    )
    simulation = simulate(case).step(100)
    before = momentum(simulation)
    for _ in range(10):
        simulation.step()
        after = momentum(simulation)
        force = simulation.reactions()["Z0"]
        np.testing.assert_allclose((after - before) / simulation.time_step, force, rtol=1e-9)
        before = after
