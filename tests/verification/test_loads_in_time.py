"""Loads that change in time: impulses of second order in the step, and exact ones."""

from math import log2, pi, sin

import numpy as np
import pytest
from scenes import cuboid, scene, simulate

from mpmgeo.verify import limits
from mpmgeo.verify.bar import Bar

SCHEMES = pytest.mark.parametrize("scheme", ["USL", "MUSL", "USF"])
DURATION = 0.1
RAMP = {"ramp": {"type": "sine", "duration": DURATION}}
ONE = {"time": [0.3], "factor": [1.0]}
WATER = {"density_fluid": 1000, "porosity": 0.4, "bulk_fluid": 1e6}
WATER |= {"hydraulic_conductivity": [1e-3, 1e-3, 1e-3]}
MASS = 1000.0


def cube(dt=1e-3, **keys):
    """Return the case of a free cube of 1000 kg, which fills its box, in the middle of the mesh."""
    body = cuboid((1.5, 1.5, 3), (2.5, 2.5, 4))
    return scene([8, 8, 12], 0.5, [body], time=1.0, time_step=dt, **keys)


def box(load, low=(1, 1, 2), high=(3, 3, 5), **keys):
    return {"point_p1": list(low), "point_p2": list(high), "load": load} | keys


def nodes(force, **keys):
    """Return the same force on each of the 27 nodes of the cube."""
    at = [[x, y, z] for x in (1.5, 2, 2.5) for y in (1.5, 2, 2.5) for z in (3, 3.5, 4)]
    return [{"point": point, "force": force} | keys for point in at]


KINDS = {
    "gravity": lambda **f: {"gravity": {"value": [0, 3, -10]} | f},
    "box": lambda **f: {"load_distributed_box": [box([0, 3 * MASS, -10 * MASS], **f)]},
    "nodes": lambda **f: {"nodal_point_load": nodes([0, 3 * MASS / 27, -10 * MASS / 27], **f)},
}


def acceleration(simulation):
    """Return the momentum of a cube by its mass; its own velocity were its loads gravity."""
    return simulation.field("mass") @ simulation.field("velocity") / MASS


def ramped(t):
    """Return the integral of the sine ramp up to a time in it."""
    return 0.5 * (t - DURATION / pi * sin(pi * t / DURATION))


@SCHEMES
@pytest.mark.parametrize("kind", KINDS)
def test_the_impulse_of_a_ramp_is_of_second_order(kind, scheme):
    """The error of the rule of midpoints is Δt²/24 times the change of the rate, half 10 π/T."""
    errors = []
    for dt in (4e-3, 2e-3):
        case = cube(dt, **KINDS[kind](**RAMP), stress_scheme_update=scheme)
        simulation = simulate(case).step(round(0.06 / dt))
        exact = -10 * ramped(simulation.time - dt / 2)
        errors.append(acceleration(simulation)[2] - exact)
        assert acceleration(simulation)[1] == pytest.approx(-0.3 * acceleration(simulation)[2])
        assert abs(errors[-1]) < dt**2 / 24 * 5 * pi / DURATION
    assert abs(log2(errors[0] / errors[1]) - 2) < 0.1


@SCHEMES
@pytest.mark.parametrize("kind", KINDS)
def test_the_impulse_of_a_table_is_exact(kind, scheme):
    """Where its instants lie between those of the steps, the rule of midpoints is."""
    dt = 1e-3
    table = {"time": [5.5 * dt, 10.5 * dt, 30.5 * dt], "factor": [0, 2, -1]}
    simulation = simulate(cube(dt, **KINDS[kind](**table), stress_scheme_update=scheme)).step(40)
    impulse = (5 * 1 + 20 * 0.5 - 9 * 1) * dt  # at 39.5 Δt
    assert acceleration(simulation) == pytest.approx([0, 3 * impulse, -10 * impulse], abs=1e-12)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("phases", [1, 2])
def test_a_factor_of_one_changes_no_bit(kind, phases):
    """Beside constant loads that overlap with it, before and after it."""

    def state(**factor):
        case = cube(n_phases=phases, damping={"type": "local", "value": 0.2})
        case["materials"] = [case["materials"][0] | WATER]
        case |= KINDS[kind](**factor)
        others = [box([70 / 3, 1 / 3, 0]), box([0.1, 0.7, 1e3 / 7], high=(2, 2, 4))]
        boxes = case.get("load_distributed_box", [])
        case["load_distributed_box"] = [others[0], *boxes, others[1]]
        force = {"point_p1": [1, 1, 2], "point_p2": [3, 3, 3.5], "pressure_force": [0, 1 / 3, 9]}
        case["pressure_force_box"] = [force | factor] * (phases == 2)
        simulation = simulate(case).step(12)
        names = ("position", "velocity", "stress", "external_force")
        return [simulation.field(name) for name in names]

    for plain, scaled in zip(state(), state(**ONE), strict=True):
        assert plain.any()
        assert plain.tobytes() == scaled.tobytes()


def test_both_phases_fall():
    """Both have the velocity of a body under the same gravity."""
    case = cube(2e-3, n_phases=2, **KINDS["gravity"](**RAMP))
    case["materials"] = [case["materials"][0] | WATER]
    dry = simulate(cube(2e-3, **KINDS["gravity"](**RAMP))).step(30)
    wet = simulate(case).step(30)
    (s,) = wet.solver.sets
    for v in (s.v, s.vf):
        assert v == pytest.approx(np.broadcast_to(acceleration(dry), v.shape), rel=1e-9, abs=1e-12)


def test_a_force_on_the_fluid_grows():
    pull = {"point_p1": [1, 1, 2], "point_p2": [3, 3, 3.5], "pressure_force": [0, 0, 8]}
    case = cube(2e-3, n_phases=2, pressure_force_box=[pull | RAMP])
    case["materials"] = [case["materials"][0] | WATER]
    simulation = simulate(case)
    assert not simulation.solver.sets[0].pull.any()
    simulation.step(25)  # to the middle of the ramp
    found = np.unique(simulation.solver.sets[0].pull[:, 2])
    assert found == pytest.approx([-4, 0])


def test_the_field_of_forces_is_that_of_its_time():
    keys = {"gravity": {"value": [0, 0, -10]} | RAMP, "load_distributed_box": [box([64, 0, 0])]}
    simulation = simulate(cube(2e-3, **keys)).step(25)
    mass, force = simulation.field("mass"), simulation.field("external_force")
    assert force[:, 2] == pytest.approx(-5 * mass)
    assert force[:, 0] == pytest.approx(64 / len(mass))


def test_a_bar_that_is_pulled_for_a_period_of_its_vibration_comes_to_rest():
    """A force that grows evenly over the longest period leaves no mode in motion.

    All periods of a bar with a fixed end divide the longest one; what is left is u = P x/(E A),
    and a velocity that is small beside the one of a force that comes at once, P c/(E A).
    """
    bar = Bar()
    case = bar.case(25, "MUSL", 1.5 * bar.period, courant=0.4)
    h, strain = bar.length / 25, 1e-5
    corner = bar.young * h**2 * strain / 4
    ends = [[bar.length, y, z] for y in (0, h) for z in (0, h)]
    growth = {"time": [0, bar.period], "factor": [0, 1]}
    case["nodal_point_load"] = [{"point": p, "force": [corner, 0, 0]} | growth for p in ends]
    simulation = simulate(case)
    x = simulation.field("position")[:, 0]
    simulation.step(round(1.3 * bar.period / simulation.time_step))
    displacement = simulation.field("displacement")[:, 0]
    assert np.abs(displacement - strain * x).max() < 0.01 * strain * bar.length
    speed = np.abs(simulation.field("velocity")[:, 0]).max()
    assert speed < 0.02 * strain * bar.wave_speed


BALANCED = {"results": {"energy": {"every": 1}}}


@SCHEMES
def test_the_work_of_what_grows_is_that_of_the_fall(scheme):
    """To round-off in every step: kinetic energy less that at the start is external work."""
    keys = {"gravity": {"value": [0, 0, -10]} | RAMP}
    table = {"time": [0.01, 0.03, 0.05], "factor": [0, 1, -1]}
    loads = [box([MASS, 0, 2 * MASS], **table), box([0, 20 * MASS, 0])]
    case = cube(2e-3, **keys, **BALANCED, load_distributed_box=loads, stress_scheme_update=scheme)
    case["body"][0]["initial_velocity"] = [0.5, 0, 1.0]
    simulation = simulate(case)
    start = simulation.kinetic_energy()
    for _ in range(60):
        simulation.step()
        row = simulation.energy()
        assert row["kinetic"] - start == pytest.approx(row["external"], abs=1e-11 * start)
        assert abs(row["balance"]) < 1e-11 * start
    assert abs(row["external"]) > start


@pytest.mark.parametrize("keys", [{}, BALANCED], ids=["", "with a balance"])
def test_the_guard_says_nothing_of_what_grows(keys):
    """A cube on the ground whose weight comes and goes, and that is pulled up and let fall."""
    weight = {"value": [0, 0, -10], "time": [0, 0.05, 0.1, 0.3], "factor": [0, 3, 0, 1]}
    pull = box([0, 0, 20 * MASS], (1, 1, 0), (3, 3, 2), time=[0.3, 0.31, 0.35], factor=[0, 1, 0])
    case = scene(
        *([8, 8, 8], 0.5, [cuboid((1.5, 1.5, 0), (2.5, 2.5, 1))]),
        time=0.6,
        gravity=weight,
        load_distributed_box=[pull],
        **keys,
    )
    simulation = simulate(case).run(watchers=[limits.Heard(stops=True)])
    assert not simulation.messages


@pytest.mark.parametrize("kind", ["gravity", "box", "nodes"])
def test_the_balance_of_a_column_that_is_pushed_and_pulled(kind):
    """To a thousandth of the largest work; a force that comes at once leaves up to 0.4 %."""
    table = {"time": [0, 0.05, 0.1, 0.12], "factor": [0, 1, -1, 0.5]}
    tip = [{"point": [x, y, 1], "force": [0, 0, -2.5]} | table for x in (0, 0.1) for y in (0, 0.1)]
    keys = {
        "gravity": {"gravity": {"value": [0, 0, -1]} | table},
        "box": {"load_distributed_box": [box([0, 0, -10], (0, 0, 0.9), (0.1, 0.1, 1), **table)]},
        "nodes": {"nodal_point_load": tip},
    }[kind]
    body = cuboid((0, 0, 0), (0.1, 0.1, 1))
    case = scene([1, 1, 12], 0.1, [body], time=1.0, time_step=2.5e-4, **keys, **BALANCED)
    simulation = simulate(case | {"stress_scheme_update": "MUSL"})
    rows = []
    for _ in range(800):
        simulation.step()
        rows.append(simulation.energy())
    largest = max(abs(row["external"]) for row in rows)
    assert largest > 0
    assert max(abs(row["balance"]) for row in rows) < 1e-3 * largest
