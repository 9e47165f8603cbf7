"""The stable time step of single particles and rows, against what can be worked out by hand."""

from math import sqrt

import numpy as np
import pytest
from models import Spline6

from mpmgeo.materials.elastic import Elastic
from mpmgeo.materials.law import Law
from mpmgeo.materials.newtonian import Newtonian
from mpmgeo.mpm.stability import has_stable_step, slopes, stable_time_step
from mpmgeo.shapes import SHAPES

GIMP, LINEAR = SHAPES["GIMP"], SHAPES["linear"]
CUBE = (1.0, 1.0, 1.0)


def of(shape, filtered, l, cell=CUBE):
    return slopes(shape, filtered, 3 * [l], cell)


def test_a_particle_as_large_as_a_cell():
    """Σ S'²/S over its three nodes is 2 + 2 + 2 where it just touches the first one."""
    assert of(GIMP, False, 0.5).divergence == pytest.approx(3 * 6, rel=0.01)


@pytest.mark.parametrize("l", [1 / 16, 1 / 50, 0.01])
def test_a_node_that_a_small_particle_just_touches(l):
    """S'²/S is 1/l, and the others move little."""
    assert of(GIMP, False, l).gradient == pytest.approx(1 / l, rel=0.05)


def test_hats_on_the_nodes():
    """One particle at each of four nodes in a row: the chain of springs, 2 + √2, on three axes."""
    found = of(LINEAR, True, 0.5)
    assert found.gradient == pytest.approx(3 * (2 + sqrt(2)), rel=0.01)
    assert found.divergence == pytest.approx(found.gradient, rel=0.01)


def test_filtered_slopes_hardly_depend_on_the_size_of_particles():
    found = [of(GIMP, True, l).gradient for l in (0.5, 0.25, 0.125, 0.01)]
    assert min(found) > 0.99 and max(found) < 1.6


def test_hats_have_no_stable_step_without_the_filter():
    assert not has_stable_step(LINEAR, False)
    assert has_stable_step(LINEAR, True) and has_stable_step(GIMP, False)


def test_slopes_go_with_the_edges_of_cells():
    cube, long = of(GIMP, False, 0.25), of(GIMP, False, 0.25, (0.1, 0.1, 0.5))
    assert long.divergence == pytest.approx(cube.divergence * (200 + 4) / 3)
    assert long.gradient == pytest.approx(cube.gradient * 100, rel=0.01)


@pytest.mark.parametrize("filtered", [False, True])
@pytest.mark.parametrize("name", ["quadratic-bspline", "cubic-bspline"])
def test_shapes_that_end_at_walls(name, filtered):
    """Also for particles of unlike edges; at a wall a layer on its own has a node of weight l."""
    found = slopes(SHAPES[name], filtered, (0.5, 0.25, 1 / 6), CUBE)
    assert 0 < found.gradient <= found.divergence < np.inf
    if not filtered:
        assert of(SHAPES[name], filtered, 0.5).divergence > 3 * 4.0


def test_means_over_cells_are_not_steeper():
    found = of(GIMP, False, 0.125)
    assert found.mean_divergence < found.divergence


def test_shapes_that_only_tests_know():
    assert 0 < of(Spline6(), True, 0.25).gradient < of(Spline6(), False, 0.25).gradient < np.inf


def test_steps_of_undamped_and_of_overdamped_motions():
    assert stable_time_step(4.0, 0.0, 4.0) == pytest.approx(1.0)
    assert stable_time_step(4.0, 0.0, 2.0) == pytest.approx(sqrt(0.5))
    assert stable_time_step(0.0, 4.0, 4.0) == pytest.approx(0.5)
    assert stable_time_step(0.0, 4.0, 2.0) == pytest.approx(0.25)


def test_stiffness_of_laws():
    found = of(GIMP, False, 0.25)
    solid = Elastic(id=1, density=1.0, young=1.0, poisson=0.0)
    assert solid.resistance(found) == pytest.approx((found.gradient, 0.0))
    soft = Elastic(id=1, density=1.0, young=2.5, poisson=0.25)  # λ = G = 1
    assert soft.resistance(found)[0] == pytest.approx(found.divergence + 2 * found.gradient)
    assert soft.resistance(found, shared=True)[0] == pytest.approx(
        found.mean_divergence + 2 * found.gradient
    )
    water = Newtonian(id=1, density=1.0, bulk=2.0, viscosity=3.0)
    assert water.resistance(found) == pytest.approx((2 * found.divergence, 6 * found.deviator))


def test_a_law_that_does_not_say_how_stiff_it_is_counts_as_a_fluid():
    class Unknown(Law):
        def sound_speed(self):
            return 3.0

    found = of(GIMP, False, 0.25)
    assert Unknown(id=1, density=2.0).resistance(found) == (18.0 * found.divergence, 0.0)
