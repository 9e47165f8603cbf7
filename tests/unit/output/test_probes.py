"""What probes take down: the fields of the particles and points that they mean."""

import numpy as np
import pytest
from assembly import simulate, two_blocks

from mpmgeo.output.probes.box import BoxProbe
from mpmgeo.output.probes.particles import ParticleProbe
from mpmgeo.output.probes.planes import PlaneProbe
from mpmgeo.output.probes.points import PointProbe
from mpmgeo.output.probes.probe import FIELDS, particles_within

FEW = ("velocity", "stress", "density", "id")


@pytest.fixture(scope="module")
def flown():
    """Two blocks in flight, their particles in other blocks than at first."""
    case = two_blocks(gravity=[0, 1.0, -9.81], results={"material_point_results": ["strain"]})
    return simulate(case).step(60)


def row(simulation, probe):
    sampler = probe.sampler(simulation)
    simulation.solver.arrange()
    numbers = sampler.row()
    assert len(numbers) == len(sampler.columns) == len({*sampler.columns})
    return dict(zip(sampler.columns, numbers, strict=True))


def test_particles_by_id(flown):
    found = row(flown, ParticleProbe(ids=(70, 3), fields=FEW))
    assert list(found)[:4] == [f"particle70.velocity_{axis}" for axis in "xyz"] + [
        "particle70.stress_xx"
    ]
    for number in (3, 70):
        for column, axis in enumerate("xyz"):
            value = flown.field("velocity")[number, column]
            assert found[f"particle{number}.velocity_{axis}"] == value
        for column, axes in enumerate(("xx", "yy", "zz", "xy", "yz", "xz")):
            assert found[f"particle{number}.stress_{axes}"] == flown.field("stress")[number, column]
        assert found[f"particle{number}.density"] == flown.field("density")[number]
        assert found[f"particle{number}.id"] == number


def test_particles_are_found_again_after_they_were_sorted():
    simulation = simulate(two_blocks(gravity=[0, 0, -9.81]))
    sampler = ParticleProbe(ids=(1, 80), fields=("position",)).sampler(simulation)
    for _ in range(30):
        simulation.step()
        simulation.solver.arrange()
        position = simulation.field("position")
        assert sampler.row().tolist() == [*position[1], *position[80]]


def test_no_such_particle(flown):
    with pytest.raises(ValueError, match="there is no particle 96; they are numbered from 0 to 95"):
        ParticleProbe(name="tip", ids=(96,), fields=FEW).sampler(flown)


def test_nearest_follows_the_particle_that_starts_there(flown):
    start = flown.solver.population.position
    point = tuple(start[50] + 0.01)
    probe = PointProbe(points=(point,), fields=("position",), interpolation="nearest")
    found = row(flown, probe)
    assert list(found.values()) == flown.field("position")[50].tolist()


def test_linear_fields_are_exact_at_points(flown):
    """Also at the faces of a body, and whatever has become of the particles' places."""
    position = flown.field("position")
    flown.assign("velocity", position @ np.array([[1, 2, 0], [0, -1, 0.5], [3, 0, 1]]) + 7)
    body = position[:64]
    points = tuple(map(tuple, [body.mean(axis=0), body.min(axis=0), body.max(axis=0) - 0.1]))
    found = row(flown, PointProbe(points=points, fields=("velocity", "position")))
    for number, point in enumerate(points, start=1):
        wanted = np.array(point) @ np.array([[1, 2, 0], [0, -1, 0.5], [3, 0, 1]]) + 7
        values = [found[f"point{number}.velocity_{axis}"] for axis in "xyz"]
        assert values == pytest.approx(wanted)
        assert [found[f"point{number}.position_{axis}"] for axis in "xyz"] == pytest.approx(point)


def test_points_without_particles_have_no_values(flown):
    found = row(flown, PointProbe(points=((3.9, 2.9, 4.9), (-5.0, 0.0, 1e9)), fields=FEW))
    assert np.isnan(list(found.values())).all()


def test_box(flown):
    low, high = (0.0, 0.0, 0.0), (1.6, 1.4, 5.0)
    position, volume = flown.field("position"), flown.field("volume")
    inside = ((position >= low) & (position <= high)).all(axis=1)
    assert 0 < np.count_nonzero(inside) < len(inside)
    mean = row(flown, BoxProbe(point_p1=low, point_p2=high, fields=FEW))
    total = row(
        flown, BoxProbe(point_p1=low, point_p2=high, fields=("mass", "position"), reduction="sum")
    )
    assert mean["particles"] == total["particles"] == np.count_nonzero(inside)
    for column, axis in enumerate("xyz"):
        velocity = flown.field("velocity")[inside, column]
        weighted = (volume[inside] * velocity).sum() / volume[inside].sum()
        assert mean[f"velocity_{axis}"] == pytest.approx(weighted)
        assert total[f"position_{axis}"] == pytest.approx(position[inside, column].sum())
    assert total["mass"] == pytest.approx(flown.field("mass")[inside].sum())


@pytest.mark.parametrize("far", [1e12, 1e20, 1e100])
def test_a_box_without_end_holds_all_particles(flown, far):
    """Once no cell could be counted that far away, and the box held none."""
    low, high = 3 * (-far,), 3 * (far,)
    found = row(flown, BoxProbe(point_p1=low, point_p2=high, fields=("mass",), reduction="sum"))
    assert found["particles"] == 96
    assert found["mass"] == pytest.approx(flown.field("mass").sum())
    for half in (((-far, -far, -far), (far, 1.4, far)), ((-far, 1.4, -far), (far, far, far))):
        found = row(flown, BoxProbe(point_p1=half[0], point_p2=half[1], fields=("mass",)))
        assert 0 < found["particles"] < 96


def test_empty_box(flown):
    box = {"point_p1": (3.8, 2.8, 4.8), "point_p2": (4.0, 3.0, 5.0), "fields": ("mass",)}
    mean, total = row(flown, BoxProbe(**box)), row(flown, BoxProbe(**box, reduction="sum"))
    assert mean["particles"] == total["particles"] == total["mass"] == 0
    assert np.isnan(mean["mass"])


def test_particles_of_a_box_are_looked_for_in_its_blocks(flown):
    random = np.random.default_rng(1)
    for low in random.uniform(-1, 4, (30, 3)):
        high = low + random.uniform(0, 3, 3)
        for s in flown.solver.sets:
            inside = ((s.x >= low) & (s.x <= high)).all(axis=1)
            found = particles_within(flown.solver, s, low, high)
            assert sorted(found) == np.flatnonzero(inside[: s.active]).tolist()


def test_every_field_can_be_probed(flown):
    found = row(flown, ParticleProbe(ids=(0,), fields=FIELDS))
    assert np.isfinite(list(found.values())).all()


def test_planes(flown):
    assert row_or_none(simulate(two_blocks()), PlaneProbe()) is None
    flown.solver.reactions = np.arange(18.0).reshape(6, 3)
    found = row(flown, PlaneProbe(planes=("Zn", "Y0")))
    assert found == {
        **dict(zip(("Zn.force_x", "Zn.force_y", "Zn.force_z"), (15, 16, 17), strict=True)),
        **dict(zip(("Y0.force_x", "Y0.force_y", "Y0.force_z"), (3, 4, 5), strict=True)),
    }


def row_or_none(simulation, probe):
    return probe.sampler(simulation).row()
