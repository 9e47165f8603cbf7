"""Values that are well formed and hardly meant are told of, with the slip that they likely are."""

import pytest

from mpmgeo.case.load import CaseError, load_case

SAND = {"type": "mohr-coulomb", "friction": 30, "cohesion": 100.0, "dilation": 5}
WATER = {"type": "newtonian", "id": 1, "density": 1000, "viscosity": 1e-3, "bulk": 2e6}
WET = {
    "density_fluid": 1000,
    "porosity": 0.4,
    "bulk_fluid": 1e6,
    "hydraulic_conductivity": [1, 1e-9, 1],
}
ANGLE = "is little for an angle in degrees; in radians it would be"
LIGHT = "is little for kg/m³; is it in t/m³, or a unit weight in kN/m³?"
HEAVY = "is much for kg/m³; is it a unit weight in N/m³?"
SOFT = "is little for Pa; is it in MPa or GPa?"

DOUBTFUL = [
    ("friction", 0.5236, f"0.5236 {ANGLE} 30°"),
    ("friction", 1.2, f"1.2 {ANGLE} 68.75°"),
    ("softening.friction.residual", 0.35, f"0.35 {ANGLE} 20.05°"),
    ("dilation", 0.1745, f"0.1745 {ANGLE} 9.998°"),
    ("density", 2.0, f"2 {LIGHT}"),
    ("density", 18, f"18 {LIGHT}"),
    ("density", 20000, f"20000 {HEAVY}"),
    ("density_fluid", 1.0, f"1 {LIGHT}"),
    ("density_fluid", 9810, f"9810 {HEAVY}"),
    ("young", 20, f"20 {SOFT}"),
    ("young", 2e16, "2e+16 is more than any material has, diamond 1.2e12 Pa"),
    ("bulk_fluid", 2.2, f"2.2 {SOFT} water has 2.2e9 Pa"),
    ("hydraulic_conductivity", [1e-3, 20, 1e-3], "20 is much for m/s, gravel has 0.01 to 1"),
]


@pytest.fixture
def wet(case):
    case["materials"]["soil"] |= SAND | WET
    case["n_phases"] = 2
    return case


def test_a_sound_material_is_not_told_of(wet):
    assert load_case(wet).warnings == ()


@pytest.mark.parametrize(("key", "value", "message"), DOUBTFUL)
def test_doubtful_values_of_a_material(wet, key, value, message):
    wet["materials"]["soil"][key] = value
    warning = f"materials.soil.{key}: {message}"
    assert warning in load_case(wet).warnings
    with pytest.raises(CaseError) as caught:
        load_case(wet, strict=True)
    assert warning in caught.value.problems


def test_a_doubtful_liquid(case):
    case["materials"]["soil"] = WATER | {"density": 1.0}
    assert load_case(case).warnings == (f"materials.soil.density: 1 {LIGHT}",)
    case["materials"]["soil"] = WATER | {"bulk": 2.2}
    assert load_case(case).warnings == (f"materials.soil.bulk: 2.2 {SOFT}",)


def test_a_case_without_units_and_a_material_without_use(case):
    """A bar of stiffness 100 and density 1, as papers have it."""
    case["materials"]["soil"] |= {"density": 1.0, "young": 100.0}
    case["materials"]["other"] = case["materials"]["soil"] | {"id": 2, "density": 2.0, "young": 1.0}
    assert load_case(case).warnings == ()


@pytest.mark.parametrize(
    ("friction", "message"),
    [
        (30, "30 is much for a coefficient; tan 30° is 0.577"),
        (1000, "1000 is much for a coefficient of friction"),
    ],
)
def test_friction_of_a_terrain_in_degrees(case, tmp_path, friction, message):
    (tmp_path / "g.stl").write_text(
        "solid g\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
        "endloop\nendfacet\nendsolid g\n"
    )
    terrain = {"active": True, "stl_mesh": str(tmp_path / "g.stl"), "friction": friction}
    case["terrain_contact"] = terrain
    assert load_case(case).warnings == (f"terrain_contact.friction: {message}",)
    terrain["friction"] = 1.2
    assert load_case(case).warnings == ()


def test_a_share_of_damping_is_at_most_one(case):
    case["damping"] = {"type": "local", "value": 1}
    load_case(case)
    case["damping"]["value"] = 5
    with pytest.raises(CaseError) as caught:
        load_case(case)
    assert caught.value.problems == [
        "damping.value: 5 is not accepted; accepted: a number at least 0 and at most 1 "
        "(Share of the out-of-balance force)"
    ]
