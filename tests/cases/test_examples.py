"""Every example runs on import and gives the number that its subject is about."""

import runpy
from pathlib import Path

import numpy as np
import pytest

FOLDER = Path(__file__).parents[2] / "examples"


def boussinesq(example):
    """At the surface the half-space settles as the cube does, to 5 %: grid +7 %, walls −4 %.

    At the floor, which does not give way, there is next to no settlement, where a half-space has
    5P/(8πGz) = 2.5 nm.
    """
    depth = example["depth"]
    shallow, deep = depth.argmin(), depth.argmax()
    ratio = example["settlement"] / example["half_space"]
    assert ratio[shallow] == pytest.approx(1.0, abs=0.05)
    assert example["half_space"][deep] == pytest.approx(2.5e-9, rel=0.05)
    assert ratio[deep] < 0.06


def vibrating_bar_convergence(example):
    """Second order where the leapfrog holds, first order where the first stress comes too early."""
    orders = {scheme: study.order for scheme, study in example["studies"].items()}
    expected = {"USL": 2.0, "MUSL": 2.0, "USF": 1.0, "NPC-CD": 2.0}
    assert orders == pytest.approx(expected, abs=0.2)
    assert example["studies"]["USL"].error[-1] < 1e-3


def block_on_moving_base(example):
    """The foot follows the base to 4 % of 0.3 m/s; the top swings by itself, but less than 20 %."""
    off_foot = np.abs(example["foot_velocity"] - example["base_velocity"]).max()
    off_top = np.abs(example["top_velocity"] - example["base_velocity"]).max()
    assert off_foot < 0.04 * 0.3
    assert off_foot < off_top < 0.2 * 0.3


def colliding_spheres(example):
    """Momentum to round-off; energy is lent to the stresses and comes back, 8 % at most is lost."""
    kinetic, elastic = example["kinetic"], example["elastic"]
    total = (kinetic + elastic) / kinetic[0]
    assert example["momentum_change"] < 1e-12 * example["momentum_scale"]
    assert kinetic.min() < 0.05 * kinetic[0]
    assert elastic.max() > 0.85 * kinetic[0]
    assert kinetic[-1] > 0.9 * kinetic[0]
    assert 0.92 - 0.01 < total.min() < total.max() < 1.02


def slope_under_its_weight(example):
    """ΣVσzz = −Σmgz to 0.3 %: the floor also pushes at nodes a cell below it, at z = −0.25 m."""
    assert example["carried"] == pytest.approx(example["weight_moment"], rel=0.003)
    assert example["simulation"].kinetic_energy() < 1e-20
    settlement = example["crest_settlement"]
    assert example["crest_settlement_braked"] == pytest.approx(settlement, rel=0.01)


def three_ways_to_rest(example):
    """ΣVσzz = −Σmgz to 0.5 % in all ways; inertia does not change the settlement."""
    rests, settlements = example["rests"], example["settlements"]
    assert all(simulation.stopped.startswith("at rest") for simulation in rests.values())
    assert list(example["balances"].values()) == pytest.approx([1.0] * 3, rel=0.006)
    assert settlements["scaled inertia"] == pytest.approx(settlements["real inertia"], rel=1e-3)
    real, scaled = rests["real inertia"], rests["scaled inertia"]
    assert scaled.time_step == pytest.approx(10 * real.time_step)


def dam_break(example):
    """The front is ahead by the time that the gate takes; water that sticks is slower.

    The first point of the experiment, which fits no delay, does not count.
    """
    report = {floor: example["compare"](curves) for floor, curves in example["found"].items()}
    fixed, sliding = report["fixed"], report["sliding"]
    assert 0.05 < fixed["ahead"].mean() < 0.10
    assert fixed["ahead"].mean() < sliding["ahead"].mean() < 0.12
    for found in (fixed, sliding):
        assert found["ahead"].max() < 0.16
        assert found["late"][1:].std() < 0.035
        assert np.abs(found["off"]).max() < 0.03


CHECKS = {
    "01_boussinesq": boussinesq,
    "02_vibrating_bar_convergence": vibrating_bar_convergence,
    "03_block_on_moving_base": block_on_moving_base,
    "04_colliding_spheres": colliding_spheres,
    "05_slope_under_its_weight": slope_under_its_weight,
    "06_dam_break": dam_break,
    "07_three_ways_to_rest": three_ways_to_rest,
}


@pytest.mark.parametrize("name", CHECKS)
def test_example_shows_what_it_says(name):
    CHECKS[name](runpy.run_path(str(FOLDER / f"{name}.py")))


def test_every_example_is_checked():
    assert sorted(path.stem for path in FOLDER.glob("*.py")) == sorted(CHECKS)
