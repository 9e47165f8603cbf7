"""Far from (0, 0, 0), as in UTM coordinates: bodies, motion and terrain as near by."""

from pathlib import Path

import numpy as np
import pytest
import terrains

import mpmgeo
from mpmgeo.case.building.lint import lint
from mpmgeo.run.watch import Diverged

EAST, NORTH = 500_000.0, 4_500_000.0  # m
FREE = terrains.FREE
FAILING = Path(__file__).parents[2].parent / "shared" / "failing"
needs_inputs = pytest.mark.skipif(not FAILING.is_dir(), reason="needs ../shared/failing")


def block(low, high, cells=(4, 6, 4), cell=0.1, **keys):
    """Return the case of a block between two corners; the mesh begins at (EAST, NORTH, 0)."""
    return {
        "time": 1.0,
        "mesh": {
            "cells_number": list(cells),
            "cells_dimension": 3 * [cell],
            "origin": [EAST, NORTH, 0.0],
            "boundary_conditions": FREE,
        },
        "materials": [{"type": "elastic", "id": 1, "density": 2e3, "young": 1e6, "poisson": 0.2}],
        "body": [{"type": "cuboid", "point_p1": low, "point_p2": high, "material_id": 1}],
    } | keys


def simulate(case, **options):
    return mpmgeo.Simulation(mpmgeo.load_case(case), **options)


# Bodies


@pytest.mark.parametrize("cell", [0.1, 0.05])
def test_round_off_in_coordinates_adds_no_layer(cell):
    """Corners as typed, whose difference is off by up to 2e-8 cells."""
    for first in np.arange(1, 40):
        low = [round(EAST + 0.1 * first, 2), round(NORTH + 0.1 * first, 2), 0.0]
        high = [round(low[0] + 0.1, 2), round(low[1] + 0.1, 2), 0.2]
        case = block(low, high, cell=cell)
        case["mesh"]["cells_number"] = 3 * [84]
        simulation = simulate(case)
        assert simulation.field("mass").sum() == pytest.approx(4.0)
        assert not simulation.messages


def test_what_doubles_resolve_still_counts():
    """A millimetre too much is another layer, as anywhere."""
    case = block([EAST + 0.1, NORTH + 0.1, 0.0], [EAST + 0.2, NORTH + 0.201, 0.2])
    simulation = simulate(case)
    assert simulation.field("mass").sum() == pytest.approx(8.0)
    assert "2 whole cells" in simulation.messages[0]


def test_a_polygon_gets_the_particles_that_it_gets_near_by():
    """Its slope goes through the centres of particles, which round-off must not decide about."""
    counts = set()
    for east, north in ((0.0, 0.0), (EAST, NORTH)):
        case = block([0, 0, 0], [1, 1, 1], cells=(12, 12, 12))
        case["mesh"]["origin"] = [east, north, 0.0]
        corners = [[0.1, 0.1, 0.1], [1.1, 0.1, 0.1], [1.1, 1.1, 0.1], [0.4, 0.4, 0.1]]
        prism = {
            "type": "polygon_2d",
            "points": [[x + east, y + north, z] for x, y, z in corners],
            "extrude_direction": "z",
            "extrude_displacement": 0.3,
            "material_id": 1,
        }
        case["body"] = [prism]
        counts.add(simulate(case).solver.count)
    assert len(counts) == 1


# Motion


def carried(velocity, **keys):
    """Return the case of a block that has a velocity along all axes, for 10⁴ steps."""
    keys |= {"time": 0.5, "time_step": 5e-5}
    motion = {"body": 1, "velocity": 3 * [velocity], "name": "p", "every": 10_000}
    case = block([EAST + 0.1, NORTH + 0.1, 0.1], [EAST + 0.2, NORTH + 0.3, 0.2], **keys)
    return case | {"prescribed_velocity": [motion]}


@pytest.mark.parametrize("velocity", [4e-6, 1e-4])
def test_slow_motion_is_not_rounded_away(velocity):
    """A step is a fifth of what doubles resolve of such coordinates; 10⁴ steps are v t."""
    simulation = simulate(carried(velocity)).step(10_000)
    way = velocity * 0.5
    assert np.abs(simulation.field("displacement") / way - 1).max() < 5e-7


# Terrain


def valley(folder, east=0.0, north=0.0, write=None):
    """Return the case of a soft block that falls into a valley of triangles of ¼ to 1 m."""
    corner = terrains.patch(lambda x, y: 0.02 * (x - 4) ** 2 + 0.0 * y, -0.25, 8.25, 17)
    path = folder / f"valley_{east:g}.stl"
    path.write_bytes(write(corner + [east, north, 0.0]))
    return {
        "time": 0.4,
        "gravity": [0.0, 0.0, -9.81],
        "mesh": {
            "cells_number": [32, 2, 8],
            "cells_dimension": 3 * [0.25],
            "origin": [east, north + 4.0, 0.0],
        },
        "materials": [{"type": "elastic", "id": 1, "density": 1800, "young": 1e6, "poisson": 0.3}],
        "body": [
            {
                "type": "cuboid",
                "point_p1": [east + 1.5, north + 4.0, 0.25],
                "point_p2": [east + 2.5, north + 4.5, 0.75],
                "material_id": 1,
            }
        ],
        "terrain_contact": {"active": True, "stl_mesh": str(path), "friction": 0.2},
        "results": {"print": 1, "material_point_results": ["distance_levelset"]},
    }


def as_text(corner):
    return terrains.text_of(corner).encode()


def test_a_terrain_of_text_keeps_its_triangles(tmp_path):
    """Contact is the same, bit by bit, since all these coordinates are exact."""
    near = simulate(valley(tmp_path, write=as_text))
    far = simulate(valley(tmp_path, EAST, NORTH, write=as_text))
    assert not [m for m in far.messages if "left out" in m]
    assert lint(far) == []
    for _ in range(4):
        for simulation in (near, far):
            simulation.step(50)
        for key in ("displacement", "distance_levelset", "particle_contact_force"):
            np.testing.assert_array_equal(far.field(key), near.field(key))
    assert far.field("distance_levelset").min() > 0.1  # it would have fallen 1 m


def test_a_binary_terrain_is_as_coarse_as_single_precision_and_says_so(tmp_path):
    case = valley(tmp_path, EAST, NORTH, write=terrains.binary_of)
    (warning,) = (text for text in lint(simulate(case)) if "coordinates" in text)
    assert "valley_500000.stl: the file holds its coordinates to 0.54 m only" in warning
    assert "cells are 0.25 m" in warning
    assert lint(simulate(valley(tmp_path, write=terrains.binary_of))) == []


# What users see


def test_messages_and_files_have_the_users_coordinates(tmp_path):
    """A particle that leaves, the one that diverges, and points in files."""
    pyvista = pytest.importorskip("pyvista")
    low, high = [EAST + 0.1, NORTH + 0.1, 0.1], [EAST + 0.2, NORTH + 0.2, 0.2]
    case = block(low, high, time=0.02, time_step=1e-4)
    case["body"][0]["initial_velocity"] = [0.0, 60.0, 0.0]
    case["results"] = {"print": 2, "material_point_results": ["displacement"]}
    simulation = simulate(case, output=tmp_path)
    simulation.run()
    (leaves,) = (text for text in simulation.messages if "first is particle" in text)
    place = leaves.partition("at (")[2].partition(")")[0]
    x, y, z = map(float, place.split(", "))
    assert abs(x - EAST - 0.125) < 0.06 and y > NORTH + 0.6 and 0 < z < 0.4
    points = pyvista.read(tmp_path / "particles" / "particles_1.vtu").points
    assert points.min(axis=0) == pytest.approx([EAST + 0.125, NORTH + 0.125, 0.125], abs=1e-8)
    grid = pyvista.read(tmp_path / "grid" / "eulerianGrid_1.vtu").points
    assert grid.min(axis=0) == pytest.approx([EAST - 0.2, NORTH - 0.2, -0.2], abs=1e-8)
    nodes = simulate(case).step().nodes().position
    assert (nodes.min(axis=0) > [EAST - 0.2, NORTH - 0.2, -0.2]).all()


def test_the_place_where_a_run_diverges_is_the_users():
    low, high = [EAST + 0.1, NORTH + 0.1, 0.1], [EAST + 0.2, NORTH + 0.2, 0.2]
    simulation = simulate(block(low, high))
    velocity = simulation.field("velocity")
    velocity[3] = 1e9
    simulation.assign("velocity", velocity)
    with pytest.raises(Diverged, match=r"at \(5000\d\d.*, 45000\d\d.*, .*\) m has a speed"):
        simulation.check()


def test_a_run_goes_on_bit_by_bit_from_a_snapshot(tmp_path):
    case = valley(tmp_path, EAST, NORTH, write=as_text)
    whole = simulate(case).step(50)
    whole.save(tmp_path / "state.npz")
    resumed = mpmgeo.Simulation.resume(tmp_path / "state.npz")
    for simulation in (whole, resumed):
        simulation.step(50)
    for key in ("position", "velocity", "stress"):
        np.testing.assert_array_equal(whole.field(key), resumed.field(key))


# The inputs that showed the faults


@needs_inputs
def test_reported_cuboid():
    simulation = mpmgeo.Simulation(mpmgeo.load_case(FAILING / "utm-cuboid-layer" / "case.json"))
    assert simulation.solver.count == 16
    assert simulation.field("mass").sum() == pytest.approx(4.0)


@needs_inputs
@pytest.mark.parametrize("name", ["case", "case_1e_5", "case_4e_6"])
def test_reported_slow_motion(name):
    path = FAILING / "utm-slow-motion" / f"{name}.json"
    case = mpmgeo.load_case(path)
    simulation = mpmgeo.Simulation(case).run()
    way = case.prescribed_velocity[0].velocity[1] * simulation.time
    assert np.abs(simulation.field("displacement")[:, 1] / way - 1).max() < 5e-7


@needs_inputs
@pytest.mark.slow
def test_reported_terrain():
    folder = FAILING / "utm-terrain-valley"
    far, near = (
        mpmgeo.Simulation(mpmgeo.load_case(path))
        for path in (folder / "case.json", folder / "origin" / "case.json")
    )
    lowest = np.inf
    while far.time < far.case.time - 0.5 * far.time_step:
        for simulation in (far, near):
            simulation.step(100)
        lowest = min(lowest, far.field("distance_levelset").min())
        assert np.abs(far.field("displacement") - near.field("displacement")).max() < 1e-8
    assert lowest > 0.06
