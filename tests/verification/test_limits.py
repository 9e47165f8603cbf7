"""What the page on the limits of the method says is what comes out, and what helps helps."""

import pytest

import mpmgeo
from mpmgeo.run.watch import Diverged
from mpmgeo.verify import limits

GIMP = {"shape_function": "GIMP", "stress_scheme_update": "USL"}
LINEAR = {"shape_function": "linear", "stress_scheme_update": "MUSL"}


def error_in_layers(ratio, **keys):
    simulation = mpmgeo.Simulation(limits.layers(ratio, "upper", **keys)).run()
    return limits.error_in_layers(simulation)["stiff"]


def test_contrast_of_stiffness():
    """Half a particle's weight is 0.025."""
    assert error_in_layers(1, **GIMP) == pytest.approx(0.025, abs=0.01)
    assert error_in_layers(100, **GIMP) == pytest.approx(0.9, abs=0.2)
    assert error_in_layers(100, **LINEAR) == pytest.approx(0.03, abs=0.02)


def share_of_stress(count, strain, **keys):
    simulation = mpmgeo.Simulation(limits.bar(count, **keys)).run(until=strain / 0.2)
    return limits.share_of_stress(simulation)


def test_tearing():
    assert share_of_stress(1, 0.04, **GIMP) == pytest.approx(1.0, abs=0.02)
    assert share_of_stress(1, 0.08, **GIMP) < 0.2
    assert share_of_stress(2, 0.2, **GIMP) == pytest.approx(1.0, abs=0.02)
    assert share_of_stress(2, 0.2, **GIMP | {"stress_scheme_update": "MUSL"}) < 0.6


@pytest.mark.parametrize("scheme", ["USL", "MUSL"])
def test_sizes_that_follow_do_not_tear(scheme):
    """At 20 and 80 % strain, where sizes that stay carry 0.36 of it in MUSL, and nothing."""
    keys = {"stress_scheme_update": scheme, "particle_domain": "updated"}
    simulation = mpmgeo.Simulation(limits.bar(2, time=4.0, **keys))
    for strain in (0.2, 0.8):
        share = limits.share_of_stress(simulation.run(until=strain / 0.2))
        assert share == pytest.approx(1.0, abs=0.03)
    assert not [message for message in simulation.messages if "more than a cell" in message]


@pytest.mark.parametrize("count, share", [(2, 0.50), (4, 0.84)])
def test_spin(count, share):
    """After one turn."""
    case = limits.square(1.0, **GIMP)
    case["body"][0]["particles_per_direction"] = 3 * [count]
    simulation = mpmgeo.Simulation(case)
    start = limits.spin(simulation)
    simulation.run()
    assert limits.angular_momentum(simulation) / start == pytest.approx(share, abs=0.05)


@pytest.mark.parametrize("share", [0.25, 0.02])
def test_a_block_that_falls_with_usl_and_linear(share):
    keys = LINEAR | {"critical_time_step_multiplier": share}
    with pytest.raises(Diverged):
        mpmgeo.Simulation(limits.block(**keys | {"stress_scheme_update": "USL"})).run()
    if share == 0.25:
        assert mpmgeo.Simulation(limits.block(**keys)).run().time > 1.0 - 1e-9
