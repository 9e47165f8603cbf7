"""The key initial_stress: what it refuses by name, and what it warns of."""

import pytest

import mpmgeo
from mpmgeo.case.load import CaseError, load_case

SOIL = {"type": "mohr-coulomb", "id": 1, "density": 2000, "young": 1e7, "poisson": 0.3}
SOIL |= {"friction": 30, "cohesion": 0}
RUBBER = {"type": "neo-hookean", "id": 1, "density": 2000, "young": 1e7, "poisson": 0.3}
WATER = {"type": "newtonian", "id": 1, "density": 1000, "bulk": 1e7}
FLUID = {"density_fluid": 1000, "porosity": 0.4, "bulk_fluid": 1e8}
FLUID |= {"hydraulic_conductivity": [1e-3, 1e-3, 1e-3]}


def case_of(law=SOIL, **keys):
    laws = {"soil": law} if "type" in law else law
    body = {"type": "cuboid", "point_p1": [0, 0, 0], "point_p2": [1, 1, 2], "material_id": 1}
    mesh = {"cells_number": [2, 2, 6], "cells_dimension": [0.5, 0.5, 0.5]}
    case = {"time": 0.1, "gravity": [0, 0, -10], "mesh": mesh, "materials": laws}
    return case | {"body": {"block": body}, "initial_stress": {}} | keys


def problems(case):
    with pytest.raises(CaseError) as error:
        load_case(case)
    return "; ".join(error.value.problems)


RAMP = {"value": [0, 0, -10], "ramp": {"type": "sine", "duration": 1}}
ERRORS = [
    (SOIL, {"load_state": True}, "initial_stress: load_state has the stresses at the start"),
    (SOIL, {"compatibility": "mpm-geomechanics"}, "initial_stress: MPM-Geomechanics knows no"),
    (SOIL, {"initial_stress": {"k0": 0}}, "initial_stress.k0: 0 is not accepted; accepted: a num"),
    (SOIL, {"initial_stress": {"water_table": "high"}}, 'initial_stress.water_table: "high" is'),
    (SOIL, {"initial_stress": True}, "initial_stress: true is not accepted; accepted: an object"),
    (SOIL | {"k0": -1}, {}, "materials.soil.k0: -1 is not accepted; accepted: a number above 0"),
    (SOIL | {"density_saturated": 1900}, {}, "density_saturated: 1900 kg/m³ is less than density"),
    (RUBBER, {}, 'initial_stress: the stress of "neo-hookean" follows from its deformation'),
    (WATER | {"k0": 0.5}, {}, "materials.soil.k0: 0.5: a fluid at rest has the same pressure"),
    (SOIL | FLUID | {"density_saturated": 2100}, {"n_phases": 2}, "density_saturated: with two"),
    (
        {"a": SOIL | FLUID, "b": SOIL | FLUID | {"id": 2, "density_fluid": 1030}},
        {"n_phases": 2, "initial_stress": {"water_table": 2}},
        "initial_stress.water_table: needs one density_fluid for all materials; here there are "
        "1000, 1030",
    ),
]


@pytest.mark.parametrize(("law", "keys", "message"), ERRORS, ids=[row[2][:40] for row in ERRORS])
def test_what_cannot_be_is_refused_by_name(law, keys, message):
    assert message in problems(case_of(law, **keys))


@pytest.mark.parametrize(
    ("gravity", "message"),
    [
        ([0, 1, -10], r"gravity: is \[0.0, 1.0, -10.0\] at the start; .* needs one along an axis"),
        ([0, 0, 0], "needs one not zero"),
        (RAMP, "needs one not zero"),
    ],
)
def test_gravity_has_to_lie_along_an_axis(gravity, message):
    with pytest.raises(ValueError, match=message):
        mpmgeo.Simulation(case_of(gravity=gravity))


def test_gravity_may_tilt_where_a_run_goes_on(tmp_path):
    mpmgeo.Simulation(case_of()).step(3).save(tmp_path / "snapshot")
    tilted = case_of(gravity=[1, 0, -10])
    resumed = mpmgeo.Simulation.resume(tmp_path / "snapshot", tilted, allow=["gravity"]).step()
    assert resumed.field("velocity")[:, 0].max() > 0


def test_pressures_come_from_the_table_or_from_a_file(tmp_path):
    path = tmp_path / "pressures.json"
    path.write_text('[{"position": [0.5, 0.5, 0.5], "pressure": 1e3}]')
    coupling = {"enabled": True, "type": "one_way", "pore_pressure_field": str(path)}
    keys = {"hydro_mechanical_coupling": coupling, "initial_stress": {"water_table": 1}}
    assert "initial_stress.water_table: the pore pressures are" in problems(case_of(**keys))
    keys["initial_stress"] = {}
    simulation = mpmgeo.Simulation(case_of(**keys))
    z = simulation.field("position")[:, 2]
    total = simulation.field("stress")[:, 2] - simulation.field("pressure")
    assert total == pytest.approx(-2e4 * (2 - z))


@pytest.mark.parametrize("k0", [0.3, 3.1])
@pytest.mark.parametrize("of_material", [True, False])
def test_a_law_bears_what_its_strength_lets_it(k0, of_material):
    key = "materials: k0 of 1" if of_material else "initial_stress.k0"
    case = case_of(SOIL | {"k0": k0}) if of_material else case_of(initial_stress={"k0": k0})
    with pytest.raises(ValueError, match=f"{key}: {k0} is beyond the strength") as error:
        mpmgeo.Simulation(case)
    assert "0.3333 (active) to 3 (passive)" in str(error.value)


@pytest.mark.parametrize(
    ("law", "k0"),
    [
        (SOIL, 0.5),
        (SOIL | {"k0": 0.8}, 0.8),
        (SOIL | {"k0": 1 / 3}, 1 / 3),
        (SOIL | {"cohesion": 1e5, "k0": 0.2}, 0.2),
        (SOIL | {"su_vertical_stress": 0.25, "k0": 0.6}, 0.6),
        (SOIL | {"su_vertical_stress": 0.25}, 1.0),
        ({"type": "elastic", "id": 1, "density": 2000, "young": 1e7, "poisson": 0.2}, 0.25),
    ],
)
def test_k0_of_a_law_or_material(law, k0):
    """Nor does the law change the stress that it begins with."""
    simulation = mpmgeo.Simulation(case_of(law))
    stress = simulation.field("stress").copy()
    assert stress[:, 0] == pytest.approx(k0 * stress[:, 2])
    assert simulation.step(5).field("stress") == pytest.approx(stress, rel=1e-9)
    assert any(f"K0 {k0:.3g} of material 1" in message for message in simulation.messages)


def warnings_of(case):
    return "; ".join(mpmgeo.Simulation(case).warnings)


ELASTIC = {"type": "elastic", "id": 1, "density": 2000, "young": 1e7, "poisson": 0.3}
WARNINGS = [
    (ELASTIC | {"k0": 0.05}, {}, "initial_stress: K0 0.05 of material 1"),
    (ELASTIC, {"k0": 6}, "initial_stress: K0 6 of material 1; ground at rest has 0.1 to 5"),
    (ELASTIC, {"water_table": -1}, "initial_stress.water_table: -1 m is below all bodies"),
    (ELASTIC, {"water_table": 3}, "initial_stress.water_table: 3 m is above all bodies"),
    (ELASTIC, {"water_table": 2, "density_water": 2500}, "with effective stresses in tension"),
]


@pytest.mark.parametrize(("law", "start", "message"), WARNINGS, ids=[row[2] for row in WARNINGS])
def test_what_is_hardly_meant_gets_a_warning(law, start, message):
    assert message in warnings_of(case_of(law, initial_stress=start))


def test_with_two_phases_all_pores_are_full():
    case = case_of(ELASTIC | FLUID, n_phases=2, initial_stress={"water_table": 1})
    assert "64 particles begin above 1 m" in warnings_of(case)


def test_what_has_no_effect_gets_a_note():
    case = case_of(ELASTIC | {"k0": 0.5, "density_saturated": 2100})
    assert any("without initial_stress.water_table" in note for note in load_case(case).notes)
    del case["initial_stress"]
    assert sum("without initial_stress" in note for note in load_case(case).notes) == 2
    case = case_of(ELASTIC | FLUID, n_phases=2)
    case["initial_stress"] = {"water_table": 2, "density_water": 900}
    assert any("no effect with two phases" in note for note in load_case(case).notes)
