"""Which actions of a case act, and in which order."""

from mpmgeo.boundaries.terrain import TerrainContact
from mpmgeo.case.load import load_case
from mpmgeo.loads import BoxLoad, InitialPressureBox, PointLoad

BOX = {"point_p1": [0, 0, 0], "point_p2": [1, 1, 1]}
WATER = {
    "density_fluid": 1000,
    "porosity": 0.3,
    "bulk_fluid": 1e8,
    "hydraulic_conductivity": [1e-3] * 3,
}
PRESSURES = {
    "prescribed_pressure_box": [BOX | {"pressure": 3}],
    "initial_pressure_material": [{"material_id": 1, "pressure": 2}],
    "initial_pressure_box": [BOX | {"pressure": 1}, BOX | {"pressure": 1.5}],
}


def test_entries_of_an_action(case):
    case["load_distributed_box"] = [BOX | {"load": [0, 0, 1]}, BOX | {"load": [0, 0, 2]}]
    loaded = load_case(case)
    assert loaded.entries(BoxLoad) == loaded.load_distributed_box
    assert loaded.entries(PointLoad) == ()
    assert loaded.entries(TerrainContact) == ()
    assert [entry.load[2] for entry in loaded.acting("particle_force")] == [1, 2]
    assert loaded.acting("fluid_force") == []


def test_loads_of_the_fluid_act_with_two_phases_only(case):
    loaded = load_case(case | PRESSURES)
    assert loaded.initial_pressure_box
    assert loaded.entries(InitialPressureBox) == ()
    assert loaded.acting("wets") == []


def test_pressures_come_as_the_manual_says(case):
    """Boxes first, then materials, then what is prescribed."""
    case["materials"]["soil"] |= WATER
    loaded = load_case(case | PRESSURES | {"n_phases": 2})
    assert [entry.pressure for entry in loaded.acting("wets")] == [1, 1.5, 2, 3]
