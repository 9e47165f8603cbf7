"""Bodies on a terrain: at rest, sliding, sticking, falling; what contact must conserve."""

import numpy as np
import pytest
import terrains
from terrains import G, axes, on_slope, simulate

SCHEMES = ("USL", "MUSL", "USF", "NPC", "NPC-CD")
LAYER = 0.25  # cells: from the ground to the lowest particles


def heights(simulation, angle, cell=1.0):
    """Return how far particles lie above the plane [m], and which were the lowest at the start."""
    out = axes(angle)[1]
    position = simulation.field("position")
    start = (position - simulation.field("displacement")) @ out
    return position @ out, start < start.min() + 0.1 * cell


@pytest.mark.parametrize("scheme", SCHEMES)
@pytest.mark.parametrize(("angle", "gap"), [(0, 0.0), (0, 0.02), (20, 0.0)])
def test_a_resting_block_neither_hovers_nor_sinks(tmp_path, scheme, angle, gap):
    """Also one that has been dropped; undamped, on a slope it cannot slide down."""
    case = on_slope(tmp_path, angle, 2.0, size=(2, 1, 1), gap=gap, stress_scheme_update=scheme)
    simulation = simulate(case | {"time": 2.0})
    simulation.run(until=0.2 if gap else 0.0)
    worst = 0.0
    while simulation.time < 2.0:
        simulation.step(10)
        above, lowest = heights(simulation, angle)
        worst = max(worst, np.abs(above[lowest].mean() - LAYER))
        assert above.min() > LAYER - 1e-3
    assert worst < 1e-3


def slides(folder, angle, friction, scheme, time=1.0, **keys):
    """Return the way of a block down a plane, and what a rigid one does, in ½ g sin(angle) t²."""
    scale = 0.5 * G * np.sin(np.radians(angle)) * time**2
    case = on_slope(
        folder, angle, friction, (4, 3, 2), path=scale, stress_scheme_update=scheme, time=time
    )
    simulation = simulate(case | keys).run()
    way = simulation.field("displacement").mean(axis=0) @ axes(angle)[0]
    exact = max(0.0, 1 - friction / np.tan(np.radians(angle)))
    return way / scale, exact * (simulation.time / time) ** 2


@pytest.mark.parametrize("scheme", SCHEMES)
def test_sliding_on_a_tilted_plane(tmp_path, scheme):
    way, exact = slides(tmp_path, 30, 0.3, scheme)
    assert abs(way - exact) < 2e-3


def test_affine_particles_slide_as_others(tmp_path):
    way, exact = slides(tmp_path, 30, 0.3, "MUSL", transfer="tpic")
    assert abs(way - exact) < 2e-3


def test_without_friction_nothing_holds_a_block(tmp_path):
    way, exact = slides(tmp_path, 45, 0.0, "USL")
    assert abs(way - exact) < 1e-9


@pytest.mark.slow
@pytest.mark.parametrize("scheme", ["USL", "MUSL"])
@pytest.mark.parametrize("friction", [0.0, 0.1, 0.3, 0.5])
@pytest.mark.parametrize("angle", [20, 30, 45])
def test_sliding_at_all_angles(tmp_path, angle, friction, scheme):
    """Gravity comes suddenly: until the block has found its pressure, friction is less.

    That costs some millimetres, which count most where a block slides slowly; hence two seconds.
    """
    way, exact = slides(tmp_path, angle, friction, scheme, time=2.0)
    assert abs(way - exact) < 1e-2


@pytest.mark.parametrize("scheme", ["USL", "MUSL"])
@pytest.mark.parametrize(("angle", "factor"), [(20, 1.0), (45, 1.05)])
def test_friction_that_suffices_holds_a_block(tmp_path, angle, factor, scheme):
    friction = factor * np.tan(np.radians(angle))
    damping = {"type": "local", "value": 0.3}
    way, _ = slides(tmp_path, angle, friction, scheme, damping=damping)
    assert abs(way) < 1e-3


def test_momentum_is_balanced_by_weight_and_contact(tmp_path):
    """The forces in the files are those that act, to the last digits."""
    simulation = simulate(on_slope(tmp_path, 30, 0.3, path=2.0, gap=0.01))
    mass = simulation.field("mass")[:, None]
    momentum, impulse, size = np.zeros(3), np.zeros(3), 0.0
    for _ in range(300):
        h = simulation.time_step * (0.5 if simulation.steps == 0 else 1.0)
        simulation.step()
        force = simulation.field("particle_contact_force")
        impulse += h * ((mass * [0, 0, -G]).sum(axis=0) + force.sum(axis=0))
        size += h * G * mass.sum()
        momentum = (mass * simulation.field("velocity")).sum(axis=0)
        assert np.abs(momentum - impulse).max() < 1e-12 * max(size, 1.0)
    assert simulation.field("particle_contact_flag").any()


def test_friction_is_limited_and_pressure_pushes(tmp_path):
    simulation = simulate(on_slope(tmp_path, 30, 0.3, path=2.0)).step(200)
    normal = simulation.field("particle_contact_force_normal")
    along = simulation.field("particle_contact_force_tangential")
    down, out = axes(30)
    touching = simulation.field("particle_contact_flag") == 1
    assert 0 < touching.sum() < 0.3 * len(touching)
    assert not normal[~touching].any()
    assert not along[~touching].any()
    pressure = normal[touching] @ out
    assert (pressure > 0).all()
    assert normal[touching] == pytest.approx(pressure[:, None] * out, abs=1e-6 * pressure.max())
    assert np.linalg.norm(along[touching], axis=1) == pytest.approx(0.3 * pressure)
    assert (along[touching] @ down < 0).all()


def test_a_body_apart_from_the_ground_does_not_know_it(tmp_path):
    case = on_slope(tmp_path, 20, 0.5, gap=1.0)
    free = {key: value for key, value in case.items() if key != "terrain_contact"}
    runs = [simulate(keys).step(50) for keys in (case, free)]
    assert (runs[0].field("velocity") == runs[1].field("velocity")).all()
    assert not runs[0].field("particle_contact_force").any()


@pytest.mark.parametrize("scheme", ["USL", "MUSL"])
def test_any_number_of_threads_gives_the_same_bits(tmp_path, scheme):
    case = on_slope(tmp_path, 20, 0.2, path=0.5, stress_scheme_update=scheme)
    fields = []
    for threads in (1, 2):
        simulation = simulate(case | {"n_threads": threads})
        simulation.solver.small = False
        simulation.step(60)
        fields.append([simulation.field(key) for key in ("position", "particle_contact_force")])
    assert all((a == b).all() for a, b in zip(*fields, strict=True))


def record(folder, rows):
    path = folder / "record.csv"
    path.write_text("t,x,y,z\n" + "".join(f"{t},{x},{y},{z}\n" for t, x, y, z in rows))
    return {"active": True, "file": str(path), "header": True}


def test_a_slope_that_moves_carries_a_rough_block_along(tmp_path):
    """The ground moves as a whole: the block stays where it lies on it."""
    rows = [(0.0, 2, 1, 0), (0.5, 2, 1, 0), (0.5001, -2, -1, 0), (2.0, -2, -1, 0)]
    case = on_slope(tmp_path, 20, 2.0, (2, 1, 1), path=1.0, time=0.9)
    simulation = simulate(case | {"earthquake": record(tmp_path, rows)})
    exact = np.array([0.5 * 2 * 0.25 + 0.4 - 0.16, 0.125 + 0.2 - 0.08, 0.0])
    simulation.run()
    assert simulation.solver.ground.offset == pytest.approx(exact, abs=2e-3)
    assert simulation.field("displacement").mean(axis=0) == pytest.approx(exact, abs=5e-3)
    distance = simulation.field("distance_levelset")
    assert distance.min() == pytest.approx(LAYER, abs=1e-3)


def valley(x, y):
    """A channel that falls along x and runs out."""
    return 0.6 + 0.35 * y**2 + 0.6 * np.exp(-((x / 1.2) ** 2)) * (x > 0) + 0.6 * (x <= 0)


@pytest.mark.slow
def test_a_granular_flow_stays_above_a_curved_valley(tmp_path):
    """No particle gets below the surface by more than half its size."""
    file = tmp_path / "valley.stl"
    file.write_bytes(terrains.binary_of(terrains.patch(valley, -3.0, 6.0, 60)))
    sand = {"type": "mohr-coulomb", "id": 1, "density": 1800.0, "young": 2e6, "poisson": 0.3}
    sand |= {"friction": 30.0, "cohesion": 0.0, "dilation": 0.0}
    case = {
        "time": 1.2,
        "gravity": [0.0, 0.0, -G],
        "mesh": {
            "cells_number": [40, 16, 16],
            "cells_dimension": 3 * [0.2],
            "origin": [-2.0, -1.6, 0.0],
        },
        "materials": [sand],
        "body": [
            {"type": "cuboid", "point_p1": [-1.0, -0.6, 1.4], "point_p2": [0.4, 0.6, 2.2]}
            | {"material_id": 1}
        ],
        "terrain_contact": {"active": True, "stl_mesh": str(file), "friction": 0.4},
    }
    simulation = simulate(case)
    half, lowest = 0.05, np.inf
    while simulation.time < 1.2:
        simulation.step(20)
        lowest = min(lowest, simulation.field("distance_levelset").min())
    assert lowest > -half
    assert simulation.field("displacement")[:, 0].max() > 1.0
    assert simulation.field("active").all()
