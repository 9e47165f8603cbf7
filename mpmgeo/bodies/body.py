"""What every generated body declares, whatever its geometry."""

from dataclasses import dataclass

from mpmgeo.parameters import Counts, Vector, parameter


@dataclass(frozen=True)
class Body:
    """A body that fills its geometry with particles of one material."""

    active: bool = parameter("Whether the body takes part in the simulation", default=True)
    material_id: int = parameter("Number of the material the body consists of")
    initial_velocity: Vector = parameter(
        "Velocity of all particles at the start", unit="m/s", default=(0.0, 0.0, 0.0)
    )
    particles_per_direction: Counts = parameter(
        "Number of particles along each edge of a cell", minimum=1, default=(2, 2, 2)
    )
