"""The balance of energy: exact where the method is, of second order where time steps count."""

import json
from math import log2
from pathlib import Path

import numpy as np
import pytest
from scenes import cuboid, scene, simulate

import mpmgeo
from mpmgeo.run.watch import Diverged
from mpmgeo.verify.bar import Bar

BAR = Bar(velocity_peak=1e-5)
COLUMNS = ("kinetic", "strain", "external", "plastic", "damping", "balance")
SCHEMES = ("USL", "MUSL", "USF")


def ledger(simulation, steps):
    """Return the columns of all rows of so many steps, by name."""
    rows = []
    for _ in range(steps):
        simulation.step()
        rows.append(simulation.solver.ledger.row().copy())
    return dict(zip(COLUMNS, np.array(rows).T, strict=True))


def kept(case, every=1):
    return case | {"results": {"energy": {"every": every}}}


def vibration(scheme, courant):
    simulation = simulate(kept(BAR.case(25, scheme, BAR.period, courant)))
    BAR.start(simulation)
    start = simulation.kinetic_energy()
    rows = ledger(simulation, round(BAR.period / simulation.time_step))
    return rows, start


@pytest.mark.parametrize("scheme", SCHEMES)
def test_a_vibration_keeps_its_energy(scheme):
    """To 0.2 % at every instant of a period of 250 or more steps; nothing dissipates."""
    rows, start = vibration(scheme, 0.4)
    assert np.abs(rows["balance"]).max() < 2e-3 * start
    assert np.ptp(rows["strain"]) > 0.9 * start
    assert np.abs(rows["plastic"]).max() < 1e-6 * start
    assert not rows["external"].any()
    assert not rows["damping"].any()


def test_a_vibration_of_large_strains_keeps_its_energy():
    """A neo-Hookean bar, strained by 6 %: to 0.5 %, and no work of its stresses is lost."""
    bar = Bar(velocity_peak=1.0)
    case = kept(bar.case(25, "MUSL", bar.period, 0.2))
    case["materials"][0]["type"] = "neo-hookean"
    simulation = simulate(case)
    bar.start(simulation)
    start = simulation.kinetic_energy()
    rows = ledger(simulation, round(bar.period / simulation.time_step))
    assert np.abs(rows["balance"]).max() < 5e-3 * start
    assert np.ptp(rows["strain"]) > 0.9 * start
    assert np.abs(rows["plastic"]).max() < 1e-12 * start


@pytest.mark.parametrize("scheme", ["MUSL", "USF"])
def test_the_balance_is_of_second_order_in_the_step(scheme):
    """USL is left out: what its transfers lose, 1e-4, does not depend on the step."""
    errors = [np.abs(vibration(scheme, c)[0]["balance"]).max() for c in (0.4, 0.2)]
    assert abs(log2(errors[0] / errors[1]) - 2) < 0.1


@pytest.mark.parametrize("scheme", SCHEMES)
def test_weight_does_the_work_of_a_fall(scheme):
    """To round-off in every step: kinetic energy less that at the start is external work."""
    body = cuboid((1, 1, 3), (2, 2, 4), initial_velocity=[0.5, 0, 1.0])
    case = scene([8, 4, 6], 1.0, [body], time=1.0, time_step=0.01, gravity=[0, 0, -9.81])
    case["stress_scheme_update"] = scheme
    simulation = simulate(kept(case))
    start = simulation.kinetic_energy()
    rows = ledger(simulation, 40)
    assert np.ptp(rows["external"]) > 1000
    assert np.abs(rows["kinetic"] - start - rows["external"]).max() < 1e-12 * start
    assert np.abs(rows["balance"]).max() < 1e-12 * start


def column(**keys):
    """Return the case of a column on a floor between smooth walls."""
    body = cuboid((0, 0, 0), (0.1, 0.1, 1.0))
    keys = {"time": 1.0, "time_step": 5e-4} | keys
    return kept(scene([1, 1, 12], 0.1, [body], **keys))


def test_a_plane_that_pushes_does_the_work():
    """A plate presses a column by 1 %: its work is the energy of the column, to 2 %.

    Half of what lacks is lost in the first step, when the plate meets what is at rest.
    """
    plate = {"plane": "Zn", "velocity": [None, None, -0.1]}
    case = column(prescribed_velocity={"plate": plate}, stress_scheme_update="MUSL")
    case["mesh"]["cells_number"] = [1, 1, 10]
    rows = ledger(simulate(case), 200)
    assert rows["external"][-1] > 0
    assert np.abs(rows["balance"]).max() < 0.02 * rows["external"][-1]


@pytest.mark.parametrize("by", ["nodes", "particles"])
def test_loads_do_the_work(by):
    """A constant force at the top swings a column: balance to 1 % of what is put in at most."""
    if by == "nodes":
        corners = [[x, y, 1.0] for x in (0.0, 0.1) for y in (0.0, 0.1)]
        loads = {"nodal_point_load": [[corner, [0, 0, -2.5]] for corner in corners]}
    else:
        box = {"point_p1": [0, 0, 0.9], "point_p2": [0.1, 0.1, 1.0], "load": [0, 0, -10.0]}
        loads = {"load_distributed_box": {"top": box}}
    rows = ledger(simulate(column(stress_scheme_update="MUSL", **loads)), 400)
    assert rows["external"].min() >= 0
    assert np.abs(rows["balance"]).max() < 0.01 * rows["external"].max()


@pytest.mark.parametrize(
    ("damping", "share"),
    [
        ({"type": "mass", "alpha": 20.0}, 0.02),
        ({"type": "local", "value": 0.3}, 0.02),
        ({"type": "kinetic"}, 0.02),
    ],
    ids=lambda value: value["type"] if isinstance(value, dict) else "",
)
def test_damping_takes_what_the_weight_has_done(damping, share):
    """A column settles: weight's work is left as strain or damped, to a share of that work."""
    case = column(stress_scheme_update="MUSL", gravity=[0, 0, -9.81], damping=damping)
    rows = ledger(simulate(case), 1500)
    assert rows["kinetic"][-1] < 0.02 * rows["strain"][-1]
    assert (np.diff(rows["damping"]) >= 0).all()
    assert rows["damping"][-1] > 0.4 * rows["external"][-1]
    assert abs(rows["balance"][-1]) < share * rows["external"][-1]


def test_what_fails_dissipates():
    """A column of sand collapses: plastic work never falls; transfers lose less than a tenth."""
    sand = {
        "type": "mohr-coulomb",
        "id": 1,
        "density": 2000.0,
        "young": 1e6,
        "poisson": 0.25,
        "friction": 30.0,
    }
    case = scene(
        [12, 1, 8],
        0.05,
        [cuboid((0, 0, 0), (0.2, 0.05, 0.3))],
        time=1.0,
        gravity=[0, 0, -9.81],
        boundary_conditions={"plane_Z0": "fixed"},
    )
    case["materials"] = [sand]
    simulation = simulate(kept(case))
    rows = ledger(simulation, round(0.4 / simulation.time_step))
    assert (np.diff(rows["plastic"]) >= -1e-6 * rows["plastic"][-1]).all()
    assert rows["plastic"][-1] > 0.5 * rows["external"][-1]
    assert -0.1 * rows["external"][-1] < rows["balance"][-1] < 0


INPUTS = Path(__file__).parents[2] / "inputs"


@pytest.mark.parametrize(
    ("name", "share"),
    [("terrain_slide", 0.01), ("base_acceleration", 0.01), ("terminal_velocity", 1e-12)],
)
def test_the_balance_of_what_slides_is_shaken_or_sinks(name, share, monkeypatch):
    """Contact, a moving base and mass damping; share of the largest of the figures."""
    case = json.loads((INPUTS / name / "case.json").read_text(encoding="utf-8"))
    case.setdefault("results", {})["energy"] = {"every": 20}
    monkeypatch.chdir(INPUTS / name)
    simulation = simulate(case).run()
    row = simulation.energy()
    largest = max(abs(row[column]) for column in COLUMNS)
    assert abs(row["external"]) > 0.4 * largest
    assert abs(row["balance"]) < share * largest


def test_a_run_that_diverges_says_so_and_nothing_else():
    """Sums of infinite numbers raise no warnings; the row is that of the last sound state."""
    bar = Bar(velocity_peak=1e-9)
    with pytest.warns(mpmgeo.CaseWarning, match="up to which USL with GIMP is stable"):
        simulation = simulate(kept(bar.case(25, "USL", 4 * bar.period, courant=1.3)))
    bar.start(simulation)
    with pytest.raises(Diverged), np.errstate(all="raise"):
        simulation.run()
    assert simulation.steps == 0
    assert simulation.energy()["kinetic"] == simulation.kinetic_energy()


@pytest.mark.parametrize(
    ("key", "message"),
    [
        ({"n_phases": 2}, "the balance of energy is for one phase"),
        ({"compatibility": "mpm-geomechanics"}, "there is no balance of energy with compatibility"),
    ],
    ids=["two phases", "compatibility"],
)
def test_where_there_is_no_balance_it_is_refused(key, message):
    with pytest.raises(mpmgeo.CaseError) as caught:
        mpmgeo.load_case(column(**key))
    assert [p for p in caught.value.problems if p.startswith(f"results.energy: {message}")]


def test_the_file_has_a_row_for_the_start_and_every_interval(tmp_path):
    case = column(gravity=[0, 0, -9.81], time=0.0202)
    case["results"]["energy"]["every"] = 10
    simulation = mpmgeo.Simulation(case, tmp_path).run()
    header, *lines = (tmp_path / "energy.csv").read_text(encoding="ascii").splitlines()
    assert header == ",".join(["time", *COLUMNS])
    rows = np.array([line.split(",") for line in lines], float)
    np.testing.assert_allclose(rows[:, 0], 0.005 * np.arange(5), atol=1e-12)
    assert not rows[0].any()
    assert rows[-1, 1:].tolist() == list(simulation.energy().values())
    assert (np.diff(rows[:, 3]) > 0).all()


def sand(**keys):
    """Return the case of a block of sand that is torn."""
    law = {"type": "mohr-coulomb", "id": 1, "density": 2000.0, "young": 1e6, "poisson": 0.3}
    body = cuboid((0.2, 0.2, 0), (0.6, 0.6, 0.4))
    case = scene([8, 8, 8], 0.1, [body], time=1.0, gravity=[0, 0, -9.81])
    case["mesh"]["boundary_conditions"] = {"plane_Z0": "fixed"}
    case["materials"] = [law | {"friction": 30.0, "tensile": 0.0}]
    return kept(case | keys)


@pytest.mark.parametrize("scheme", ["USL", "MUSL"])
def test_pore_pressure_works_on_what_opens(tmp_path, scheme):
    """What blows the sand apart is put in, and nothing appears that was not."""
    file = tmp_path / "p.json"
    file.write_text('[{"position": [0.4, 0.4, 0.2], "pressure": 5000.0}]')
    coupling = {"enabled": True, "pore_pressure_field": str(file), "radius": 10.0}
    case = sand(hydro_mechanical_coupling=coupling, stress_scheme_update=scheme)
    simulation = simulate(case)
    rows = ledger(simulation, round(0.3 / simulation.time_step))
    assert simulation.field("opening").max() > 0.1
    assert rows["kinetic"][-1] > 50
    assert (rows["balance"] < 0.01 * rows["kinetic"].max()).all()


def test_elastic_energy_is_that_of_the_stresses():
    """However it was squeezed in between; it never falls below zero."""
    simulation = simulate(sand(stress_scheme_update="MUSL"))
    simulation.assign("velocity", np.tile([4.0, 0.0, 4.0], (simulation.solver.count, 1)))
    rows = ledger(simulation, round(0.8 / simulation.time_step))
    assert (rows["strain"] >= 0).all()
    now = simulation.solver.tally().strain.sum()
    assert rows["strain"][-1] == pytest.approx(now, rel=0.1)
    assert rows["balance"].max() < 0.01 * rows["kinetic"].max()


@pytest.mark.parametrize("scheme", SCHEMES)
def test_a_balance_that_begins_anew_has_no_step_in_it(scheme):
    """Assigned velocities are those of half a step before, as the figures are."""
    body = cuboid((1, 1, 3), (2, 2, 4), initial_velocity=[0.5, 0, 1.0])
    case = scene([8, 4, 6], 1.0, [body], time=1.0, time_step=0.01, gravity=[0, 0, -9.81])
    simulation = simulate(kept(case | {"stress_scheme_update": scheme}))
    simulation.step(20)
    simulation.assign("velocity", simulation.field("velocity"))
    start = simulation.kinetic_energy()
    rows = ledger(simulation, 20)
    assert np.abs(rows["balance"]).max() < 1e-12 * start
