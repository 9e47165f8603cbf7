"""Stresses of overburden at the start: exact under level ground, near to rest under a slope."""

import numpy as np
import pytest
from scenes import cuboid, scene, simulate

import mpmgeo

G, WATER = 10.0, 1000.0
STEADY = 1e-4  # largest unbalanced force at a node over the mean weight of nodes
ROUND_OFF = 1e-12
LAYERS = (  # from below: top [m], dry and saturated density, Young's modulus, Poisson's ratio, k0
    (2.0, 2200.0, 2200.0, 1e8, 0.2, None),
    (4.0, 1800.0, 2050.0, 8e6, 0.35, 0.6),
    (6.0, 1600.0, 1900.0, 2e7, 0.3, None),
)
TABLE = 3.0
FLUID = {"density_fluid": WATER, "bulk_fluid": 2e8, "hydraulic_conductivity": [1e-4] * 3}


def ground(axis=2, up=1.0, origin=(0.0, 0.0, 0.0), width=2, **keys):
    """Return a case of level ground in layers, whose heights run along an axis in a direction."""
    cell, edge, o = 0.25, 0.25 * width, np.array(origin)
    top = LAYERS[-1][0]

    def corner(side, height):
        x = np.full(3, side)
        x[axis] = height if up > 0 else top - height
        return x + o

    bodies, materials, bottom = [], [], 0.0
    for id, (height, dry, wet, young, poisson, k0) in enumerate(LAYERS, 1):
        corners = np.sort([corner(0.0, bottom), corner(edge, height)], axis=0).tolist()
        bodies.append(cuboid(*corners, material_id=id))
        law = {"type": "elastic", "id": id, "density": dry, "density_saturated": wet}
        law |= {"young": young, "poisson": poisson} | ({} if k0 is None else {"k0": k0})
        materials.append(law)
        bottom = height
    cells, gravity = [width] * 3, [0.0] * 3
    cells[axis], gravity[axis] = round(top / cell), -G * up
    table = float(corner(0.0, TABLE)[axis])
    case = {"time": 1.0, "gravity": gravity, "materials": materials, "origin": list(origin)}
    return scene(cells, cell, bodies, **case | {"initial_stress": {"water_table": table}} | keys)


def exact(height):
    """Return σv, u [Pa] and K0 of points at heights (n,) [m] in the layers."""
    total, k0, bottom = np.zeros(len(height)), np.empty(len(height)), 0.0
    for top, dry, wet, _, poisson, given in LAYERS:
        for density, low, high in (
            (wet, bottom, np.clip(TABLE, bottom, top)),
            (dry, np.clip(TABLE, bottom, top), top),
        ):
            total += G * density * (high - np.clip(height, low, high))
        k0[height > bottom] = poisson / (1 - poisson) if given is None else given
        bottom = top
    return total, WATER * G * np.maximum(TABLE - height, 0.0), k0


def unbalanced(simulation):
    """Return the largest force that moves a node over the mean weight of all nodes, with USL."""
    solid = simulation.solver.grid.solid
    m, a = solid.at_nodes("mass"), solid.at_nodes("acceleration")
    weight = m[m > 0].mean() * np.linalg.norm(simulation.solver.gravity)
    return float((m * np.linalg.norm(a, axis=1)).max() / weight)


@pytest.mark.parametrize("shape", ["GIMP", "quadratic-bspline"])
def test_level_ground_is_at_rest(shape):
    """Stresses are exact; GIMP rests to round-off, splines but for what they smear at layers."""
    simulation = simulate(ground(shape_function=shape))
    total, u, k0 = exact(simulation.field("position")[:, 2])
    stress = simulation.field("stress")
    np.testing.assert_allclose(stress[:, 2], u - total, rtol=1e-9)
    np.testing.assert_allclose(stress[:, :2], np.outer(k0 * (u - total), [1, 1]), rtol=1e-9)
    np.testing.assert_allclose(simulation.field("pressure"), u, atol=1e-6)
    assert not stress[:, 3:].any()
    simulation.step()
    assert unbalanced(simulation) < (ROUND_OFF if shape == "GIMP" else 0.1)
    simulation.step(300)
    np.testing.assert_allclose(simulation.field("stress")[:, 2], u - total, rtol=0.01, atol=200)
    settled = np.abs(simulation.field("displacement")).max()
    assert settled < (1e-15 if shape == "GIMP" else 1e-5)
    assert not simulation.warnings


def steps_to_rest(case, most=4000):
    """Return after how many steps the ground is at rest."""
    simulation = simulate(case)
    for _ in range(0, most, 20):
        simulation.step(20)
        if unbalanced(simulation) < STEADY:
            return simulation.steps
    return most


def test_gravity_from_nothing_takes_far_longer():
    damping = {"type": "kinetic"}
    begun = steps_to_rest(ground(damping=damping))
    case = ground(damping=damping)
    del case["initial_stress"]
    assert 10 * begun <= steps_to_rest(case)


@pytest.mark.parametrize(("axis", "up"), [(0, 1.0), (1, -1.0)])
def test_gravity_along_any_axis_and_mesh_at_any_origin(axis, up):
    simulation = simulate(ground(axis, up, origin=(5e5, 4e6, -100.0)))
    x = simulation.field("position")[:, axis] - (5e5, 4e6, -100.0)[axis]
    total, u, k0 = exact(x if up > 0 else LAYERS[-1][0] - x)
    stress = simulation.field("stress")
    np.testing.assert_allclose(stress[:, axis], u - total, rtol=1e-6)
    np.testing.assert_allclose(stress[:, 2], k0 * (u - total), rtol=1e-6)
    simulation.step(20)
    assert np.abs(simulation.field("displacement")).max() < 1e-8  # doubles resolve 1e-9


def test_two_phases_rest_under_a_table_at_the_ground():
    case = ground(n_phases=2, initial_stress={"water_table": LAYERS[-1][0]})
    for number, law in enumerate(case["materials"]):
        del law["density_saturated"]
        law |= FLUID | {"porosity": 0.3 + 0.05 * number, "density": 2600.0 + 50 * number}
    low, high = [0, 0, 5.75], [0.5, 0.5, 6]
    case["prescribed_pressure_box"] = [{"point_p1": low, "point_p2": high, "pressure": 0.0}]
    simulation = simulate(case)
    z = simulation.field("position")[:, 2]
    p = simulation.field("pressure")
    np.testing.assert_allclose(p, np.where(z > 5.75, 0.0, WATER * G * (6 - z)), atol=1e-6)
    density, above = simulation.field("density"), np.zeros(len(z))
    for top, layer in zip((2.0, 4.0, 6.0), (0, 1, 2), strict=True):
        mixture = density[(z > top - 2) & (z < top)][0]
        above += G * mixture * (top - np.clip(z, 2 * layer, top))
    np.testing.assert_allclose(simulation.field("stress")[:, 2], p - above, rtol=1e-9)
    del case["prescribed_pressure_box"]
    simulation = simulate(case).step()
    assert unbalanced(simulation) < ROUND_OFF
    simulation.step(300)
    assert np.abs(simulation.field("displacement")).max() < 1e-12
    assert np.abs(simulation.field("velocity_fluid")).max() < 1e-10


def slope(**keys):
    """Return a case of a slope 5 m high in soil that holds it."""
    points = [[0, 0, 0], [15, 0, 0], [15, 0, 3], [11, 0, 3], [6, 0, 8], [0, 0, 8]]
    body = {"type": "polygon_2d", "points": points, "extrude_direction": "y"}
    soil = {"type": "mohr-coulomb", "id": 1, "density": 2000.0, "young": 2e7, "poisson": 0.3}
    soil |= {"friction": 35.0, "cohesion": 2e4, "density_saturated": 2100.0}
    case = {"materials": [soil], "gravity": [0, 0, -G], "time": 1.0}
    case |= {"initial_stress": {"water_table": 2.0}, "damping": {"type": "local", "value": 0.5}}
    case["boundary_conditions"] = {"plane_Z0": "fixed"}
    return scene([15, 1, 10], 1.0, [body | {"extrude_displacement": 1.0}], **case | keys)


def test_a_slope_comes_to_rest():
    """Columns know nothing of their neighbours: shear grows until nothing is unbalanced."""
    simulation = simulate(slope()).step()
    assert unbalanced(simulation) < 1.0
    simulation.step(1500)
    assert unbalanced(simulation) < STEADY
    assert np.abs(simulation.field("displacement")).max() < 0.01


def test_fluid_has_the_pressure_of_its_depth():
    water = {"type": "newtonian", "id": 1, "density": 1000.0, "bulk": 1e7, "viscosity": 1e-3}
    keys = {"initial_stress": {"k0": 0.5, "water_table": 1.0}, "gravity": [0, 0, -G], "time": 1.0}
    case = scene([2, 2, 8], 0.25, [cuboid([0, 0, 0], [0.5, 0.5, 1.5])], materials=[water], **keys)
    simulation = simulate(case)
    z = simulation.field("position")[:, 2]
    pressure = -np.outer(1e4 * (1.5 - z), [1, 1, 1])
    np.testing.assert_allclose(simulation.field("stress")[:, :3], pressure)
    assert not simulation.field("pressure").any()
    assert np.abs(simulation.step(50).field("displacement")).max() < 1e-14


def test_water_above_the_ground_is_no_load():
    """Pressures count from the ground, where the case has nothing that carries the water."""
    simulation = simulate(ground(initial_stress={"water_table": 8.0}))
    assert any("stands above the ground" in message for message in simulation.messages)
    assert any("above all bodies" in warning for warning in simulation.warnings)
    z = simulation.field("position")[:, 2]
    np.testing.assert_allclose(simulation.field("pressure"), WATER * G * (6 - z))
    assert unbalanced(simulation.step()) < ROUND_OFF


def test_a_body_that_is_held_presses_on_nothing():
    blocks = [cuboid([0, 0, 0], [0.5, 0.5, 1]), cuboid([0, 0, 1], [0.5, 0.5, 2])]
    keys = {"gravity": [0, 0, -G], "initial_stress": {}, "time": 1.0}
    held = {"body": 2, "velocity": [0, 0, 0]}
    for tools, above in ([], 1.0), ([held], 0.0):
        case = scene([2, 2, 8], 0.25, blocks, prescribed_velocity=tools, **keys)
        z, stress = (simulate(case).field(key)[:, 2] for key in ("position", "stress"))
        lower = z < 1
        np.testing.assert_allclose(-stress[lower], 1000 * G * (1 + above - z[lower]))


def test_a_run_that_goes_on_has_the_stresses_of_its_snapshot(tmp_path):
    case = slope(initial_stress={"water_table": 4.0, "k0": 0.5})
    whole = simulate(case).step(60)
    simulate(case).step(25).save(tmp_path / "snapshot")
    resumed = mpmgeo.Simulation.resume(tmp_path / "snapshot")
    assert not any("initial_stress" in message for message in resumed.messages)
    resumed.step(35)
    for key in ("position", "velocity", "stress", "pressure", "mass", "displacement"):
        assert np.array_equal(whole.field(key), resumed.field(key)), key
    with pytest.raises(ValueError, match="initial_stress"):
        other = slope(initial_stress={"water_table": 3.0, "k0": 0.5})
        mpmgeo.Simulation.resume(tmp_path / "snapshot", other, allow=["initial_stress"])
