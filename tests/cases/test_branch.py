"""A run that goes on from a snapshot with other values of named keys, and what keeps the record."""

import json
import re

import numpy as np
import pytest
from assembly import two_blocks

import mpmgeo
from mpmgeo import cli
from mpmgeo.state.snapshot import StoredSnapshot

MOON = {"gravity": [0, 0, -1.6]}
EARTH = {"gravity": [0, 0, -9.8]}


@pytest.fixture
def snapshot(tmp_path, monkeypatch):
    """A snapshot after 20 of 50 steps of 1 ms, on earth; the working directory is beside it."""
    monkeypatch.chdir(tmp_path)
    simulation = mpmgeo.Simulation(two_blocks(**EARTH))
    simulation.step(20).save("s.npz")
    return "s.npz"


def momentum(simulation):
    return simulation.field("mass") @ simulation.field("velocity")


def test_a_branch_goes_on_with_the_new_value(snapshot):
    branch = mpmgeo.Simulation.resume(snapshot, case=two_blocks(**MOON), allow=["gravity"])
    before, mass = momentum(branch), branch.field("mass").sum()
    assert before[2] == pytest.approx(-2.0 * 500 - 9.8 * 19.5e-3 * mass)
    branch.step(10)
    assert momentum(branch) - before == pytest.approx([0, 0, -1.6 * 10e-3 * mass], abs=1e-9)


@pytest.mark.parametrize("allow", ["gravity", ["gravity[2]"], ["title", "gravity", "materials"]])
def test_keys_are_named_as_far_as_they_matter(snapshot, allow):
    branch = mpmgeo.Simulation.resume(snapshot, two_blocks(**MOON), allow=allow)
    assert branch.case.gravity[2] == -1.6


def test_a_law_is_changed_and_its_stress_stays(snapshot):
    case = two_blocks(**EARTH)
    case["materials"][0]["young"] = 5e6
    branch = mpmgeo.Simulation.resume(snapshot, case, allow=["materials[0].young"])
    plain = mpmgeo.Simulation.resume(snapshot)
    assert (branch.field("stress") == plain.field("stress")).all()
    strain = np.array([1e-3, 0, 0])
    x = branch.field("position") - branch.field("position").mean(axis=0)
    for simulation in (branch, plain):
        simulation.assign("velocity", x * strain / simulation.time_step)
        simulation.step()
    soft = branch.field("material") == 4
    change = [np.abs(s.field("stress")[soft]).max() for s in (branch, plain)]
    assert change[0] > 3 * change[1]


def test_later_snapshots_record_the_changes(snapshot):
    """Those of the first branch stay when a second one leaves it."""
    first = mpmgeo.Simulation.resume(snapshot, two_blocks(**MOON), allow=["gravity"])
    assert first.changes == [
        {"time": first.time, "steps": 20, "values": {"gravity[2]": (-9.8, -1.6)}}
    ]
    assert any("gravity[2]: -1.6 from 0.02 s on, -9.8 before" in m for m in first.messages)
    first.step(5).save("moon.npz")
    weak = two_blocks(**MOON)
    weak["materials"][1]["young"] = 1e6
    second = mpmgeo.Simulation.resume("moon.npz", weak, allow=["materials[1].young"])
    second.save("weak.npz")
    changes = StoredSnapshot("weak.npz").facts["changes"]
    assert [change["steps"] for change in changes] == [20, 25]
    assert changes[0]["values"] == {"gravity[2]": [-9.8, -1.6]}
    assert changes[1]["values"] == {"materials[1].young": [2e6, 1e6]}
    assert mpmgeo.Simulation.resume("weak.npz").case.gravity[2] == -1.6


def test_a_run_without_changes_records_none(snapshot):
    assert StoredSnapshot(snapshot).facts["changes"] == []
    assert mpmgeo.Simulation.resume(snapshot, allow=["gravity"]).changes == []


GROWING = {"gravity": {"value": [0, 0, -8.0], "time": [0.02, 0.03], "factor": [0, 1]}}


def test_gravity_begins_to_change(snapshot):
    """From 20 ms on it grows from nothing within 10 ms; velocities are half a step behind."""
    case = two_blocks(**GROWING)
    with pytest.raises(ValueError, match=re.escape("gravity[0], gravity[1], gravity[2]")):
        mpmgeo.Simulation.resume(snapshot, case=case)
    branch = mpmgeo.Simulation.resume(snapshot, case=case, allow=["gravity"])
    before, mass = momentum(branch), branch.field("mass").sum()
    assert branch.field("external_force") == pytest.approx(0, abs=1e-9 * mass)
    branch.step(20)
    impulse = -8.0 * (5e-3 + 9.5e-3) * mass
    assert momentum(branch) - before == pytest.approx([0, 0, impulse], abs=1e-9)
    assert branch.field("external_force").sum(axis=0) == pytest.approx([0, 0, -8.0 * mass])


def test_gravity_changes_no_more(snapshot, tmp_path):
    branch = mpmgeo.Simulation.resume(snapshot, case=two_blocks(**GROWING), allow=["gravity"])
    branch.step(5).save("growing.npz")
    same = mpmgeo.Simulation.resume("growing.npz")
    assert (same.field("external_force") == branch.field("external_force")).all()
    assert same.field("external_force").any()
    calm = mpmgeo.Simulation.resume("growing.npz", two_blocks(**MOON), allow=["gravity"])
    assert calm.field("external_force")[:, 2] == pytest.approx(-1.6 * calm.field("mass"))


REFUSED = {
    "not named": (MOON, ["materials"], "is of another case, or its files have changed: gravity[2]"),
    "no key": (MOON, ["gravty"], "allow: the case has no key gravty; did you mean gravity?"),
    "phases": ({"n_phases": 2}, ["n_phases"], "n_phases cannot change"),
    "cells": (
        {"mesh": two_blocks()["mesh"] | {"cells_number": [9, 6, 10]}},
        ["mesh"],
        "mesh.cells_number[0] cannot change: the snapshot's particles have it",
    ),
    "bodies": ({"body": two_blocks()["body"][:1]}, ["body"], "cannot change"),
    "density": (
        {"materials": [law | {"density": 500.0} for law in two_blocks()["materials"]]},
        ["materials"],
        "materials[0].density cannot change",
    ),
    "a variable": (
        {"results": {"material_point_results": ["strain"]}},
        ["results"],
        "the snapshot lacks set0.strain, which the case needs",
    ),
}


@pytest.mark.parametrize("name", REFUSED)
def test_what_cannot_change(snapshot, name):
    keys, allow, message = REFUSED[name]
    if "n_phases" in keys:
        water = {"density_fluid": 1e3, "porosity": 0.4, "bulk_fluid": 1e6}
        water["hydraulic_conductivity"] = [1, 1, 1]
        keys = keys | {"materials": [law | water for law in two_blocks()["materials"]]}
        allow = [*allow, "materials"]
    with pytest.raises(ValueError, match=re.escape(message)):
        mpmgeo.Simulation.resume(snapshot, two_blocks(**EARTH) | keys, allow=allow)


def test_from_the_command_line(snapshot, tmp_path, capsys):
    (tmp_path / "moon.json").write_text(json.dumps(two_blocks(**MOON)))
    words = ["moon.json", "--resume", snapshot, "--check"]
    assert cli.main(words) == cli.BAD_INPUT
    assert "gravity[2]; keys that are to change are named by --allow" in capsys.readouterr().err
    assert cli.main([*words, "--allow", "gravity"]) == cli.DONE
    shown = capsys.readouterr()
    assert json.loads(shown.out)["gravity"] == [0, 0, -1.6]
    assert "note: gravity[2]: -1.6 from 0.02 s on, -9.8 before" in shown.err


@pytest.mark.parametrize("words", [["a.json"], ["--resume", "s.npz"]])
def test_allow_needs_both_files(words, capsys):
    assert cli.main([*words, "--allow", "gravity"]) == cli.BAD_INPUT
    assert "--allow goes with --resume" in capsys.readouterr().err


def test_a_branch_begins_a_new_balance_of_energy(tmp_path):
    """Another gravity would else count as energy that appears; two blocks fall freely."""
    energy = {"results": {"energy": {"every": 1}}}
    path = tmp_path / "s.npz"
    simulation = mpmgeo.Simulation(two_blocks(**EARTH, **energy)).step(20)
    assert abs(simulation.energy()["external"]) > 1
    simulation.save(path)
    branch = mpmgeo.Simulation.resume(path, two_blocks(**MOON, **energy), allow=["gravity"])
    start = branch.kinetic_energy()
    branch.step(1)
    row = branch.energy()
    assert abs(row["external"]) < 0.1 * abs(simulation.energy()["external"])
    assert row["kinetic"] == pytest.approx(start, rel=0.05)


@pytest.mark.parametrize(
    ("first", "then"),
    [({}, {"results": {"energy": {"every": 5}}}), ({"results": {"energy": {"every": 5}}}, {})],
    ids=["not kept before", "not kept any more"],
)
def test_a_balance_of_energy_is_kept_from_the_start_or_not_at_all(tmp_path, first, then):
    path = tmp_path / "s.npz"
    mpmgeo.Simulation(two_blocks(**first)).step(3).save(path)
    for allow in [], ["results.energy"]:
        with pytest.raises(ValueError, match=r"results\.energy can neither be added nor left out"):
            mpmgeo.Simulation.resume(path, two_blocks(**then), allow=allow)
