"""Solid and fluid together: falling, hitting, standing still, held by planes, pressed by a load."""

import numpy as np
import pytest
from scenes import cuboid, initial_position, scene, simulate, sphere

from mpmgeo.verify.free_fall import displacement, kinetic_energy

SOIL = {
    "type": "elastic",
    "id": 1,
    "density": 2600.0,
    "young": 1e6,
    "poisson": 0.25,
    "density_fluid": 1000.0,
    "porosity": 0.4,
    "bulk_fluid": 1e7,
    "hydraulic_conductivity": [1e-3, 1e-3, 1e-3],
}
SIDES = ("plane_X0", "plane_Y0", "plane_Z0", "plane_Xn", "plane_Yn", "plane_Zn")
SCHEMES = pytest.mark.parametrize("scheme", ["USL", "MUSL"])


def saturated(cells, cell, bodies, walls="free", **keys):
    """Return a case of two phases; `walls`: kind of all planes for the fluid, or each by name."""
    case = scene(cells, cell, bodies, **({"n_phases": 2, "materials": [SOIL]} | keys))
    kinds = dict.fromkeys(SIDES, walls) if isinstance(walls, str) else walls
    case["mesh"]["boundary_conditions_fluid"] = kinds
    return case


def momentum(simulation):
    fluid = simulation.field("mass_fluid")
    solid = simulation.field("mass") - fluid
    return solid @ simulation.field("velocity") + fluid @ simulation.field("velocity_fluid")


@SCHEMES
def test_free_fall(scheme):
    """Both phases fall together, without any pressure."""
    gravity = [1.0, 0.0, -9.81]
    ball = sphere([0.5, 0.5, 0.7], 0.3)
    planes = dict.fromkeys(SIDES, "free")
    case = saturated(
        3 * [10], 0.1, [ball], time=0.2, gravity=gravity, stress_scheme_update=scheme,
        boundary_conditions=planes,
    )  # fmt: skip
    simulation = simulate(case).run()
    time, step = simulation.time, simulation.time_step
    fall = displacement(np.array(gravity), time)
    assert np.abs(simulation.field("displacement") - fall).max() < 1e-13
    relative = simulation.field("velocity_fluid") - simulation.field("velocity")
    assert np.abs(relative).max() < 1e-12
    assert np.abs(simulation.field("pressure")).max() < 1e-6
    mass = simulation.field("mass").sum()
    energy = kinetic_energy(mass, np.array(gravity), time, step)
    assert simulation.kinetic_energy() == pytest.approx(energy, rel=1e-11)


@SCHEMES
@pytest.mark.parametrize("smooth", [True, False])
def test_momentum_of_colliding_spheres(scheme, smooth):
    """Of different porosity and conductivity; 1e-12 of the momentum that flies about."""
    other = SOIL | {"id": 2, "porosity": 0.2, "hydraulic_conductivity": [1e-2, 1e-4, 1e-3]}
    bodies = [
        sphere([0.45, 0.6, 0.55], 0.4, initial_velocity=[2.0, 0.3, 0.0]),
        sphere([1.05, 0.6, 0.65], 0.4, initial_velocity=[-1.0, 0.0, 0.2], material_id=2),
    ]
    case = saturated(
        [16, 12, 12], 0.1, bodies, time=0.3, critical_time_step_multiplier=0.3,
        stress_scheme_update=scheme, materials=[SOIL, other], pore_pressure_smoothing=smooth,
    )  # fmt: skip
    simulation = simulate(case)
    before, energy = momentum(simulation), simulation.kinetic_energy()
    size = simulation.field("mass") @ np.linalg.norm(simulation.field("velocity"), axis=1)
    for _ in range(3):
        simulation.run(until=simulation.time + 0.1)
        assert np.abs(momentum(simulation) - before).max() < 1e-12 * size
        # relative motion comes and goes; the energy never grows
        assert simulation.kinetic_energy() < energy
    assert simulation.kinetic_energy() < 0.6 * energy
    assert np.abs(simulation.field("pressure")).max() > 1e4
    assert simulation.field("active").all()


def layers(scheme, smooth=True, **keys):
    """Return two layers of different porosity and conductivity, in equilibrium under water."""
    h, height, middle, g = 0.25, 4.0, 2.0, 9.81
    lower = SOIL | {"porosity": 0.3, "young": 2e7, "bulk_fluid": 1e8}
    upper = lower | {"id": 2, "porosity": 0.5, "hydraulic_conductivity": 3 * [1e-4]}
    bodies = [
        cuboid([0, 0, 0], [h, h, middle]),
        cuboid([0, 0, middle], [h, h, height], material_id=2),
    ]
    case = saturated(
        [1, 1, 18], h, bodies, walls="sliding", time=0.3, critical_time_step_multiplier=0.5,
        gravity=[0, 0, -g], materials=[lower, upper], stress_scheme_update=scheme,
        pore_pressure_smoothing=smooth, **keys,
    )  # fmt: skip
    simulation = simulate(case)
    depth = height - simulation.field("position")[:, 2]
    pressure = 1000 * g * depth
    simulation.assign("pressure", pressure)
    light, heavy = (0.5 * 2600 + 0.5 * 1000) * g, (0.7 * 2600 + 0.3 * 1000) * g
    total = np.where(depth < middle, light * depth, light * middle + heavy * (depth - middle))
    stress = np.zeros((len(depth), 6))
    stress[:, 2] = pressure - total
    stress[:, :2] = stress[:, 2:3] / 3
    simulation.assign("stress", stress)
    return simulation, pressure


@SCHEMES
@pytest.mark.parametrize("smooth", [True, False])
def test_saturated_layers_at_rest_stay_at_rest(scheme, smooth):
    """A jump of porosity moves no water: the pressure, not porosity times pressure, drives it."""
    simulation, pressure = layers(scheme, smooth)
    simulation.run()
    for phase in "velocity", "velocity_fluid":
        assert np.abs(simulation.field(phase)).max() < 1e-13
    if not smooth:
        assert simulation.field("pressure") == pytest.approx(pressure, rel=1e-12)
    assert simulation.field("displacement") == pytest.approx(0, abs=1e-14)


@SCHEMES
def test_a_base_that_does_not_move_changes_nothing(scheme, tmp_path):
    """Base motion of zero: the wall of the fluid goes with the base."""
    record = tmp_path / "still.csv"
    record.write_text("t,x,y,z\n0,0,0,0\n9,0,0,0\n")
    simulation, _ = layers(scheme, earthquake={"active": True, "file": str(record)})
    simulation.run()
    assert np.abs(simulation.field("velocity_fluid")).max() < 1e-13


@SCHEMES
def test_a_base_takes_both_phases_along(scheme, tmp_path):
    """It starts with a jolt; a little later solid and water move with it."""
    record = tmp_path / "push.csv"
    record.write_text("t,x,y,z\n0,0,0,1\n9,0,0,1\n")
    keys = {"earthquake": {"active": True, "file": str(record)}}
    simulation, _ = layers(scheme, damping={"type": "local", "value": 0.2}, **keys)
    simulation.run()
    base = simulation.time - simulation.time_step / 2
    low = simulation.field("position")[:, 2] < 0.25
    for phase in "velocity", "velocity_fluid":
        assert simulation.field(phase)[low, 2] == pytest.approx(base, rel=0.1)
    relative = simulation.field("velocity_fluid") - simulation.field("velocity")
    assert np.abs(relative[low]).max() < 0.01 * base


def seeping(walls, **keys):
    """Return a block of soil that is held, whose water gravity draws through it."""
    planes = dict.fromkeys(SIDES, "fixed")
    case = saturated(
        [2, 2, 8], 0.25, [cuboid([0, 0, 0], [0.5, 0.5, 2.0])], walls=walls, time=0.2,
        critical_time_step_multiplier=0.5, gravity=[0, 0, -9.81], boundary_conditions=planes,
        **keys,
    )  # fmt: skip
    stiff = {"young": 1e9, "bulk_fluid": 1e8, "hydraulic_conductivity": [1e-3, 1e-3, 2e-3]}
    case["materials"] = [SOIL | stiff]
    return simulate(case).run()


def test_darcy_and_the_walls_of_the_fluid():
    """Through open planes water under its own weight flows at k; a closed floor holds it."""
    sides = dict.fromkeys(SIDES[:2] + SIDES[3:5], "sliding")
    inner = lambda z: (z > 0.5) & (z < 1.5)  # noqa: E731
    through = seeping(sides | {"plane_Z0": "free", "plane_Zn": "free"})
    z = through.field("position")[:, 2]
    speed = through.field("velocity_fluid")[inner(z), 2] - through.field("velocity")[inner(z), 2]
    assert 0.4 * speed == pytest.approx(-2e-3, rel=0.01)
    assert np.abs(through.field("pressure")[inner(z)]).max() < 100
    held = seeping(sides | {"plane_Z0": "fixed", "plane_Zn": "free"})
    relative = held.field("velocity_fluid")[:, 2] - held.field("velocity")[:, 2]
    assert np.abs(relative).max() < 0.3 * np.abs(speed).max()
    assert held.field("pressure")[z < 0.5].min() > 0.8 * 1.5 * 9810


def test_pressures_and_forces_on_the_fluid():
    """Later keys win; a prescribed pressure stays; a force on the fluid pushes the solid back."""
    low, high = [0, 0, 0], [0.5, 0.5, 0.5]
    half = {"point_p1": low, "point_p2": [0.5, 0.5, 0.25]}
    far = {"point_p1": [1, 1, 1], "point_p2": [2, 2, 2]}
    case = saturated(
        [4, 4, 4], 0.5, [cuboid(low, high), cuboid([1, 1, 1], [1.5, 1.5, 1.5], material_id=2)],
        time=0.01, materials=[SOIL, SOIL | {"id": 2}],
        boundary_conditions=dict.fromkeys(SIDES, "free"),
        initial_pressure_box=[{"point_p1": low, "point_p2": [2, 2, 2], "pressure": 5.0}],
        initial_pressure_material=[{"material_id": 2, "pressure": 7.0}],
        prescribed_pressure_box=[half | {"pressure": 11.0}],
        pressure_force_box=[far | {"pressure_force": [0, 0, 2]}],
    )  # fmt: skip
    simulation = simulate(case)
    start = simulation.field("pressure")
    np.testing.assert_array_equal(np.unique(start[:8]), [5.0, 11.0])
    assert (start[8:] == 7.0).all()
    before = momentum(simulation)
    simulation.step(20)
    np.testing.assert_array_equal(simulation.field("pressure")[start == 11.0], 11.0)
    assert not (simulation.field("pressure")[start == 5.0] == 5.0).any()
    relative = simulation.field("velocity_fluid") - simulation.field("velocity")
    assert relative[8:, 2].mean() < 0
    assert momentum(simulation) == pytest.approx(before, abs=1e-12)


def footing(**keys):
    """Return the simulation of a strip load on saturated soil that has no time to drain."""
    nx, nz, h = 16, 8, 0.25
    soil = SOIL | {"density": 2650.0, "young": 1e7, "poisson": 0.3, "bulk_fluid": 5e8}
    soil["hydraulic_conductivity"] = 3 * [1e-6]
    top = {"point_p1": [0, 0, nz * h - h / 2], "point_p2": [1.0, h, nz * h]}
    case = saturated(
        [nx, 1, nz + 2], h, [cuboid([0, 0, 0], [nx * h, h, nz * h])], walls={"plane_Zn": "free"},
        time=0.12, critical_time_step_multiplier=0.5, materials=[soil],
        damping={"type": "local", "value": 0.3},
        boundary_conditions={"plane_Z0": "fixed", "plane_Zn": "free"},
        load_distributed_box=[top | {"load": [0, 0, -1e4 * h]}], **keys,
    )  # fmt: skip
    simulation = simulate(case).run()
    i, _, k = (initial_position(simulation) / h).astype(int).T
    pressure = simulation.field("pressure").reshape(-1)
    count, total = np.zeros((nx, nz)), np.zeros((nx, nz))
    np.add.at(count, (i, k), 1)
    np.add.at(total, (i, k), pressure)
    mean = total / count
    return simulation, mean, pressure - mean[i, k]


def test_no_checkerboard_under_a_footing():
    """Pressures of 1e4 Pa: smooth within cells and between them, and the soil does not lock."""
    simulation, mean, inside = footing()
    load = 1e4
    assert np.sqrt((inside**2).mean()) < 0.02 * load  # what the last step did
    checkerboard = (mean[:-1, :-1] - mean[1:, :-1] - mean[:-1, 1:] + mean[1:, 1:]) / 4
    assert np.abs(checkerboard[:, :-3]).max() < 0.01 * load  # the load's edge is above
    assert mean[0, 3:6].min() > 0.3 * load
    rough, _, spread = footing(pore_pressure_smoothing=False)
    assert np.sqrt((spread**2).mean()) > 0.2 * load
    settlement = [s.field("displacement")[:, 2].min() for s in (simulation, rough)]
    assert settlement[0] < 1.2 * settlement[1] < 0


@SCHEMES
def test_damping_acts_on_both_phases(scheme):
    """Local and kinetic damping bring a column of water and grains to rest."""
    for damping in {"type": "local", "value": 0.5}, {"type": "kinetic"}:
        h = 0.25
        case = saturated(
            [1, 1, 10], h, [cuboid([0, 0, 0], [h, h, 2.0])], walls="sliding", time=1.5,
            critical_time_step_multiplier=0.5, gravity=[0, 0, -9.81], damping=damping,
            materials=[SOIL | {"young": 2e7, "bulk_fluid": 1e8}], stress_scheme_update=scheme,
        )  # fmt: skip
        simulation = simulate(case).run()
        mass = simulation.field("mass").sum()
        assert simulation.kinetic_energy() < 1e-5 * mass * 9.81 * 2e-3
        bulk = 0.6 * 2600 + 0.4 * 1000
        z = initial_position(simulation)[:, 2]
        total = simulation.field("stress")[:, 2] - simulation.field("pressure")
        pairs = [a.reshape(-1, 8).mean(axis=1) for a in (total, -bulk * 9.81 * (2.0 - z))]
        assert pairs[0] == pytest.approx(pairs[1], abs=0.02 * bulk * 9.81 * 2.0)


@SCHEMES
def test_a_tight_piston(scheme):
    """A plane that presses on a closed chamber: both phases take the same strain, and bear it."""
    h, speed = 0.25, 1e-3
    case = saturated(
        [1, 1, 8], h, [cuboid([0, 0, 0], [h, h, 2.0])], walls="sliding", time=0.3,
        critical_time_step_multiplier=0.5, stress_scheme_update=scheme,
        damping={"type": "local", "value": 0.3},
        materials=[SOIL | {"young": 2e7, "bulk_fluid": 1e8}],
        prescribed_velocity={"piston": {"plane": "Zn", "velocity": [None, None, -speed]}},
        results={"probes": [{"type": "planes", "every": 1}]},
    )  # fmt: skip
    simulation = simulate(case).run()
    strain = speed * simulation.time / 2.0
    pressure = 1e8 / 0.4 * strain
    assert simulation.field("pressure") == pytest.approx(pressure, rel=0.02)
    stress = -2e7 * 0.75 / (1.25 * 0.5) * strain
    cells = simulation.field("stress")[:, 2].reshape(-1, 8).mean(axis=1)
    assert cells == pytest.approx(stress, rel=0.06)  # the piston begins abruptly
    forces = simulation.reactions()
    area = h * h
    assert forces["piston"][2] == pytest.approx((stress - pressure) * area, rel=0.03)
    assert forces["Z0"][2] == pytest.approx((pressure - stress) * area, rel=0.03)
    assert forces["X0"][0] == pytest.approx((pressure - stress / 3) * h * 2.0, rel=0.03)


def test_small_strains_of_a_neo_hookean_skeleton_are_those_of_hooke():
    """A layer that a load presses: stresses, pressures and porosities of both laws, to 1e-4."""
    found = []
    for kind in ("elastic", "neo-hookean"):
        load = {"point_p1": [0, 0, 0.4], "point_p2": [0.1, 0.1, 0.5], "load": [0, 0, -1.0]}
        case = saturated(
            [1, 1, 7], 0.1, [cuboid([0, 0, 0], [0.1, 0.1, 0.5])], walls="sliding", time=1.0,
            load_distributed_box=[load], materials=[SOIL | {"type": kind}],
        )  # fmt: skip
        simulation = simulate(case).step(150)
        found.append([simulation.field(key) for key in ("stress", "pressure", "porosity")])
    for hooke, rubber in zip(*found, strict=True):
        np.testing.assert_allclose(rubber, hooke, rtol=0, atol=1e-4 * np.abs(hooke).max())
    assert np.abs(found[0][0]).max() > 10 and np.abs(found[0][1]).max() > 10
