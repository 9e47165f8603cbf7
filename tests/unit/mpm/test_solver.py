"""The solver's care for particles: those that leave, those that fail, those that come to rest."""

import numpy as np
import pytest
from assembly import RUBBER, assemble, by_row, nodes, planes
from models import Counting

from mpmgeo.boundaries.planes import BASE
from mpmgeo.mpm.effects.tools import Tools
from mpmgeo.mpm.incidents import Unsound
from mpmgeo.mpm.solver import SMALL
from mpmgeo.shapes import SHAPES

DT = 1e-3


def test_steps_and_time():
    solver = assemble([[5.0, 5.0, 5.0]], time_step=0.1)
    for _ in range(3):
        solver.step()
    assert solver.steps == 3 and solver.time == 0.1 + 0.1 + 0.1


def test_small_scenes_need_no_threads():
    assert assemble(np.zeros((SMALL, 3))).small
    assert not assemble(np.zeros((SMALL + 1, 3))).small


# Leaving the mesh


def leaving(**more):
    """Return a solver of four particles, of which rows 2 and 0 fly out of the mesh."""
    position = [[11.75, 6.0, 6.0], [6.0, 6.0, 6.0], [6.0, 6.0, 0.35], [3.0, 3.0, 3.0]]
    velocity = [[200.0, 0, 0], [0, 0, 0], [0, 0, -200.0], [0, 1.0, 0]]
    return assemble(position, velocity=velocity, mass=[1.0, 2.0, 3.0, 4.0], **more)


@pytest.mark.parametrize("scheme", ["USL", "MUSL", "USF"])
@pytest.mark.parametrize("split", [1, 2])
def test_particles_that_leave_take_no_further_part(scheme, split):
    solver = leaving(scheme=scheme, split=split)
    for _ in range(5):
        solver.step()
    assert sum(s.active for s in solver.sets) == 2
    gone = solver.departures
    assert sorted(np.concatenate([d.rows for d in gone])) == [0, 2]
    # outside after the second step, noticed when the third begins
    assert {d.time for d in gone} == {DT + DT}
    x = by_row(solver, "x")
    for d in gone:
        assert (d.position == x[d.rows[0]]).all()
        assert not ((d.position >= 0) & (d.position <= 12)).all()
    assert x[[0, 2]] == pytest.approx(np.array([[12.15, 6, 6], [6, 6, -0.05]]))
    _, mass, _, _ = nodes(solver)
    assert mass.sum() == pytest.approx(6.0)
    assert solver.kinetic_energy() == pytest.approx(0.5 * 4.0)


def passing(**more):
    """Return a solver whose first particle has passed the lowest plane, before it is sorted."""
    solver = assemble([[6.0, 6.0, 0.1], [6.0, 6.0, 6.0]], **more)
    solver.step()
    s = solver.sets[0]
    s.x[s.row == 0, 2] = -1e-3
    solver.gone = 1
    return solver


@pytest.mark.parametrize("kind", ["sliding", "fixed"])
def test_nobody_leaves_through_a_wall(kind):
    solver = passing(planes=planes(kind))
    solver.step()
    assert not solver.departures and solver.sets[0].active == 2
    assert by_row(solver, "x")[0, 2] == pytest.approx(0.0, abs=1e-6)


class Pushed:
    """A plane of lowest z that moves downwards."""

    def at(self, time):
        return [np.nan, np.nan, -1.0]


@pytest.mark.parametrize(
    "keys",
    [
        {"planes": planes("sliding", plane_Z0="free")},
        {"planes": planes("sliding"), "leaky": True},
        {"planes": planes("sliding")._replace(z0=BASE)},
        {"planes": planes("sliding"), "effects": (Tools([Pushed()], [(2, 0)]),)},
    ],
)
def test_who_passes_what_is_no_wall_leaves(keys):
    solver = passing(**keys)
    solver.step()
    assert [d.rows.tolist() for d in solver.departures] == [[0]]


def test_who_begins_outside_is_not_fetched():
    solver = assemble([[6.0, 6.0, -0.1], [6.0, 6.0, 6.0]], planes=planes("sliding"))
    solver.step()
    assert [d.rows.tolist() for d in solver.departures] == [[0]]


def test_one_departure_tells_its_lowest_row_first():
    solver = assemble(np.tile([11.9, 6.0, 6.0], (5, 1)), velocity=(200.0, 0.0, 0.0))
    solver.step()
    solver.step()
    (departure,) = solver.departures
    assert departure.rows.tolist() == [0, 1, 2, 3, 4]


def test_all_particles_leave():
    solver = assemble([[11.9, 6.0, 6.0]], velocity=(200.0, 0.0, 0.0))
    for _ in range(4):
        solver.step()
    assert len(solver.departures) == 1 and solver.kinetic_energy() == 0.0
    assert not len(nodes(solver)[0])


def test_no_particles():
    solver = assemble(np.empty((0, 3)))
    solver.step()
    solver.check()
    assert solver.kinetic_energy() == 0.0


# Failing


def test_check_finds_the_bad_particle():
    random = np.random.default_rng(2)
    solver = assemble(random.uniform(1, 11, (40, 3)))
    solver.population.material[:] = 7
    solver.step()
    solver.check()
    s = solver.sets[0]
    s.stress[17, 4] = np.nan
    with pytest.raises(Unsound) as caught:
        solver.check()
    error = caught.value
    assert (error.row, error.material, error.step, error.time) == (s.row[17], 7, 1, DT)
    assert (error.position == s.x[17]).all() and np.isnan(error.stress[4])


@pytest.mark.parametrize("h", [(1.0, 1.0, 1.0), (1.0, 0.25, 0.5)])
def test_no_particle_may_cross_a_cell_in_a_step(h):
    limit = min(h) / DT
    solver = assemble([[3.0, 1.0, 2.0]], cell=h, velocity=(0.0, 0.999 * limit, 0.0))
    assert solver.speed_limit == pytest.approx(limit)
    solver.arrange()
    solver.check()
    solver.sets[0].v[:] = [0.0, 0.0, 1.001 * limit]
    with pytest.raises(Unsound):
        solver.check()


@pytest.mark.parametrize("velocity", [(1e5, 0.0, 0.0), (np.nan, 0.0, 0.0), (0.0, 0.0, -np.inf)])
def test_failed_particles_do_not_pass_for_departed(velocity):
    """A particle that is gone because it failed is an error, not one that left the mesh."""
    solver = assemble([[11.5, 6.0, 6.0], [3.0, 3.0, 3.0]], velocity=[velocity, (0.0, 0.0, 0.0)])
    with pytest.raises(Unsound) as caught:
        for _ in range(3):
            solver.step()
    assert caught.value.row == 0
    assert not solver.departures


# Coming to rest


def test_kinetic_damping_stops_all_at_every_peak():
    """Two blocks of material swing against each other; velocities vanish when energy falls."""
    random = np.random.default_rng(0)
    position = np.stack(np.meshgrid(*[np.arange(4) / 2 + 4.25] * 3), -1).reshape(-1, 3)
    velocity = random.normal(size=(64, 3))
    fields = {"mass": 125.0, "velocity": velocity, "settles": True, "time_step": 2e-3}
    solver = assemble(position, **fields)
    last, stops = 0.0, 0
    for _ in range(200):
        solver.step()
        peak = solver.peak_energy
        stopped = not by_row(solver, "v").any()
        assert stopped == (peak < last)
        assert peak > 0 and (stopped or peak == solver.kinetic_energy())
        stops += stopped
        last = 0.0 if stopped else peak
    assert stops > 3
    assert "kinetic damping" in solver.clock.seconds


# Keeping a state


def test_kept_state_comes_back():
    """Whatever happens in between: sorting, leaving, NaN."""
    solver = leaving(half=np.full((4, 3), 0.25))
    solver.step()
    kept = solver.keep(None)
    before = {name: by_row(solver, name) for name in ("x", "v", "m", "V", "stress", "half")}
    order = solver.sets[0].row.copy()
    for _ in range(4):
        solver.step()
    solver.sets[0].x[:] = np.nan
    assert solver.keep(None)["steps"] == 5
    solver.restore(kept)
    assert solver.steps == 1 and solver.time == DT
    for name, values in before.items():
        assert (by_row(solver, name) == values).all()
    assert solver.sets[0].active == 4 and (solver.sets[0].row == order).all()


def test_a_state_is_kept_over_an_older_one():
    solver = leaving()
    kept = solver.keep(None)
    x = by_row(solver, "x")
    solver.step()
    again = solver.keep(kept)
    assert again["steps"] == 1
    solver.step()
    solver.restore(again)
    assert not (by_row(solver, "x") == x).all() and solver.steps == 1


@pytest.mark.parametrize("steps, gone", [(1, 0), (2, 2)])
def test_who_left_after_the_kept_state_is_back(steps, gone):
    """What is told of departures fits the particles; two are outside after the second step."""
    solver = leaving()
    for _ in range(steps):
        solver.step()
    kept = solver.keep(None)
    for _ in range(3):
        solver.step()
    assert sum(len(d.rows) for d in solver.departures) == 2
    solver.restore(kept)
    assert solver.sets[0].active == 4 - gone
    assert sum(len(d.rows) for d in solver.departures) == gone


# Laws with variables of their own


@pytest.mark.parametrize("scheme", ["USL", "MUSL", "USF"])
def test_a_law_of_a_user_with_two_variables(scheme):
    """It gives Hooke's stresses, and its variables tell volume strain and number of updates."""
    random = np.random.default_rng(6)
    position = random.uniform(3, 9, (200, 3))
    fields = {"velocity": 3 * random.normal(size=(200, 3)), "mass": 125.0, "scheme": scheme}
    hooke = assemble(position, shape=SHAPES["GIMP"], **fields)
    solver = assemble(position, law=Counting(*RUBBER.symbols), split=2, **fields)
    for _ in range(20):
        hooke.step()
        solver.step()
    stress = by_row(hooke, "stress")
    assert np.abs(by_row(solver, "stress") - stress).max() < 1e-10 * np.abs(stress).max()
    volume_strain, updates = by_row(solver, "state").T
    assert (updates == 20).all()
    # p = K tr ε for this law; the particles have changed places meanwhile
    λ, G2 = RUBBER.symbols
    pressure = stress[:, :3].sum(axis=1) / 3
    assert volume_strain * (λ + G2 / 3) == pytest.approx(pressure, rel=1e-9, abs=1e-9)
    assert not (solver.sets[0].row == np.arange(0, 200, 2)).all()
