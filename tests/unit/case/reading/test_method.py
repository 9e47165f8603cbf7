"""`"method": "recommended"` fills in what a case does not say."""

import pytest
from assembly import two_blocks

import mpmgeo
from mpmgeo.case.load import resolved
from mpmgeo.case.reading.method import RECOMMENDED

WATER = {
    "density_fluid": 1000.0,
    "porosity": 0.4,
    "bulk_fluid": 1e8,
    "hydraulic_conductivity": [1e-3, 1e-3, 1e-3],
}


def test_all_of_it():
    case = mpmgeo.load_case(two_blocks(method="recommended"))
    found = resolved(case)
    assert {key: found[key] for key in RECOMMENDED} == RECOMMENDED
    assert resolved(mpmgeo.load_case(found)) == found


@pytest.mark.parametrize(
    "key, value", [("shape_function", "GIMP"), ("transfer", {"type": "apic"})], ids=str
)
def test_what_a_case_says_itself_counts(key, value):
    found = resolved(mpmgeo.load_case(two_blocks(method="recommended", **{key: value})))
    assert found[key] == value
    others = set(RECOMMENDED) - {key}
    assert {k: found[k] for k in others} == {k: RECOMMENDED[k] for k in others}


def test_two_phases_have_no_other_transfer():
    case = two_blocks(method="recommended", n_phases=2)
    case["materials"] = [law | WATER for law in case["materials"]]
    assert mpmgeo.load_case(case).transfer.type == "flip"


def test_a_case_without_it_is_what_it_was():
    case = mpmgeo.load_case(two_blocks())
    assert (case.shape_function, case.stress_scheme_update) == ("GIMP", "USL")
    assert case.transfer.symbols is None


def test_not_as_in_mpm_geomechanics():
    case = two_blocks(method="recommended", compatibility="mpm-geomechanics")
    with pytest.raises(mpmgeo.CaseError, match="method: MPM-Geomechanics has its own"):
        mpmgeo.load_case(case)
