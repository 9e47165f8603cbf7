"""A vertical cut in clay stands or fails as its stability number says."""

import numpy as np
import pytest
from scenes import cuboid, scene, simulate

# γH/c at which a vertical cut in a material without friction fails, by limit analysis: Pastor, Thai
# and Francescato (2000), Int. J. Numer. Anal. Methods Geomech. 24, 165-182.
STABILITY = 3.78
H, DENSITY, GRAVITY = 4.0, 2000.0, 10.0
WEIGHT = DENSITY * GRAVITY * H


def cut(safety):
    """Return the displacements (n, 3) after 1.5 s of a cut with `safety` times the cohesion."""
    clay = {
        "type": "mohr-coulomb",
        "id": 1,
        "density": DENSITY,
        "young": 2e7,
        "poisson": 0.4,
        "cohesion": safety * WEIGHT / STABILITY,
    }
    case = scene(
        [48, 1, 20],
        0.25,
        [cuboid([0, 0, 0], [6, 0.25, H], particles_per_direction=[2, 1, 2])],
        boundary_conditions={"plane_Z0": "fixed", "plane_Zn": "free"},
        materials=[clay],
        time=1.5,
        critical_time_step_multiplier=0.5,
        gravity=[0, 0, -GRAVITY],
        damping={"type": "local", "value": 0.1},
    )
    return simulate(case).run().field("displacement")


@pytest.mark.parametrize("safety", [1.3, 0.75])
def test_vertical_cut(safety):
    """With 1.3 times the strength it settles by centimetres, with three quarters it slides."""
    largest = np.abs(cut(safety)).max()
    assert (largest < 0.02) if safety > 1 else (largest > 0.3)
