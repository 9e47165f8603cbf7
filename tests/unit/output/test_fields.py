"""What fields hold, and under which names and types files list them."""

import numpy as np
import pytest
from assembly import simulate, two_blocks

from mpmgeo.output.fields import (
    FLUID_FIELDS,
    FURTHER_FIELDS,
    GRID_FIELDS,
    PARTICLE_FIELDS,
)
from mpmgeo.output.grid_fields import grid_arrays
from mpmgeo.output.mesh_cells import all_cells
from mpmgeo.output.particle_fields import particle_arrays, particle_field

STRESS = ("XX", "YY", "ZZ", "XY", "XZ", "YZ")

# key: name, type, components, as MPM-Geomechanics writes them
PARTICLE_TABLE = {
    "id": ("Particle Id", np.uint64, 1),
    "material": ("Material Id", np.uint32, 1),
    "Su": ("Su", np.float64, 1),
    "active": ("Particle Active", np.uint8, 1),
    "pressure": ("Pressure", np.float64, 1),
    "pore_pressure": ("Pore Pressure", np.float64, 1),
    "plastic_strain": ("Effective Plastic Strain", np.float64, 1),
    "external_force": ("External Force", np.float64, 3),
    "displacement": ("Displacement", np.float64, 3),
    "distance_levelset": ("Distance-levelset", np.float64, 1),
    "particle_contact_force": ("particle_contact_force", np.float64, 3),
    "particle_contact_force_tangential": ("particle_contact_force_tangential", np.float64, 3),
    "particle_contact_force_normal": ("particle_contact_force_normal", np.float64, 3),
    "particle_contact_flag": ("particle_contact_flag", np.uint8, 1),
    "velocity": ("Velocity", np.float64, 3),
    "stress": tuple((f"Stress_{axes}", np.float64, 1) for axes in STRESS),
    "body": ("Body Id", np.uint32, 1),
}
FURTHER_TABLE = {
    "strain": tuple((f"Strain_{axes}", np.float64, 1) for axes in STRESS),
    "deviatoric_strain": ("Deviatoric Strain", np.float64, 1),
    "mean_stress": ("Mean Stress", np.float64, 1),
    "von_mises_stress": ("Von Mises Stress", np.float64, 1),
    "density": ("Density", np.float64, 1),
    "volume": ("Volume", np.float64, 1),
}
GRID_TABLE = {
    "id": ("NodeId", np.uint64, 1),
    "active": ("Active", np.uint8, 1),
    "mass": ("Mass", np.float64, 1),
    "velocity": ("Velocity", np.float64, 3),
    "distance_levelset": ("distance level set", np.float64, 1),
    "density_levelset": ("density levelset", np.float64, 1),
    "volume": ("Volume", np.float64, 1),
}


@pytest.fixture(scope="module")
def flown():
    """Two blocks under gravity, one with a box load, and a third one that has left the mesh."""
    load = {"point_p1": [1, 1, 3], "point_p2": [1.5, 1.25, 4], "load": [8.0, 16.0, -8.0]}
    case = two_blocks(gravity=[0, 1.0, -9.81], load_distributed_box=[load])
    third = {"type": "cuboid", "material_id": 9, "point_p1": [3, 1, 4.5], "point_p2": [3.5, 1.5, 5]}
    case["body"].append(third | {"initial_velocity": [0, 0, 40.0]})
    case["results"] = {"material_point_results": ["strain"]}
    return simulate(case).step(20)


def assert_like(array, table, count):
    _, dtype, components = table
    assert array.dtype == dtype
    assert array.shape == ((count,) if components == 1 else (count, components))


def test_every_field_is_in_the_table_and_in_its_order():
    assert list(PARTICLE_FIELDS) == list(PARTICLE_TABLE)
    assert list(FURTHER_FIELDS) == list(FURTHER_TABLE)
    assert list(GRID_FIELDS) == list(GRID_TABLE)
    assert all(PARTICLE_FIELDS.values()) and all(GRID_FIELDS.values())


@pytest.mark.parametrize("key", PARTICLE_TABLE | FURTHER_TABLE)
def test_arrays_of_one_particle_field(flown, key):
    arrays = particle_arrays(flown.solver, [key])
    table = (PARTICLE_TABLE | FURTHER_TABLE)[key]
    tables = (table,) if isinstance(table[0], str) else table
    assert list(arrays) == [table[0] for table in tables]
    for table in tables:
        assert_like(arrays[table[0]], table, 104)


def test_arrays_of_all_particle_fields(flown):
    names = []
    for table in PARTICLE_TABLE.values():
        names += [table[0]] if isinstance(table[0], str) else [t[0] for t in table]
    assert list(particle_arrays(flown.solver, PARTICLE_FIELDS)) == names
    assert particle_arrays(flown.solver, ()) == {}


def test_files_list_xz_before_yz(flown):
    stress = flown.field("stress")
    arrays = particle_arrays(flown.solver, ["stress"])
    for name, column in zip(STRESS, (0, 1, 2, 3, 5, 4), strict=True):
        assert (arrays[f"Stress_{name}"] == stress[:, column]).all()
    assert np.abs(stress).min(axis=0).max() < np.abs(stress).max(axis=0).min()


def test_numbers_of_particles_bodies_and_materials(flown):
    """Rows are in the order of bodies, which is not that of materials."""
    assert (flown.field("id") == np.arange(104)).all()
    assert (flown.field("body") == np.repeat([1, 2, 3], [64, 32, 8])).all()
    assert (flown.field("material") == np.repeat([9, 4, 9], [64, 32, 8])).all()
    assert [s.law for s in flown.solver.sets] == [law.symbols for law in flown.case.materials]


def test_state_in_row_order(flown):
    """Particles have changed places in their arrays; rows are where they began."""
    rows = np.concatenate([s.row for s in flown.solver.sets])
    assert not (rows == np.arange(104)).all()
    start = flown.solver.population.position
    moved = flown.field("position") - start
    assert (flown.field("displacement") == moved).all()
    mean = moved[64:96].mean(axis=0)
    assert mean == pytest.approx([0.06, 0.02, -0.042], rel=0.1)
    for s in flown.solver.sets:
        for key, name in {"position": "x", "velocity": "v", "mass": "m", "volume": "V"}.items():
            assert (flown.field(key)[s.row] == getattr(s, name)).all()


def test_active(flown):
    active = flown.field("active")
    assert (active == np.repeat([1, 0], [96, 8])).all()
    assert ((flown.field("position")[:, 2] > 5) == (active == 0)).all()


def test_external_force_is_weight_and_box_load(flown):
    force = flown.field("mass")[:, None] * [0, 1.0, -9.81]
    start = flown.solver.population.position
    box = ((start >= [1, 1, 3]) & (start <= [1.5, 1.25, 4])).all(axis=1)
    force[box] += np.array([8.0, 16.0, -8.0]) / np.count_nonzero(box)
    assert np.count_nonzero(box) > 1
    assert flown.field("external_force") == pytest.approx(force)


def test_absent_physics_is_zero(flown):
    for key in ("Su", "pressure", "pore_pressure", "plastic_strain", "distance_levelset"):
        assert not flown.field(key).any()
    for key in PARTICLE_FIELDS:
        if key.startswith("particle_contact"):
            assert not flown.field(key).any()


def test_strain_is_kept_where_it_is_asked_for(flown):
    """With small strains it is what the elastic stress says."""
    law = flown.case.materials[0]
    rows = flown.field("material") == law.id
    strain, stress = flown.field("strain")[rows], flown.field("stress")[rows]
    volume = strain[:, :3].sum(axis=1, keepdims=True)
    expected = law.symbols.G2 * strain
    expected[:, :3] += law.symbols.λ * volume
    assert stress == pytest.approx(expected, rel=1e-9, abs=1e-9 * np.abs(stress).max())
    with pytest.raises(KeyError, match="kept only if"):
        simulate(two_blocks()).field("strain")


def test_invariants(flown):
    def deviator(components):
        a = components[:, [[0, 3, 5], [3, 1, 4], [5, 4, 2]]]
        return a - np.trace(a, axis1=1, axis2=2)[:, None, None] / 3 * np.eye(3)

    stress, strain = flown.field("stress"), flown.field("strain")
    assert flown.field("mean_stress") == pytest.approx(stress[:, :3].mean(axis=1))
    size = np.sqrt((deviator(stress) ** 2).sum(axis=(1, 2)))
    assert flown.field("von_mises_stress") == pytest.approx(np.sqrt(3 / 2) * size)
    size = np.sqrt((deviator(strain) ** 2).sum(axis=(1, 2)))
    assert flown.field("deviatoric_strain") == pytest.approx(np.sqrt(2 / 3) * size)


def test_density(flown):
    assert flown.field("density") == pytest.approx(flown.field("mass") / flown.field("volume"))
    assert np.ptp(flown.field("density")) > 0


def test_unknown_field(flown):
    with pytest.raises(KeyError, match="porosity"):
        particle_field(flown.solver, "porosity")


@pytest.mark.parametrize("key", FLUID_FIELDS)
def test_fields_of_a_fluid_need_one(flown, key):
    with pytest.raises(KeyError, match=key):
        flown.field(key)


@pytest.mark.parametrize("key", [*PARTICLE_FIELDS, *FURTHER_FIELDS, "position", "mass"])
def test_fields_are_copies(flown, key):
    """Whoever changes one changes nothing else."""
    before = flown.field(key)
    kept = before.copy()
    before[...] = 77
    assert (flown.field(key) == kept).all()


# Grid files


def nodal(simulation, keys):
    """Return the grid arrays for all nodes of the mesh."""
    cells = all_cells(simulation.case.mesh)
    return grid_arrays(simulation.solver, cells.node_id, keys), cells


@pytest.mark.parametrize("key", GRID_TABLE)
def test_arrays_of_one_grid_field(flown, key):
    arrays, cells = nodal(flown, [key])
    assert list(arrays) == [GRID_TABLE[key][0]]
    assert_like(arrays[GRID_TABLE[key][0]], GRID_TABLE[key], len(cells.node_id))


def test_nodal_mass_and_velocity(flown):
    arrays, cells = nodal(flown, GRID_FIELDS)
    assert list(arrays) == [table[0] for table in GRID_TABLE.values()]
    nodes = flown.nodes()
    count = np.array(flown.case.mesh.cells_number) + 5
    number = nodes.index @ [1, count[0], count[0] * count[1]]
    mass, velocity = np.zeros(len(cells.node_id)), np.zeros((len(cells.node_id), 3))
    mass[number], velocity[number] = nodes.mass, nodes.velocity
    assert (arrays["Mass"] == mass).all() and (arrays["Velocity"] == velocity).all()
    assert (arrays["Active"] == (mass > 0)).all()
    assert (arrays["NodeId"] == np.arange(count.prod())).all()
    assert cells.points[number] == pytest.approx(nodes.position)
    active = flown.field("active") == 1
    assert mass.sum() == pytest.approx(flown.field("mass")[active].sum())


def test_nodal_volume(flown):
    """A cell's in the inside, half of it on outer faces of the ghosted mesh, a quarter on edges."""
    arrays, cells = nodal(flown, ["volume"])
    assert arrays["Volume"].sum() == pytest.approx(12 * 10 * 14 * 0.125)
    expected = np.full(len(cells.node_id), 0.125)
    for axis in range(3):
        x = cells.points[:, axis]
        expected[(x == x.min()) | (x == x.max())] /= 2
    assert arrays["Volume"] == pytest.approx(expected)


def test_grid_arrays_before_the_first_step():
    arrays, _ = nodal(simulate(two_blocks()), GRID_FIELDS)
    assert not arrays["Mass"].any() and not arrays["Active"].any()
