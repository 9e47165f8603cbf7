"""Malformed and doubtful materials: refused, or told about, with path and value."""

import json

import pytest

from mpmgeo import cli
from mpmgeo.case.load import CaseError, load_case
from mpmgeo.materials.rotation import ROTATIONS

NOT = "is not accepted; accepted:"
ABSENT = object()
SAND = {
    "type": "mohr-coulomb",
    "id": 1,
    "density": 2000,
    "young": 1e7,
    "poisson": 0.3,
    "friction": 30,
    "cohesion": 1000,
    "dilation": 5,
    "tensile": 500,
    "softening": "exponential",
    "softening.exponential.eta": 30.9,
    "softening.friction.residual": 20,
    "softening.friction.active": True,
    "softening.cohesion.residual": 0,
    "softening.cohesion.active": True,
    "softening.dilation.residual": 0,
    "softening.dilation.active": True,
    "softening.tensile.residual": 0,
    "softening.tensile.active": True,
    "objective_rate": "jaumann",
}
WATER = {"type": "newtonian", "id": 1, "density": 1000, "viscosity": 1e-3, "bulk": 2e6}
RUBBER = {"type": "neo-hookean", "id": 1, "density": 1000, "young": 1e6, "poisson": 0.3}

BAD = [
    (SAND, "young", ABSENT, "missing; needed: a number above 0 (Young's modulus [Pa])"),
    (SAND, "young", 0, f"0 {NOT} a number above 0"),
    (SAND, "poisson", 0.5, f"0.5 {NOT} a number above -1 and below 0.5"),
    (SAND, "density", "2000", f'"2000" {NOT} a number above 0, without quotes'),
    (SAND, "friction", -1, f"-1 {NOT} a number at least 0 and below 90 (Angle of friction [°])"),
    (SAND, "friction", 90, f"90 {NOT} a number at least 0 and below 90"),
    (SAND, "friction", "30", f'"30" {NOT} a number at least 0 and below 90, without quotes'),
    (SAND, "friction", [30], f"[30] {NOT} a number"),
    (SAND, "cohesion", -1e-9, f"-1e-09 {NOT} a number at least 0 (Cohesion [Pa])"),
    (SAND, "cohesion", True, f"true {NOT} a number"),
    (SAND, "cohesion", float("nan"), "NaN is no finite number"),
    (SAND, "dilation", -5, f"-5 {NOT} a number at least 0 and below 90"),
    (SAND, "dilation", 95, f"95 {NOT} a number at least 0 and below 90"),
    (SAND, "tensile", -1, f"-1 {NOT} a number at least 0"),
    (SAND, "tensile", "none", f'"none" {NOT} a number'),
    (SAND, "su_vertical_stress", -0.2, f"-0.2 {NOT} a number at least 0"),
    (SAND, "su_vertical_stress", {}, f"{{}} {NOT} a number"),
    (SAND, "softening", "linear", f'"linear" {NOT} "none", "exponential"'),
    (SAND, "softening", "Exponential", 'did you mean "exponential"?'),
    (SAND, "softening", {"exponential": {"eta": 5}}, f'an object of 1 key {NOT} "none", "expo'),
    (SAND, "softening.exponential.eta", -1, f"-1 {NOT} a number at least 0"),
    (SAND, "softening.exponential.eta", "50", f'"50" {NOT} a number at least 0, without'),
    (SAND, "softening.friction.residual", 90, f"90 {NOT} a number at least 0 and below 90"),
    (SAND, "softening.friction.active", "true", f'"true" {NOT} true or false'),
    (SAND, "softening.cohesion.residual", -1, f"-1 {NOT} a number at least 0"),
    (SAND, "softening.cohesion.active", 1, f"1 {NOT} true or false"),
    (SAND, "softening.dilation.residual", -1, f"-1 {NOT} a number at least 0 and below 90"),
    (SAND, "softening.dilation.active", [], f"[] {NOT} true or false"),
    (SAND, "softening.tensile.residual", -1, f"-1 {NOT} a number at least 0"),
    (SAND, "softening.tensile.active", 0, f"0 {NOT} true or false"),
    (SAND, "objective_rate", "Jaumann", 'did you mean "jaumann"?'),
    (SAND, "objective_rate", "green-naghdi", f'{NOT} "none", "jaumann", "hughes-winget"'),
    (SAND, "objective_rate", True, f'true {NOT} "none", "jaumann", "hughes-winget"'),
    (RUBBER, "young", ABSENT, "missing; needed: a number above 0 (Young's modulus [Pa])"),
    (RUBBER, "poisson", 0.5, f"0.5 {NOT} a number above -1 and below 0.5"),
    (RUBBER, "objective_rate", "jaumann", "stress turns with the deformation gradient; leave"),
    (RUBBER, "type", "neohookean", 'did you mean "neo-hookean"?'),
    (WATER, "bulk", ABSENT, "missing; needed: a number above 0 (Bulk modulus [Pa])"),
    (WATER, "bulk", 0, f"0 {NOT} a number above 0"),
    (WATER, "viscosity", -1e-3, f"-0.001 {NOT} a number at least 0"),
    (WATER, "viscosity", "1e-3", f'"1e-3" {NOT} a number at least 0, without quotes'),
    (WATER, "tensile", -1, f"-1 {NOT} a number at least 0"),
    (WATER, "tensile", "0", f'"0" {NOT} a number at least 0, without quotes'),
]

DOUBTFUL = [
    ({"dilation": 35}, "dilation: exceeds friction, 30: plastic flow creates energy"),
    ({"tensile": 2e3}, "tensile: acts as cohesion/tan(friction), 1732.05, which it exceeds"),
    ({"friction": 0, "cohesion": 0, "dilation": 0}, "cohesion: without cohesion and friction"),
    (
        {"softening.friction.active": False},
        "softening.friction.residual: without effect, since softening.friction.active is not true",
    ),
    (
        {"softening": "none"},
        'softening.cohesion.active: without effect, since softening is not "exponential"',
    ),
    ({"softening.exponential.eta": 0}, "softening.exponential.eta: softens nothing if it is 0"),
    (
        {
            f"softening.{key}.active": False
            for key in ("friction", "dilation", "cohesion", "tensile")
        },
        "softening: without effect, since no strength is active in it",
    ),
    (
        {"su_vertical_stress": 0.2},
        "softening.friction.active: without effect, since su_vertical_stress takes the place",
    ),
    (
        {"softening.friction.residuel": 20},
        'softening.friction.residuel: unknown key, ignored; did you mean "softening.',
    ),
]


@pytest.mark.parametrize(
    ("material", "key", "value", "message"),
    BAD,
    ids=lambda value: str(value)[:24] if isinstance(value, str) else "",
)
def test_bad_value(case, folder, capsys, material, key, value, message):
    entry = material | {key: value}
    if value is ABSENT:
        del entry[key]
    (folder / "case.json").write_text(json.dumps(case | {"materials": {"soil": entry}}))
    with pytest.raises(CaseError) as caught:
        load_case("case.json")
    wanted = [p for p in caught.value.problems if p.startswith(f"materials.soil.{key}: ")]
    assert len(wanted) == 1 and message in wanted[0], caught.value.problems

    assert cli.main(["case.json", "--output", "out"]) == cli.BAD_INPUT
    shown = capsys.readouterr().err
    assert message in shown and "Traceback" not in shown
    assert not (folder / "out").exists()


@pytest.mark.parametrize(("keys", "message"), DOUBTFUL, ids=lambda v: "+".join(v)[:40])
def test_doubtful_value(case, folder, keys, message):
    """Accepted with a warning, which --strict makes an error."""
    doubtful = case | {"materials": {"soil": SAND | keys}}
    assert any(f"materials.soil.{message}" in text for text in load_case(doubtful).warnings)
    with pytest.raises(CaseError):
        load_case(doubtful, strict=True)


@pytest.mark.parametrize("material", [SAND, WATER], ids=["sand", "water"])
@pytest.mark.parametrize("rate", ROTATIONS)
def test_sound_values(case, folder, material, rate):
    sound = case | {"materials": {"soil": material | {"objective_rate": rate}}}
    assert load_case(sound, strict=True).warnings == ()


@pytest.mark.parametrize(
    ("keys", "message"),
    [
        ({"load_state": True}, 'load_state: the stress of "neo-hookean" follows from its deform'),
        ({"compatibility": "mpm-geomechanics"}, 'type: MPM-Geomechanics has no "neo-hookean"'),
    ],
    ids=["load_state", "compatibility"],
)
def test_what_does_not_go_with_a_deformation_gradient(case, folder, keys, message):
    with pytest.raises(CaseError) as caught:
        load_case(case | {"materials": {"soil": RUBBER}} | keys)
    assert any(message in problem for problem in caught.value.problems)


def test_tension_without_bound_cannot_soften(case, folder):
    soil = SAND | {"friction": 0, "dilation": 0}
    del soil["tensile"]
    with pytest.raises(CaseError, match=r"materials\.soil\.tensile: is required where it softens"):
        load_case(case | {"materials": {"soil": soil}})


def test_only_density_and_stiffness_are_required(case, folder):
    """All strengths of MPM-Geomechanics are zero where they are absent."""
    soil = {key: SAND[key] for key in ("type", "id", "density", "young", "poisson")}
    [law] = load_case(case | {"materials": [soil]}).materials
    assert (law.friction, law.cohesion, law.dilation, law.tensile) == (0.0, 0.0, 0.0, None)


EXTREMES = [
    {"density": 1e100, "young": 1e-300},
    {"density": 1e-320, "young": 1e100},
    {"density": 1e-70},
    {"density": 1e70},
    {"young": 1e-320},
    {"density": 1e-30, "young": 1e100},
]


@pytest.mark.parametrize("law", [SAND, WATER], ids=lambda law: law["type"])
@pytest.mark.parametrize("keys", EXTREMES, ids=str)
def test_numbers_that_make_no_wave_speed(case, folder, keys, law):
    """Once divisions by zero, tracebacks."""
    stiffness = "young" if law is SAND else "bulk"
    keys = {stiffness if key == "young" else key: value for key, value in keys.items()}
    case["materials"] = {"soil": law | keys}
    del case["time_step"]
    with pytest.raises(CaseError) as caught:
        load_case(case)
    (problem,) = [p for p in caught.value.problems if "time" not in p]
    assert problem.startswith("materials.soil.density: ")
    assert "make no usable wave speed" in problem


@pytest.mark.parametrize("word", ["material", "materials"])
@pytest.mark.parametrize("as_list", [True, False], ids=["list", "object"])
@pytest.mark.parametrize("value", [float("inf"), float("nan"), 1e200])
def test_no_finite_number_in_either_spelling(case, folder, word, as_list, value):
    """Once the old spelling was not found to be wrong, and ended in a traceback."""
    soil = case.pop("materials")["soil"] | {"density": value}
    case[word] = [soil] if as_list else {"soil": soil}
    with pytest.raises(CaseError) as caught:
        load_case(case)
    (problem,) = caught.value.problems
    assert problem.startswith(f"{word}[0].density: " if as_list else f"{word}.soil.density: ")


def test_no_finite_number_behind_a_body_that_is_left_out(case, folder):
    block = case["body"]["block"] | {"point_p1": [0, 0, float("-inf")]}
    case["body"] = [{"type": "gmsh", "active": False}, block]
    with pytest.raises(CaseError) as caught:
        load_case(case)
    assert caught.value.problems == ["body[1].point_p1[2]: -Infinity is no finite number"]


def test_no_finite_number_in_other_old_spellings(case, folder):
    case["body"] = {
        "p": {
            "type": "particles",
            "particles": {"position": [[1, 1, 1]], "volume": [1], "material_id": float("nan")},
        }
    }
    case["results"]["material-point-results"] = {"fields": ["stress", float("inf")]}
    with pytest.raises(CaseError) as caught:
        load_case(case)
    for place in ("body.p.particles.material_id", "results.material-point-results.fields[1]"):
        assert any(p.startswith(f"{place}: ") for p in caught.value.problems)
