"""What a diverged run says: step, particle, place, material, stress, likely cause."""

from types import SimpleNamespace

import numpy as np
import pytest

from mpmgeo.mpm.incidents import Unsound
from mpmgeo.run.diagnosis import diagnose

STRESS = [1e6, -2e6, 3e6, 4.0, 5.0, 6.0]


def message(time_step=1e-3, stable=2e-3, lightest=1.0, last=STRESS):
    """Return the message about particle 42 of material 7, which broke in step 120."""
    simulation = SimpleNamespace(
        time_step=time_step,
        stable_time_step=stable,
        case=SimpleNamespace(stress_scheme_update="USL", shape_function="GIMP"),
        nodes=lambda: SimpleNamespace(mass=np.array([3.0, lightest])),
        field=lambda key: {"mass": np.array([1.0, 2.0])}[key],
    )
    x, v = np.array([1.25, np.nan, 3.0]), np.array([3e5, 4e5, 0.0])
    error = Unsound(7, 42, 120, 0.12, x, v, np.full(6, np.nan))
    return diagnose(simulation, error, last)


def test_names_step_particle_place_material_speed_and_stress():
    text = message()
    for part in (
        "step 120",
        "0.12 s",
        "particle 42",
        "material 7",
        "(1.25, nan, 3) m",
        "5e+05 m/s",
        "(1e+06, -2e+06, 3e+06, 4, 5, 6) Pa",
        "last sound state",
    ):
        assert part in text


def test_stress_of_the_moment_if_no_other_is_known():
    assert "(nan, nan, nan, nan, nan, nan) Pa" in message(last=None)


def test_blames_an_unstable_time_step():
    text = message(time_step=5e-3)
    assert "0.005 s exceeds 0.002 s, up to which USL with GIMP is stable" in text
    assert "0.001 s or less" in text


def test_blames_what_is_stable_with_no_step():
    assert "USL with GIMP is stable with no time step, try MUSL" in message(stable=0.0)


def test_blames_light_nodes():
    text = message(lightest=1e-9)
    assert "1e-09 of a particle's" in text and "exceeds" not in text


@pytest.mark.parametrize("lightest", [1.0, 1e-3])
def test_blames_loads_otherwise(lightest):
    text = message(lightest=lightest)
    assert "0.001 s is below 0.002 s, up to which USL with GIMP is stable" in text
    assert "very large loads or speeds" in text and "little mass" not in text
