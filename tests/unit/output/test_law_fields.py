"""Fields that material laws fill: plastic strain and undrained strength, zero for other laws."""

import numpy as np
import pytest
from assembly import two_blocks

import mpmgeo

CLAY = {
    "type": "mohr-coulomb",
    "id": 1,
    "density": 2000.0,
    "young": 1e7,
    "poisson": 0.3,
    "su_vertical_stress": 0.2,
    "tensile": 0.0,
}
SPRING = {"type": "elastic", "id": 2, "density": 2000.0, "young": 1e7, "poisson": 0.3}


@pytest.mark.parametrize("keys", [{}, {"compatibility": "mpm-geomechanics"}], ids=["new", "old"])
def test_plastic_strain_and_undrained_strength(keys):
    low = {"type": "cuboid", "point_p1": [0, 0, 0], "point_p2": [1, 1, 1], "material_id": 1}
    high = {"type": "cuboid", "point_p1": [0, 0, 1], "point_p2": [1, 1, 2], "material_id": 2}
    case = {
        "time": 1.0,
        "time_step": 1e-3,
        "gravity": [0, 0, -10.0],
        "mesh": {"cells_number": [1, 1, 3], "cells_dimension": [1, 1, 1]},
        "materials": [SPRING, CLAY],
        "body": [low, high],
    }
    simulation = mpmgeo.Simulation(mpmgeo.load_case(case | keys))
    stress = np.tile([-5e4, -5e4, -1e5, 0.0, 0.0, 0.0], (16, 1))
    stress[3] *= -1
    simulation.assign("stress", stress)
    simulation.step()
    clay = np.arange(16) < 8
    plastic = simulation.field("plastic_strain")
    assert (plastic[clay] > 0).all() and not plastic[~clay].any()
    strength = simulation.field("Su")
    expected = 0.2 * np.maximum(-simulation.field("stress")[:, 2], 0.0)
    assert strength[clay] == pytest.approx(expected[clay], rel=1e-12)
    assert strength[3] == 0.0 and not strength[~clay].any()


def test_the_variables_of_a_law_are_fields():
    """By the names in its `STATE`, zero for other particles; unknown where no law has it."""
    case = two_blocks()
    water = {"type": "newtonian", "viscosity": 1.0, "bulk": 1e6, "density": 1000.0, "tensile": 0.0}
    case["materials"][0] = water | {"id": 4}
    simulation = mpmgeo.Simulation(case)
    (wet,) = [s for s in simulation.solver.sets if s.law.STATE == ("opening",)]
    wet.state[:, 0] = np.arange(32)
    opening = simulation.field("opening")
    assert opening.shape == (96,) and not opening[:64].any()
    assert (opening[wet.row] == np.arange(32)).all()
    with pytest.raises(KeyError, match="'opening' is no field"):
        mpmgeo.Simulation(two_blocks()).field("opening")


@pytest.mark.parametrize(
    ("wrong", "right"),
    [
        ("displacment", "displacement"),
        ("Velocity", "velocity"),
        ("plasticstrain", "plastic_strain"),
        ("von_mises", "von_mises_stress"),
        ("positions", "position"),
    ],
)
def test_a_wrong_name_names_the_nearest_field(wrong, right):
    with pytest.raises(KeyError, match=f"'{wrong}' is no field; did you mean '{right}'"):
        mpmgeo.Simulation(two_blocks()).field(wrong)


@pytest.mark.parametrize("wrong", ["qqqq", 3, None, ("velocity",)])
def test_what_is_like_no_field_names_all(wrong):
    with pytest.raises(KeyError, match=r"is no field; there are id, material, .*stress.*position"):
        mpmgeo.Simulation(two_blocks()).field(wrong)
