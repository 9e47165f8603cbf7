"""The solver against its plain twin, in scenes where everything happens within a few steps."""

import json
from itertools import product

import numpy as np
import pytest

import mpmgeo
from mpmgeo.mpm.schemes import SCHEMES
from mpmgeo.shapes import SHAPES
from mpmgeo.verify.plain import PlainSolver
from mpmgeo.verify.plain_locking import PlainSharing

STEPS = 30
FIELDS = {"position": "x", "velocity": "v", "stress": "stress"}


def scene(**keys):
    """Two bodies of two materials that meet, spin and hit three walls, in a mesh of flat cells."""
    soft = {"type": "elastic", "density": 1000.0, "young": 2e6, "poisson": 0.3}
    stiff = {"type": "elastic", "density": 1800.0, "young": 5e6, "poisson": 0.2}
    block = {"type": "cuboid", "point_p1": [0.6, -0.3, -1.95], "point_p2": [1.5, 0.3, -1.65]}
    ball = {"type": "sphere", "center": [1.05, 0.0, -1.44], "diameter": 0.42}
    return {
        "time": 1.0,
        "time_step": 5e-4,
        "gravity": [3.0, 0.0, -9.81],
        "mesh": {
            "cells_number": [10, 9, 12],
            "cells_dimension": [0.15, 0.1, 0.075],
            "origin": [0.3, -0.45, -1.95],
            "boundary_conditions": {
                "plane_X0": "sliding",
                "plane_Y0": "fixed",
                "plane_Z0": "fixed",
                "plane_Xn": "sliding",
                "plane_Yn": "sliding",
                "plane_Zn": "free",
            },
        },
        "materials": [soft | {"id": 1}, stiff | {"id": 2}],
        "body": [
            block | {"material_id": 1, "initial_velocity": [20.0, -10.0, 0.0]},
            ball | {"material_id": 2, "initial_velocity": [0.0, 10.0, -15.0]},
        ],
    } | keys


def both(case, small=True):
    """Return a simulation with particles in random motion and the twin of its solver."""
    simulation = mpmgeo.Simulation(mpmgeo.load_case(case))
    simulation.solver.small = small
    random = np.random.default_rng(7)
    velocity = simulation.field("velocity")
    simulation.assign("velocity", velocity + random.uniform(-3, 3, velocity.shape))
    simulation.assign("stress", random.uniform(-1e4, 1e4, (len(velocity), 6)))
    plain = PlainSolver if simulation.solver.cells is None else PlainSharing
    return simulation, plain(simulation.solver)


def assert_same_steps(simulation, twin, steps=STEPS):
    """Step both, then compare all arrays in relation to their largest entry."""
    for _ in range(steps):
        simulation.step()
        twin.step()
    np.testing.assert_array_equal(simulation.field("active"), twin.active)
    origin = {"position": simulation.case.mesh.origin}
    for key, name in FIELDS.items():
        expected = getattr(twin, name)
        found = simulation.field(key) - origin.get(key, 0.0)
        assert_same(found, expected, key)
    if twin.C is not None:
        gradient = np.zeros_like(twin.C)
        for s in simulation.solver.sets:
            gradient[s.row] = s.C
        assert_same(gradient, twin.C, "velocity gradient")
    volume = np.zeros_like(twin.V)
    for s in simulation.solver.sets:
        volume[s.row] = s.V
    assert_same(volume, twin.V, "volume")


def assert_same(found, expected, key):
    np.testing.assert_allclose(
        found, expected, rtol=0, atol=1e-10 * np.abs(expected).max(), err_msg=key
    )


QUICK = [("GIMP", scheme) for scheme in SCHEMES]
QUICK += [("linear", "MUSL"), ("quadratic-bspline", "USF"), ("cubic-bspline", "USL")]
QUICK += [("LME", "NPC"), ("LME", "USL")]
OTHERS = [pair for pair in product(SHAPES, SCHEMES) if pair not in QUICK]


@pytest.mark.parametrize(
    "shape, scheme",
    [*QUICK, *(pytest.param(*pair, marks=pytest.mark.slow) for pair in OTHERS)],
)
def test_agree(shape, scheme):
    case = scene(shape_function=shape, stress_scheme_update=scheme)
    simulation, twin = both(case)
    start = twin.x.copy()
    assert_same_steps(simulation, twin)
    block = 4 * twin.box.cell[0]
    crossed = np.floor((twin.x[:, 0] - 0.3) / block) != np.floor((start[:, 0] - 0.3) / block)
    assert crossed.sum() > 20


@pytest.mark.parametrize("scheme", ["USL", "NPC"])
def test_agree_with_threads(scheme):
    assert_same_steps(*both(scene(stress_scheme_update=scheme), small=False))


@pytest.mark.parametrize(
    "transfer, shape, scheme",
    [
        ("tpic", "GIMP", "USL"),
        ("tpic", "quadratic-bspline", "MUSL"),
        ("tpic", "cubic-bspline", "USF"),
        ("apic", "GIMP", "MUSL"),
        ("apic", "quadratic-bspline", "USL"),
        ("apic", "cubic-bspline", "USF"),
    ],
)
def test_agree_with_affine_transfers(transfer, shape, scheme):
    case = scene(shape_function=shape, stress_scheme_update=scheme, transfer=transfer)
    simulation, twin = both(case)
    random = np.random.default_rng(8)
    for s in simulation.solver.sets:
        s.C[:] = random.uniform(-30, 30, s.C.shape)
        twin.C[s.row] = s.C
    assert_same_steps(simulation, twin)


def test_agree_with_a_blend():
    assert_same_steps(*both(scene(transfer={"type": "flip", "flip": 0.9})))


@pytest.mark.parametrize(
    "scheme, locking", [("USL", "off"), ("MUSL", "off"), ("USF", "off"), ("USL", "cells")]
)
def test_agree_with_pore_pressures(tmp_path, scheme, locking):
    file = tmp_path / "p.json"
    points = [([0.9, 0.0, -1.8], 2e4), ([1.2, 0.1, -1.5], -1e4)]
    file.write_text(json.dumps([{"position": x, "pressure": p} for x, p in points]))
    coupling = {"enabled": True, "pore_pressure_field": str(file), "radius": 0.3}
    keys = {"stress_scheme_update": scheme, "volumetric_locking": locking}
    case = scene(hydro_mechanical_coupling=coupling, **keys)
    simulation, twin = both(case)
    assert len(np.unique(twin.pressure)) == 3
    assert_same_steps(simulation, twin)


def test_agree_with_damping_loads_mixed_sizes_and_departures():
    case = scene(damping={"type": "local", "value": 0.3})
    case["mesh"]["boundary_conditions"] |= {"plane_X0": "free", "plane_Yn": "free"}
    case["body"][1] |= {"material_id": 1, "particles_per_direction": [1, 3, 2]}
    case["body"][1]["initial_velocity"] = [0.0, 40.0, -15.0]
    case["body"].append(case["body"][1] | {"material_id": 2, "center": [0.6, 0.2, -1.4]})
    case["load_distributed_box"] = [
        {"point_p1": [0.6, -0.3, -1.8], "point_p2": [0.9, 0.3, -1.6], "load": [0.0, 50.0, -90.0]}
    ]
    simulation, twin = both(case)
    assert isinstance(simulation.solver.sets[0].half, np.ndarray)
    assert simulation.solver.sets[0].force is not None
    assert_same_steps(simulation, twin)
    assert 10 < twin.active.sum() < len(twin.active) - 10


@pytest.mark.parametrize("locking", ["off", "cells"])
def test_agree_with_plastic_flow_and_rotation(locking):
    """Laws with variables, and stress that turns with the particles."""
    case = scene(volumetric_locking=locking)
    plastic = {"type": "mohr-coulomb", "friction": 25.0, "cohesion": 2e3, "dilation": 5.0}
    case["materials"][0] |= plastic | {"objective_rate": "hughes-winget"}
    case["materials"][1] |= {"objective_rate": "jaumann"}
    simulation, twin = both(case)
    assert_same_steps(simulation, twin)
    for column, name in enumerate(("plastic_strain", "opening")):
        expected = twin.state[0][:, column]
        assert_same(simulation.field(name), expected, name)
        assert (expected > 0).sum() > 100


@pytest.mark.parametrize("scheme", ["USL", "MUSL", "NPC"])
def test_agree_with_deformation_gradients(scheme):
    case = scene(stress_scheme_update=scheme)
    case["materials"][1]["type"] = "neo-hookean"
    simulation = mpmgeo.Simulation(mpmgeo.load_case(case))
    random = np.random.default_rng(7)
    velocity = simulation.field("velocity")
    simulation.assign("velocity", velocity + random.uniform(-3, 3, velocity.shape))
    F = np.eye(3) + random.uniform(-0.01, 0.01, (len(velocity), 3, 3))
    simulation.assign("deformation_gradient", F)
    twin = PlainSolver(simulation.solver)
    assert_same_steps(simulation, twin)
    found = simulation.field("deformation_gradient").reshape(-1, 9)
    assert_same(found, twin.gradient, "deformation gradient")
    kept = found.any(axis=1)
    assert 0 < kept.sum() < len(kept)
    assert np.abs(found[kept] - np.eye(3).ravel()).max() > 0.05


@pytest.mark.parametrize(
    "shape, scheme",
    [
        *(("GIMP", scheme) for scheme in ("USL", "MUSL", "NPC")),
        *(pytest.param(shape, "USF", marks=pytest.mark.slow) for shape in SHAPES),
    ],
)
def test_agree_with_shared_cells(shape, scheme):
    """Two materials in a cell share nothing with each other, whatever the width of the shape."""
    keys = {"shape_function": shape, "stress_scheme_update": scheme}
    assert_same_steps(*both(scene(volumetric_locking="cells", **keys)))


@pytest.mark.parametrize(
    "keys",
    [
        {"nodal_point_load": [[[0.75, 0.0, -1.65], [0.0, 0.0, -1.0]]]},
        {"damping": {"type": "kinetic"}},
        {"damping": {"type": "local", "value": 0.1}, "compatibility": "mpm-geomechanics"},
    ],
    ids=["point load", "kinetic damping", "delayed damping"],
)
def test_twin_refuses_what_it_lacks(keys):
    with pytest.raises(ValueError, match="plain solver"):
        both(scene(**keys))
