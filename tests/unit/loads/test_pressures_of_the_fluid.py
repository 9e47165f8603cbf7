"""Pressures of the pore fluid and forces on it, as particles see them."""

import numpy as np

from mpmgeo.loads import (
    InitialPressureBox,
    InitialPressureMaterial,
    PrescribedPressureBox,
    PressureForceBox,
)

BOX = {"point_p1": (0.0, 0.0, 0.0), "point_p2": (1.0, 1.0, 1.0)}
POSITION = np.array([[0.5, 0.5, 0.5], [1.0, 1.0, 1.0], [1.1, 0.5, 0.5]])
MATERIAL = np.array([1, 2, 1])


def test_boxes_wet_what_starts_in_them():
    for cls in (InitialPressureBox, PrescribedPressureBox):
        load = cls(**BOX, pressure=5.0)
        assert load.wets(POSITION, MATERIAL).tolist() == [True, True, False]
        assert load.is_kept == (cls is PrescribedPressureBox)


def test_materials_are_wet_wherever_they_are():
    load = InitialPressureMaterial(material_id=1, pressure=5.0)
    assert load.wets(POSITION, MATERIAL).tolist() == [True, False, True]
    assert not load.is_kept


def test_the_force_is_that_of_each_particle_and_subtracted():
    force = PressureForceBox(**BOX, pressure_force=(1.0, 0.0, -2.0)).fluid_force(POSITION)
    assert (force == [[-1, 0, 2], [-1, 0, 2], [0, 0, 0]]).all()
