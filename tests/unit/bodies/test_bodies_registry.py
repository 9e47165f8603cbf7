import dataclasses

import numpy as np
import pytest

from mpmgeo.bodies import BODIES, Cuboid, Polygon2D, Sphere

EXAMPLES = {
    Cuboid: Cuboid(material_id=1, point_p1=(0, 0, 0), point_p2=(2, 2, 2)),
    Sphere: Sphere(material_id=1, center=(1, 1, 1), diameter=2),
    Polygon2D: Polygon2D(
        material_id=1,
        points=((0, 0, 0), (2, 0, 0), (2, 0, 2), (0, 0, 2)),
        extrude_direction="y",
        extrude_displacement=2,
    ),
}


@pytest.mark.parametrize("body", BODIES)
def test_every_body_keeps_the_contract(body):
    example = EXAMPLES[body]
    assert dataclasses.is_dataclass(body)
    assert body.__doc__.strip()
    assert all(field.metadata["doc"] for field in dataclasses.fields(body))
    cell = np.array([0.5, 0.25, 0.5])
    cloud = example.generate(cell)
    assert cloud.position.shape == cloud.size.shape
    assert cloud.position.flags.c_contiguous
    assert cloud.size.flags.writeable
    assert 0 < len(cloud.position) <= example.lattice(cell).number
    assert (cloud.position >= 0).all()
    assert (cloud.position <= 2).all()


def test_types_are_unique():
    assert [body.type for body in BODIES] == ["cuboid", "sphere", "polygon_2d"]
