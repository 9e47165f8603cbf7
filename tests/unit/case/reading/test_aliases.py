"""Every old spelling means what the canonical key means, and is noted once."""

import copy

import pytest

from mpmgeo.case.load import load_case
from mpmgeo.case.reading.aliases import ALIASES, OBSOLETE
from mpmgeo.case.report import shown_key

RESULTS = {"material_point_results": ["stress", "velocity"]}


def put(case, place, key, value):
    """Set a key of the object at a place, making the objects on the way."""
    for name in place:
        case = case[0] if name == "*" else case.setdefault(name, {})
    case[key] = value


VALUES = {
    "critical_time_step_multiplier": 0.3,
    "nodal_point_load": [[[1, 1, 1], [0, 0, -1]]],
    "material_point_results": ["stress"],
    "grid_nodal_results": ["mass"],
    "value": 0.4,
    "point": [1, 1, 1],
}


def put_owner(case, alias):
    """Give the case what an alias is about, if that is a load or a kind of damping."""
    if alias.place[:1] == ("nodal_point_load",):
        case["nodal_point_load"] = [{"force": [0, 0, 1]}]
    if alias.place[:1] == ("damping",):
        case["damping"] = {"type": "local"} if len(alias.place) == 1 else [{"type": "local"}]


@pytest.mark.parametrize("alias", ALIASES, ids=lambda alias: alias.old)
def test_old_spelling_equals_canonical_one(case, alias):
    put_owner(case, alias)
    old, new = copy.deepcopy(case), case
    value = old.pop("materials") if alias.new == "materials" else VALUES[alias.new]
    put(old, alias.place, alias.old, value)
    put(new, alias.place, alias.new, value)
    loaded = load_case(old)
    assert loaded == load_case(new)
    assert loaded.warnings == ()
    assert len(loaded.notes) == (0 if alias.is_equal else 1)
    assert all(alias.old in note and alias.new in note for note in loaded.notes)


@pytest.mark.parametrize("alias", ALIASES, ids=lambda alias: alias.old)
def test_both_spellings_warn_and_one_wins(case, alias):
    put_owner(case, alias)
    value = case["materials"] if alias.new == "materials" else VALUES[alias.new]
    put(case, alias.place, alias.new, value)
    put(case, alias.place, alias.old, value)
    (warning,) = load_case(case).warnings
    unused = alias.new if alias.wins else alias.old
    where = ".".join((*alias.place, unused)).replace(".*", "[0]")
    assert warning.startswith(f"{where}: ignored")


def test_material_wins_over_materials(case):
    case["material"] = [case["materials"]["soil"] | {"young": 5e6}]
    assert load_case(case).materials[0].young == 5e6


@pytest.mark.parametrize(
    "form",
    [
        {"material_point_results": "stress"},
        {"material_point_results": {"fields": ["stress"]}},
        {"material-point-results": {"fields": ["stress"]}},
        {"material_point_results": {"material_point_results": ["stress"]}},
        {"fields": "stress"},
        {"fields": ["stress", "stress"]},
    ],
)
def test_every_form_of_a_field_list(case, form):
    case["results"] = form
    assert load_case(case).results.particle_fields == ("stress",)


def test_paths_name_the_users_spelling(case):
    case["results"] = {"grid-nodal-results": {"fields": ["mass", "wrong"]}}
    case["material"] = case.pop("materials")
    loaded = load_case(case)
    assert loaded.warnings[0].startswith('results.grid-nodal-results.fields[1]: "wrong"')
    assert loaded.results.grid_nodal_results == ("mass",)


@pytest.mark.parametrize(("place", "key"), OBSOLETE)
def test_obsolete_keys_are_ignored_with_advice(case, place, key):
    put(case, place, key, 1)
    (warning,) = load_case(case).warnings
    assert (
        warning == f'{shown_key(key)}: unknown key, ignored; did you mean "{OBSOLETE[place, key]}"?'
    )


@pytest.mark.parametrize("key", ["time_step", "n_threads"])
@pytest.mark.parametrize("zero", [0, 0.0])
def test_zero_means_automatic(case, key, zero):
    case[key] = zero
    assert getattr(load_case(case), key) is None


def test_a_fraction_of_an_output_is_dropped(case):
    case["results"] = {"print": 4.7}
    loaded = load_case(case)
    assert loaded.results.print == 4
    assert loaded.notes == ("results.print: 4.7 is rounded to 4",)


@pytest.mark.parametrize("kind", ["kinetic", "none"])
@pytest.mark.parametrize("key", ["value", "alpha"])
def test_damping_value_is_ignored_where_it_means_nothing(case, kind, key):
    case["damping"] = {"type": kind, key: 0.1}
    loaded = load_case(case, strict=True)
    assert loaded.damping.type == kind


def test_keys_of_two_phases_are_ignored(case):
    case["n_phases"] = 1
    case["mesh"]["boundary_conditions_fluid"] = {"plane_X0": "sliding"}
    case["materials"]["soil"] |= {
        "density_fluid": 1000,
        "porosity": 0.3,
        "bulk_fluid": 1e8,
        "hydraulic_conductivity": [0.01, 0.01, 0.01],
    }
    case["body"]["block"]["id"] = "any"
    assert load_case(case, strict=True).warnings == ()


UNREAD = [alias for alias in ALIASES if alias.is_unread]


@pytest.mark.parametrize("alias", UNREAD, ids=lambda alias: alias.old)
def test_spellings_that_mpm_geomechanics_does_not_read_are_ignored_with_the_switch(case, alias):
    case["compatibility"] = "mpm-geomechanics"
    plain = load_case(case)
    put(case, alias.place, alias.old, VALUES[alias.new])
    loaded = load_case(case)
    assert loaded == plain
    assert loaded.warnings == ()
    where = ".".join((*alias.place, alias.old))
    reads = f'since MPM-Geomechanics reads "{alias.new}" only'
    assert loaded.notes == (f'{where}: ignored with "compatibility", {reads}',)


def test_spellings_that_mpm_geomechanics_reads_count_with_the_switch(case):
    case |= {"compatibility": "mpm-geomechanics", "damping": {"type": "local", "alpha": 0.3}}
    assert load_case(case).damping.value == 0.3
