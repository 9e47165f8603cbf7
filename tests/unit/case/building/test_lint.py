"""Warnings about simulations that are possible, but hardly meant."""

from types import SimpleNamespace

import numpy as np
import pytest

from mpmgeo.case.building.lint import lint, significant_frequency
from mpmgeo.case.load import load_case
from mpmgeo.loads import Record


def simulation_of(case, time_step=1e-3, stable_time_step=1e-2):
    """Return what lint looks at of a simulation: times, positions and bodies."""
    loaded = load_case(case)
    cell = np.array(loaded.mesh.cells_dimension)
    clouds = [body.generate(cell).position for body in loaded.body if body.active]
    fields = {
        "position": np.concatenate(clouds),
        "body": np.repeat(np.arange(1, len(clouds) + 1, dtype=np.uint32), list(map(len, clouds))),
        "material": np.ones(sum(map(len, clouds)), np.int64),
    }
    return SimpleNamespace(
        case=loaded,
        time_step=time_step,
        critical_time_step=2e-2,
        stable_time_step=stable_time_step,
        field=fields.__getitem__,
    )


def test_nothing_to_say_about_a_sound_case(case):
    assert lint(simulation_of(case)) == []


def test_unstable_time_step(case):
    (warning,) = lint(simulation_of(case, time_step=0.02))
    assert warning == (
        "time_step: 0.02 s exceeds 0.01 s, up to which USL with GIMP is stable here; the run may "
        'diverge; try 0.009 s or less, or "stress_scheme_update": "MUSL"'
    )


@pytest.mark.parametrize("scheme", ["MUSL", "USF"])
def test_unstable_time_step_of_a_scheme_that_bears_long_ones(case, scheme):
    (warning,) = lint(simulation_of(case | {"stress_scheme_update": scheme}, time_step=0.02))
    assert f"{scheme} with GIMP is stable here" in warning and warning.endswith("0.009 s or less")


def test_without_a_stable_time_step_the_critical_one_counts(case):
    case |= {"shape_function": "linear"}
    assert lint(simulation_of(case, time_step=0.02, stable_time_step=0.0)) == []
    (warning,) = lint(simulation_of(case, time_step=0.03, stable_time_step=0.0))
    assert warning == "time_step: 0.03 s exceeds the critical 0.02 s; the run may diverge"


def test_particles_outside_the_mesh(case):
    case["body"]["block"] |= {"point_p1": [1.5, 0, 0], "point_p2": [2.5, 1, 1]}
    (warning,) = lint(simulation_of(case))
    assert warning.startswith("32 of 64 particles start outside the mesh")
    assert "row 32 at (2.125, 0.125, 0.125) m" in warning


def test_body_without_particles(case):
    case["body"]["small"] = {
        "type": "polygon_2d",
        "points": [[0, 0, 0], [0.01, 0, 0], [0, 0, 0.01]],
        "extrude_direction": "y",
        "extrude_displacement": 1,
        "material_id": 1,
    }
    assert lint(simulation_of(case)) == ["body 2 (polygon_2d) holds no particle"]


def test_loads_that_meet_no_particle(case):
    case["load_distributed_box"] = [
        {"point_p1": [1.5, 1.5, 1.5], "point_p2": [2, 2, 2], "load": [0, 0, 1]},
        {"point_p1": [0, 0, 0], "point_p2": [2, 2, 2], "load": [0, 0, 1]},
    ]
    case["nodal_point_load"] = [[[2, 2, 2], [0, 0, 1]], [[1, 1, 1], [0, 0, 1]]]
    box, point = lint(simulation_of(case))
    assert box.startswith("load_distributed_box, entry 1: no particle in the box")
    assert point.startswith("nodal_point_load, entry 1: no particle near [2.0, 2.0, 2.0]")


def test_boxes_of_the_fluid_without_particles(case):
    box = {"point_p1": [9, 9, 9], "point_p2": [9, 9, 9]}
    case["prescribed_pressure_box"] = [box | {"pressure": 1}]
    case["pressure_force_box"] = [box | {"pressure_force": [0, 0, 1]}]
    assert lint(simulation_of(case)) == []
    water = {"density_fluid": 1000, "porosity": 0.4, "bulk_fluid": 1e6}
    case["materials"]["soil"] |= water | {"hydraulic_conductivity": [1, 1, 1]}
    warnings = lint(simulation_of(case | {"n_phases": 2}))
    assert warnings == [
        "prescribed_pressure_box, entry 1: no particle in the box; nothing happens",
        "pressure_force_box, entry 1: no particle in the box; nothing happens",
    ]


@pytest.fixture
def shaken(case, tmp_path):
    """Make a case with a sine of the given frequency [Hz], interval and duration [s] as base."""

    def shake(frequency, interval=1e-3, duration=1.0):
        time = np.arange(0, duration + interval / 2, interval)
        record = np.c_[time, np.sin(2 * np.pi * frequency * time), 0 * time, 0 * time]
        np.savetxt(tmp_path / "record.csv", record, delimiter=",", header="t,x,y,z", comments="")
        case["earthquake"] = {"active": True, "file": str(tmp_path / "record.csv")}
        return case

    return shake


def test_sound_record(shaken):
    assert lint(simulation_of(shaken(1))) == []


def test_record_that_ends_early(shaken):
    (warning,) = lint(simulation_of(shaken(20, duration=0.05) | {"mesh": fine_mesh()}))
    assert warning == "earthquake: the record ends at 0.05 s, the run at 0.1 s"


def fine_mesh():
    return {"cells_number": [20, 20, 20], "cells_dimension": [0.05, 0.05, 0.05]}


def test_records_too_coarse_for_their_content(shaken):
    (warning,) = lint(simulation_of(shaken(2, interval=0.2)))
    assert warning == (
        "earthquake: the record shakes with up to 2.5 Hz, too fast for values 0.2 s apart"
    )


def test_steps_that_skip_what_the_record_holds(shaken):
    (warning,) = lint(simulation_of(shaken(2), time_step=0.2, stable_time_step=1))
    assert warning.endswith("with up to 2 Hz, too fast for time steps 0.2 s apart")


def test_waves_too_short_for_the_cells(shaken):
    (warning,) = lint(simulation_of(shaken(20)))
    assert "shakes with up to 20 Hz" in warning
    assert "need cells of 0.0694 m or less" in warning


def test_prescribed_velocities_of_nobody(case):
    box = {"point_p1": [9, 9, 9], "point_p2": [9, 9, 9], "velocity": [1, None, None]}
    case["prescribed_velocity"] = {"ram": box, "all": {"body": 1, "velocity": [1, 0, 0]}}
    (warning,) = lint(simulation_of(case))
    assert warning == "prescribed_velocity, ram: no particle is meant; nothing happens"


def test_table_of_velocities_that_ends_early(case, tmp_path):
    file = tmp_path / "v.csv"
    case["prescribed_velocity"] = [{"plane": "Zn", "file": str(file)}]
    file.write_text("0,0,0,1\n0.1,0,0,1\n")
    assert lint(simulation_of(case)) == []
    file.write_text("0,0,0,1\n0.09,0,0,1\n")
    (warning,) = lint(simulation_of(case))
    assert "the table ends at 0.09 s, the run at 0.1 s" in warning


def test_probes_outside_the_mesh(case):
    points = [[0, 0, 0], [2, 2, 2], [2, 2.001, 2]]
    probe = {"type": "points", "points": points, "fields": ["stress"]}
    case["results"] = {"probes": {"tip": probe, "walls": {"type": "planes"}}}
    (warning,) = lint(simulation_of(case))
    assert warning == "results.probes, tip: the point [2.0, 2.001, 2.0] is outside the mesh"


def rock(case, young, **keys):
    """Return a case with a second body, of rock, on the first one."""
    case["materials"]["rock"] = case["materials"]["soil"] | {"id": 7, "young": young}
    low, high = {"point_p1": [0, 0, 1]}, {"point_p2": [1, 1, 2]}
    case["body"]["lid"] = case["body"]["block"] | low | high | {"material_id": 7}
    return case | keys


def test_contrasts_of_stiffness(case):
    (warning,) = lint(simulation_of(rock(case, 1e9)))
    assert warning.startswith("materials: 7 is 1e+03 times as stiff as 1; where they meet, GIMP")


@pytest.mark.parametrize("young", [1e4 * 4, 1e6, 2e7])
def test_materials_of_like_stiffness(case, young):
    assert lint(simulation_of(rock(case, young))) == []


def test_contrasts_that_do_no_harm(case):
    """Where the shape does not smear them, or only one of the materials is there."""
    linear = {"shape_function": "linear", "stress_scheme_update": "MUSL"}
    assert lint(simulation_of(rock(case, 1e9, **linear))) == []
    case["body"]["lid"]["active"] = False
    assert lint(simulation_of(case)) == []


@pytest.mark.parametrize("frequency", [1.0, 3.5, 40.0])
def test_significant_frequency_of_a_sine(frequency):
    time = np.linspace(0, 10, 2001)
    wave = np.sin(2 * np.pi * frequency * time)
    record = Record(time, np.c_[wave, 0 * wave, 0 * wave])
    assert abs(significant_frequency(record) - frequency) < 0.5


@pytest.mark.parametrize("count", [1, 2, 50])
def test_significant_frequency_of_rest(count):
    record = Record(np.arange(count, dtype=float), np.zeros((count, 3)))
    assert significant_frequency(record) == 0


UNDRAINED = {"type": "mohr-coulomb", "young": 1e6, "poisson": 0.3, "su_vertical_stress": 0.2}
LOCKS = [
    ({"poisson": 0.49}, "poisson 0.49"),
    (UNDRAINED | {"friction": 30}, "su_vertical_stress, flow without dilation"),
    (UNDRAINED | {"su_vertical_stress": 0, "cohesion": 1e3}, "friction 0, flow without dilation"),
]


@pytest.mark.parametrize(("keys", "reason"), LOCKS)
def test_material_that_locks(case, keys, reason):
    case["gravity"] = [0, 0, -9.81]
    case["materials"]["soil"] |= keys
    (warning,) = lint(simulation_of(case))
    assert warning == (
        f"materials: 1 hardly changes its volume ({reason}), which makes cells of 8 particles too "
        'stiff; "volumetric_locking": "cells" mends it'
    )
    assert lint(simulation_of(case | {"volumetric_locking": "cells"})) == []


def test_what_cannot_lock(case):
    """A row of cells, one particle in each, a material that shrinks and swells."""
    case["materials"]["soil"]["poisson"] = 0.49
    body = case["body"]["block"]
    case["body"]["block"] = body | {"point_p1": [0, 0, 0], "point_p2": [0.5, 0.5, 2]}
    assert lint(simulation_of(case)) == []
    case["body"]["block"] = body | {"particles_per_direction": [1, 1, 1]}
    assert lint(simulation_of(case)) == []
