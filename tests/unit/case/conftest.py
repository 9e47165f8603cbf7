import pytest


@pytest.fixture
def case():
    """A small valid case in canonical spelling, new for every test."""
    return {
        "time": 0.1,
        "time_step": 1e-3,
        "mesh": {"cells_number": [4, 4, 4], "cells_dimension": [0.5, 0.5, 0.5]},
        "materials": {
            "soil": {"type": "elastic", "id": 1, "density": 2000, "young": 1e6, "poisson": 0.3}
        },
        "body": {
            "block": {
                "type": "cuboid",
                "point_p1": [0, 0, 0],
                "point_p2": [1, 1, 1],
                "material_id": 1,
            }
        },
    }
