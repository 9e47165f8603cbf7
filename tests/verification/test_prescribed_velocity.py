"""Prescribed velocities: exact for the tool, and their force is what all the momentum lacks."""

import numpy as np
import pytest
from scenes import RUBBER, cuboid, scene, simulate

from mpmgeo.naming import PLANES

SCHEMES = ("USL", "MUSL", "USF")
MODULUS = RUBBER["young"] * 1.2  # E (1 − ν)/((1 + ν)(1 − 2ν)) for ν = ¼


def momentum(simulation, rows=slice(None)):
    """Return the momentum of some particles (3,) [kg m/s]."""
    return simulation.field("mass")[rows] @ simulation.field("velocity")[rows]


def ramp(path, top, rise, axis=2):
    """Write a table of a velocity that grows smoothly to `top` [m/s] in `rise` [s]; return it."""
    time = np.linspace(0, rise, 41)
    velocity = 0.5 * top * (1 - np.cos(np.pi * time / rise))
    cells = [["null"] * 3 for _ in time]
    for row, v in zip(cells, velocity, strict=True):
        row[axis] = f"{v:.17g}"
    rows = (",".join([f"{t:.17g}", *row]) for t, row in zip(time, cells, strict=True))
    path.write_text("time,vx,vy,vz\n" + "\n".join(rows))
    return str(path)


def column(cells=10, **keys):
    """An elastic column, 0.2 m wide and 1 m high, between smooth walls."""
    cell = 1.0 / cells
    mesh = [2, 2, cells]
    return scene(mesh, cell, [cuboid([0, 0, 0], [2 * cell, 2 * cell, 1.0])], **keys)


@pytest.mark.parametrize("scheme", [*SCHEMES, "NPC", "NPC-CD"])
def test_plane_pushed_into_a_confined_column(tmp_path, scheme):
    """Force of the plane and of the floor are stress × area, within 1 %."""
    file = ramp(tmp_path / "push.csv", -2e-3, 0.5)
    case = column(
        time=1.0,
        critical_time_step_multiplier=0.5,
        stress_scheme_update=scheme,
        damping={"type": "local", "value": 0.2},
        prescribed_velocity={"plate": {"plane": "Zn", "file": file}},
        results={"probes": [{"type": "planes", "every": 10}]},
    )
    simulation = simulate(case)
    while simulation.time < 1.0 or simulation.steps % 10:
        simulation.step()
    way = simulation.case.prescribed_velocity[0].motion.displacement(simulation.time)[2]
    force = -MODULUS * way / 1.0 * 0.2**2
    reactions = simulation.reactions()
    assert way == pytest.approx(-2e-3 * (simulation.time - 0.25), rel=1e-6)
    assert reactions["plate"][2] == pytest.approx(-force, rel=0.01)
    assert reactions["Z0"][2] == pytest.approx(force, rel=0.01)
    assert reactions["Zn"][2] == 0


def test_tool_pushed_into_a_confined_column(tmp_path):
    """A rigid body does what a plane does: with linear shapes its nodes end where it ends."""
    file = ramp(tmp_path / "push.csv", -2e-3, 0.5)
    case = column(
        time=1.0,
        critical_time_step_multiplier=0.5,
        shape_function="linear",
        damping={"type": "local", "value": 0.2},
        prescribed_velocity=[{"body": 2, "file": file, "every": 1}],
    )
    case["mesh"]["cells_number"] = [2, 2, 14]
    case["body"].append({"material_id": 1} | cuboid([0, 0, 1.0], [0.2, 0.2, 1.2]))
    simulation = simulate(case).run()
    motion = simulation.case.prescribed_velocity[0].motion
    way = motion.displacement(simulation.time)[2]
    tool = simulation.field("body") == 2
    assert np.ptp(simulation.field("displacement")[tool, 2]) < 1e-15
    assert simulation.field("displacement")[tool, 2] == pytest.approx(way, rel=1e-4)
    assert (
        simulation.field("velocity")[tool, 2] == simulation.solver.effect("tools").after[0, 2]
    ).all()
    assert np.abs(simulation.field("stress")[tool]).max() < 1e-6 * -MODULUS * way
    force = simulation.reactions()["prescribed_velocity_1"][2]
    assert force == pytest.approx(MODULUS * way * 0.2**2, rel=0.01)


def collision(**keys):
    """A block that a faster tool of the same material runs into, in empty space."""
    blocks = [cuboid([0.4, 0.2, 0.2], [0.7, 0.5, 0.5]), cuboid([0.1, 0.1, 0.2], [0.4, 0.5, 0.5])]
    free = dict.fromkeys((f"plane_{name}" for name in PLANES), "free")
    mesh = [14, 8, 8]
    return scene(mesh, 0.1, blocks, boundary_conditions=free, time=1.0, time_step=5e-4, **keys)


@pytest.mark.parametrize("velocity", [[2.0, 0.3, -0.2], [2.0, None, None], [None, None, -1.0]])
@pytest.mark.parametrize("scheme", [*SCHEMES, "NPC"])
def test_force_is_what_momentum_lacks(scheme, velocity):
    """Step by step, to round-off: what the tool gives to the block, and what moves the tool."""
    tool = {"name": "ram", "body": 2, "velocity": velocity, "every": 1}
    simulation = simulate(collision(stress_scheme_update=scheme, prescribed_velocity=[tool]))
    given = np.array([v is not None for v in velocity])
    rows = simulation.field("body") == 2
    wanted = np.array([v or 0.0 for v in velocity])
    before = momentum(simulation)
    largest = 0.0
    for step in range(60):
        simulation.step()
        dt = simulation.time_step * (0.5 if step == 0 and scheme != "NPC" else 1.0)
        after, force = momentum(simulation), simulation.reactions()["ram"]
        largest = max(largest, np.abs(force).max())
        np.testing.assert_allclose(after - before, force * dt, rtol=0, atol=1e-10)
        assert (simulation.field("velocity")[rows][:, given] == wanted[given]).all()
        before = after
    assert not force[~given].any()
    assert largest > 1.0
    if given.all():
        way = simulation.field("displacement")[rows] - wanted * simulation.time
        assert np.abs(way).max() < 1e-13


def test_box_of_particles_with_a_free_component():
    """A bar pulled by a grip that lets it become thinner stays in uniaxial stress."""
    bar = cuboid([0, 0.2, 0.2], [1.0, 0.4, 0.4])
    grip = {"point_p1": [0.9, 0, 0], "point_p2": [1.0, 1, 1], "velocity": [1e-3, None, None]}
    case = scene(
        [12, 6, 6],
        0.1,
        [bar],
        time=1.0,
        critical_time_step_multiplier=0.5,
        damping={"type": "local", "value": 0.2},
        prescribed_velocity={"grip": grip | {"every": 1}},
    )
    simulation = simulate(case).run()
    stress = simulation.field("stress")
    middle = np.abs(simulation.field("position")[:, 0] - 0.45) < 0.1
    strain = 1e-3 * simulation.time / 0.9
    expected = RUBBER["young"] * strain
    assert stress[middle, 0] == pytest.approx(expected, rel=0.15)
    assert np.abs(stress[middle, 1:3]).max() < 0.05 * expected
    force = simulation.reactions()["grip"][0]
    assert force == pytest.approx(stress[middle, 0].mean() * 0.04, rel=0.02)


def test_planes_sheared_against_each_other():
    """Simple shear between rough plates: G γ × area on both."""
    shear = {"plane": "Zn", "velocity": [1e-3, 0, 0], "every": 1}
    case = scene(
        [3, 1, 4],
        0.25,
        [cuboid([0, 0, 0], [0.75, 0.25, 1.0])],
        time=1.0,
        critical_time_step_multiplier=0.5,
        boundary_conditions={"plane_Z0": "fixed", "plane_X0": "free", "plane_Xn": "free"},
        damping={"type": "local", "value": 0.2},
        prescribed_velocity=[shear],
    )
    reactions = simulate(case).run().reactions()
    assert reactions["prescribed_velocity_1"][0] == pytest.approx(-reactions["Z0"][0], rel=0.02)


def test_a_case_without_pays_nothing():
    solver = simulate(column(time=1.0)).solver
    assert solver.effect("tools") is None
    assert solver.effect("reactions") is None
    assert len(solver.sets) == 1
