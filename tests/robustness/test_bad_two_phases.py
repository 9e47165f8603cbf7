"""Two phases without what they need, or with what does not go with them: exit code 2, a message."""

import pytest
from refusal import refusal_of

NOT = "is not accepted; accepted:"
FLUID = {
    "density_fluid": 1000,
    "porosity": 0.3,
    "bulk_fluid": 1e8,
    "hydraulic_conductivity": [0.01, 0.01, 0.01],
}
BOX = {"point_p1": [0, 0, 0], "point_p2": [1, 1, 1]}
TERRAIN = {"active": True, "stl_mesh": "ground.stl"}
LONE = ("hydro_mechanical_coupling", "compatibility", "prescribed_velocity")


@pytest.fixture
def wet(case, folder):
    """A sound case with a fluid in all its materials."""
    materials = {name: law | FLUID for name, law in case["materials"].items()}
    case = {key: value for key, value in case.items() if key not in LONE}
    return case | {"n_phases": 2, "materials": materials, "stress_scheme_update": "MUSL"}


@pytest.mark.parametrize("key", FLUID)
def test_keys_of_the_fluid_are_needed(wet, key, capsys):
    name = next(iter(wet["materials"]))
    del wet["materials"][name][key]
    assert f"materials.{name}.{key}: missing; needed with two phases" in refusal_of(wet, capsys)


VALUES = [
    ("density_fluid", 0, f"density_fluid: 0 {NOT} a number above 0"),
    ("density_fluid", "1000", 'density_fluid: "1000" is not accepted'),
    ("porosity", 0, f"porosity: 0 {NOT} a number above 0 and below 1"),
    ("porosity", 1, f"porosity: 1 {NOT} a number above 0 and below 1"),
    ("porosity", 30, f"porosity: 30 {NOT}"),
    ("porosity", None, "porosity: missing; needed with two phases"),
    ("bulk_fluid", -1e8, f"bulk_fluid: -100000000.0 {NOT} a number above 0"),
    ("bulk_fluid", float("inf"), "bulk_fluid: Infinity is no finite number"),
    ("hydraulic_conductivity", 0.01, f"hydraulic_conductivity: 0.01 {NOT} a list of 3 numbers"),
    ("hydraulic_conductivity", [0.01, 0.01], f"hydraulic_conductivity: [0.01, 0.01] {NOT} a list"),
    ("hydraulic_conductivity", [0.01, 0, 0.01], f"hydraulic_conductivity[1]: 0 {NOT} a number ab"),
]


@pytest.mark.parametrize(("key", "value", "message"), VALUES, ids=str)
def test_values_of_the_fluid(wet, key, value, message, capsys):
    name = next(iter(wet["materials"]))
    wet["materials"][name][key] = value
    assert f"materials.{name}.{message}" in refusal_of(wet, capsys)


EXTREMES = [
    {"porosity": 1e-300},
    {"density_fluid": 1e-320},
    {"hydraulic_conductivity": [1e-320, 1, 1]},
    {"bulk_fluid": 1e100, "density_fluid": 1e-50},
]


@pytest.mark.parametrize("keys", EXTREMES, ids=str)
def test_numbers_that_cannot_be_calculated_with(wet, keys, capsys):
    name = next(iter(wet["materials"]))
    wet["materials"][name] |= keys
    shown = refusal_of(wet, capsys)
    assert f"materials.{name}: grains, pores and fluid make no usable wave speed" in shown


COUPLING = {"enabled": True, "pore_pressure_field": "pressures.json"}
PARTS = [
    ({"transfer": "tpic"}, 'transfer: two phases go with "flip" alone'),
    ({"stress_scheme_update": "USF"}, 'stress_scheme_update: "USF" is for one phase; accepted wi'),
    ({"compatibility": "mpm-geomechanics"}, "compatibility: two phases have no earlier form"),
    ({"hydro_mechanical_coupling": COUPLING}, "hydro_mechanical_coupling: pressures from a file a"),
    ({"terrain_contact": TERRAIN}, "terrain_contact: a terrain does not hold the pore fluid"),
    ({"prescribed_pressure_box": [BOX]}, "prescribed_pressure_box[0].pressure: missing"),
    ({"initial_pressure_material": [{"material_id": 99, "pressure": 1}]}, "99 is no id of a mat"),
]


@pytest.mark.parametrize(("keys", "message"), PARTS, ids=str)
def test_what_does_not_go_with_two_phases(wet, keys, message, capsys):
    assert message in refusal_of(wet | keys, capsys)


def test_walls_of_the_fluid(wet, capsys):
    wet["mesh"]["boundary_conditions_fluid"] = {"plane_Z0": "open", "plane_Q0": "free"}
    shown = refusal_of(wet, capsys)
    assert f'mesh.boundary_conditions_fluid.plane_Z0: "open" {NOT} "free", "sliding"' in shown


@pytest.mark.parametrize("phases", [None, 1])
def test_with_one_phase_the_fluid_may_be_anything(case, folder, phases):
    """As in MPM-Geomechanics, whose examples leave it in."""
    from mpmgeo.case.load import load_case

    dry = load_case(case, strict=True)
    for law in case["materials"].values():
        law |= {"porosity": 0, "bulk_fluid": "soft", "hydraulic_conductivity": [0, 0, 0]}
    case["mesh"]["boundary_conditions_fluid"] = 7
    case["n_phases"] = phases
    assert load_case(case, strict=True) == dry
