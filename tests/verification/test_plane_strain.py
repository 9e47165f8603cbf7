"""Plane strain by itself: one layer of particles for all gives what all of them give."""

import numpy as np
import pytest

import mpmgeo
from mpmgeo.mpm.columns import Columns
from mpmgeo.run.watch import Diverged

CELL = 0.1
ELASTIC = {"type": "elastic", "id": 1, "density": 2000, "young": 1e6, "poisson": 0.3}
SAND = ELASTIC | {"type": "mohr-coulomb", "friction": 20, "cohesion": 50.0, "dilation": 5}
LOCAL = {"damping": {"type": "local", "value": 0.2}}


def block(axis=1, thick=1, count=2, law=ELASTIC, **keys):
    """Return the case of a block that leans on a wall, `thick` cells between two smooth planes.

    Its edges lie off the nodes, where round-off decides nothing.
    """
    up = 1 if axis == 2 else 2
    (along,) = {0, 1, 2} - {axis, up}

    def place(a, u, thickness=0.0):
        x = [0.0, 0.0, 0.0]
        x[along], x[up], x[axis] = a, u, thickness
        return x

    cells, gravity = place(10, 8, thick), place(0, -9.81)
    return {
        "time": 1.0,
        "gravity": gravity,
        "mesh": {"cells_number": list(map(int, cells)), "cells_dimension": 3 * [CELL]},
        "materials": [law],
        "body": [
            {
                "type": "cuboid",
                "point_p1": place(0.025, 0.025),
                "point_p2": place(0.525, 0.425, thick * CELL),
                "material_id": 1,
                "particles_per_direction": 3 * [count],
            }
        ],
    } | keys


def both(steps=100, **keys):
    """Return the simulation of one layer and that of all, after some steps."""
    case = block(**keys)
    plane, whole = mpmgeo.Simulation(case), mpmgeo.Simulation(case | {"plane_strain": "off"})
    assert plane.solver.is_plane and not hasattr(whole.solver, "is_plane")
    return plane.step(steps), whole.step(steps)


def difference(plane, whole, *fields):
    """Return the largest difference of some fields in shares of their largest values."""
    pairs = [(plane.field(key), whole.field(key)) for key in fields]
    return max(float(np.abs(a - b).max() / np.abs(b).max()) for a, b in pairs)


FIELDS = ("position", "displacement", "velocity", "stress", "volume", "mass", "id", "body")


@pytest.mark.parametrize(
    "keys",
    [
        {},
        {"axis": 0},
        {"axis": 2},
        {"thick": 3, "count": 3},
        {"shape_function": "linear", "stress_scheme_update": "MUSL", "thick": 2},
        {"method": "recommended"},
        {"shape_function": "quadratic-bspline", "transfer": "apic", "thick": 2},
        {"stress_scheme_update": "NPC", "shape_function": "LME"},
        {"stress_scheme_update": "USF", "volumetric_locking": "cells"},
    ],
    ids=lambda keys: " ".join(map(str, keys.values())) or "USL GIMP",
)
def test_one_layer_is_all_of_them(keys):
    assert difference(*both(**keys), *FIELDS) < 1e-12


@pytest.mark.parametrize("damping", [{}, LOCAL], ids=["free", "damped"])
def test_sand_that_yields(damping):
    plane, whole = both(300, law=SAND, **damping)
    assert (whole.field("plastic_strain") > 0.0).mean() > 0.3
    assert difference(plane, whole, *FIELDS, "plastic_strain") < 1e-10


def test_kinetic_damping_comes_to_the_same_rest():
    plane, whole = both(1500, damping={"type": "kinetic"})
    assert difference(plane, whole, "displacement", "stress") < 1e-9


def test_nodes_and_energies_are_those_of_all_layers():
    plane, whole = both(thick=2, law=SAND, results={"energy": {"every": 10}})
    one, other = plane.nodes(), whole.nodes()
    first, second = np.lexsort(one.index.T), np.lexsort(other.index.T)
    assert (one.index[first] == other.index[second]).all()
    assert one.mass[first] == pytest.approx(other.mass[second], rel=1e-12)
    largest = np.abs(other.velocity).max()
    assert one.velocity[first] == pytest.approx(other.velocity[second], abs=1e-9 * largest)
    assert plane.kinetic_energy() == pytest.approx(whole.kinetic_energy(), rel=1e-11)
    size = max(map(abs, whole.energy().values()))
    assert list(plane.energy().values()) == pytest.approx(
        list(whole.energy().values()), abs=1e-11 * size
    )


PROBES = [
    {"type": "points", "name": "fit", "points": [[0.3, 0.04, 0.2]], "fields": ["velocity"]},
    {"type": "box", "name": "box", "point_p1": [0, 0, 0], "point_p2": [0.3, 0.06, 0.4],
     "fields": ["mass", "mean_stress"], "reduction": "sum"},
    {"type": "planes", "name": "planes"},
    {"type": "particles", "name": "particles", "ids": [3, 100], "fields": ["position", "mass"]},
]  # fmt: skip


def test_files_hold_all_layers(tmp_path):
    results = {
        "probes": [probe | {"every": 5} for probe in PROBES],
        "grid_nodal_results": ["mass", "velocity"],
        "print": 2,
    }
    for mode in ("auto", "off"):
        case = block(law=SAND, results=results, time=0.05, plane_strain=mode)
        mpmgeo.Simulation(case, output=tmp_path / mode).run()
    files = {path.relative_to(tmp_path / "off") for path in (tmp_path / "off").rglob("*")}
    assert files == {path.relative_to(tmp_path / "auto") for path in (tmp_path / "auto").rglob("*")}
    for probe in PROBES:
        name = f"probes/{probe['name']}.csv"
        one, other = (np.genfromtxt(tmp_path / mode / name, skip_header=1, delimiter=",")
                      for mode in ("auto", "off"))  # fmt: skip
        assert one == pytest.approx(other, abs=1e-9 * np.nanmax(np.abs(other)), nan_ok=True)


def test_tools_feel_the_force_of_all_layers():
    """A punch, of which only blocks in the middle of the mesh know, is pushed into the block."""
    tool = {"name": "punch", "velocity": [None, None, -0.1], "every": 1,
            "point_p1": [0.2, 0, 0.3], "point_p2": [0.3, 0.1, 0.5]}  # fmt: skip
    energy = {"energy": {"every": 10}}
    plane, whole = both(50, prescribed_velocity=[tool], results=energy)
    force = whole.reactions()["punch"][2]
    assert force != 0.0
    assert plane.reactions()["punch"][2] == pytest.approx(force, rel=1e-9)
    external = whole.energy()["external"]
    assert plane.energy()["external"] == pytest.approx(external, rel=1e-9)


def test_planes_across_carry_the_stress_across():
    case = block(thick=2, results={"probes": [{"type": "planes", "name": "p", "every": 1}]})
    plane = mpmgeo.Simulation(case).step(50)
    before = plane.field("stress")[:, 1] @ plane.field("volume") / (2 * CELL)
    forces = plane.step().reactions()
    assert forces["Y0"][1] == -forces["Yn"][1] == pytest.approx(-before, rel=1e-12)


@pytest.mark.parametrize("first, then", [("auto", "off"), ("off", "auto"), ("auto", "auto")])
def test_a_snapshot_resumes_in_either_mode(tmp_path, first, then):
    case = block(law=SAND, results={"energy": {"every": 10}})
    uninterrupted = mpmgeo.Simulation(case | {"plane_strain": first}).step(60)
    uninterrupted.save(tmp_path / "state.mpmgeo")
    other = case | {"plane_strain": then}
    resumed = mpmgeo.Simulation.resume(tmp_path / "state.mpmgeo", other)
    assert hasattr(resumed.solver, "is_plane") == (then == "auto")
    assert then == "off" or resumed.solver.is_plane
    most = difference(resumed.step(60), uninterrupted.step(60), *FIELDS)
    assert most == 0.0 if first == then else most < 1e-10
    assert resumed.steps == 120 and resumed.time == uninterrupted.time
    assert resumed.energy()["kinetic"] == pytest.approx(uninterrupted.energy()["kinetic"], rel=1e-9)


def test_values_that_differ_across_are_solved_in_space():
    plane, whole = both(10)
    for simulation in (plane, whole):
        velocity = simulation.field("velocity").copy()
        velocity[:, 1] += 0.01 * np.sin(40 * simulation.field("position")[:, 1])
        simulation.assign("velocity", velocity)
    assert not plane.solver.is_plane
    assert difference(plane.step(50), whole.step(50), *FIELDS) < 1e-12


def test_values_that_are_the_same_across_are_solved_in_the_plane():
    plane, whole = both(10)
    for simulation in (plane, whole):
        simulation.assign("velocity", simulation.field("velocity") + [0.1, 0.0, 0.0])
    assert plane.solver.is_plane
    assert difference(plane.step(50), whole.step(50), *FIELDS) < 1e-12


def test_particles_of_all_layers_leave_the_mesh():
    case = block(mesh=block()["mesh"] | {"boundary_conditions": {"plane_Xn": "free"}})
    case["body"][0]["initial_velocity"] = [20.0, 0.0, 0.0]
    plane = mpmgeo.Simulation(case).run(until=0.05)
    whole = mpmgeo.Simulation(case | {"plane_strain": "off"}).run(until=0.05)
    assert 0 < (plane.field("active") == 0).sum() < plane.solver.count
    assert (plane.field("active") == whole.field("active")).all()
    left = [np.concatenate([d.rows for d in s.solver.departures]) for s in (plane, whole)]
    assert sorted(left[0].tolist()) == sorted(left[1].tolist())
    assert difference(plane, whole, "position") < 1e-10


def test_a_run_that_diverges_goes_back_to_the_last_sound_state():
    case = block(time_step=0.05, results={"print": 0})
    plane = mpmgeo.Simulation(case)
    with pytest.raises(Diverged):
        plane.run()
    assert np.isfinite(plane.field("position")).all()


@pytest.mark.parametrize(
    "keys, reason",
    [
        ({"gravity": [0, 0.1, -9.81]}, "gravity has a component across"),
        ({"particle_domain": "updated"}, 'particle_domain is "updated"'),
        ({"thick": 3, "method": "recommended"}, "cubic-bspline allows it up to 2 cells thick"),
        (
            {"nodal_point_load": [[[0.2, 0.0, 0.2], [0.0, 0.0, -1.0]]]},
            "a nodal_point_load acts on one place across",
        ),
        (
            {"load_distributed_box": [{"point_p1": [0, 0, 0], "point_p2": [1, 0.05, 1],
                                       "load": [0, 0, -1]}]},
            "particles begin with different values across (force)",
        ),
    ],
)  # fmt: skip
def test_what_stands_in_the_way_is_told(keys, reason):
    simulation = mpmgeo.Simulation(block(**keys))
    assert not hasattr(simulation.solver, "is_plane")
    assert f"plane strain across y is not used: {reason}" in simulation.messages or (
        keys.get("thick") == 3
    )


def test_bodies_that_do_not_span_the_thickness_stand_in_the_way():
    case = block(thick=2)
    case["body"][0]["point_p2"][1] = CELL
    simulation = mpmgeo.Simulation(case)
    assert not hasattr(simulation.solver, "is_plane")
    reason = "particles do not fill the thickness evenly"
    assert f"plane strain across y is not used: {reason}" in simulation.messages


def test_it_is_told_and_can_be_switched_off():
    plane, whole = both(1)
    note = "plane strain: nothing changes along y; one layer of particles is solved for all 2"
    assert note in plane.messages
    assert not [text for text in whole.messages if "plane strain" in text]


def test_columns_know_who_stands_for_whom():
    columns = Columns(1, np.array([0, 1, 0, 3, 1, 3]), 2)
    assert columns.rows_of(np.array([1, 3])).tolist() == [1, 3, 4, 5]
