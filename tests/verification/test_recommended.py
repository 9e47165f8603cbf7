"""The recommended method: errors that fall with the cells, and no energy out of nothing."""

import numpy as np
import pytest

from mpmgeo.verify import loaded_bar
from mpmgeo.verify.flight import Flight, case
from mpmgeo.verify.problems import PROBLEMS

RECOMMENDED = {"method": "recommended"}
# of `mpmgeo.verify.problem`, whose cases name a shape and a scheme
CHOICES = {"shape": "cubic-bspline", "scheme": "USL", "transfer": "tpic"}


@pytest.mark.parametrize("strain", [0.02, 0.1])
def test_errors_fall_where_particles_cross_cells(strain):
    errors = [loaded_bar.error(cells, strain, **RECOMMENDED) for cells in (16, 32, 64)]
    assert errors[1] < 0.6 * errors[0] < 0.02
    assert errors[2] < 0.7 * errors[1]


@pytest.mark.parametrize("speed", [0.001, 0.3])
@pytest.mark.parametrize("share", [0.25, 0.5])
@pytest.mark.parametrize("per_direction", [1, 2])
def test_a_body_in_flight_gains_nothing(speed, share, per_direction):
    keys = {"stress_scheme_update": "USL", "shape_function": "cubic-bspline", "transfer": "tpic"}
    energy = Flight(case(speed, per_direction, share, 300, **keys)).energies(300)
    assert energy.max() <= 1.02


@pytest.mark.parametrize(
    "name, cells, order", [("axis_aligned", (4, 8), 1.6), ("ring", (4, 8), 1.5)]
)
def test_order_in_manufactured_solutions(name, cells, order):
    errors = PROBLEMS[name]().refined(cells, **CHOICES)
    assert errors.order > order
    assert errors.error[-1] < {"axis_aligned": 8e-3, "ring": 3e-4}[name]


@pytest.mark.slow
def test_second_order_in_the_cube():
    errors = PROBLEMS["axis_aligned"]().refined((4, 8, 16), **CHOICES)
    assert errors.order > 1.85
    assert np.all(np.diff(errors.error) < 0)
