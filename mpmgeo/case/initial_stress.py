"""What a case may say of the stresses at the start: those of overburden."""

from dataclasses import dataclass

from mpmgeo.parameters import HEIGHT, parameter


@dataclass(frozen=True)
class InitialStress:
    """Stresses at the start that carry what lies above, layer by layer."""

    k0: float | None = parameter(
        "Horizontal over vertical effective stress of materials that do not say their own k0; "
        "absent: what their law has by itself",
        above=0,
        default=None,
    )
    water_table: float | None = parameter(
        "Height of the water table, on the axis of gravity; absent: none",
        unit="m",
        place=HEIGHT,
        default=None,
    )
    density_water: float = parameter(
        "Density of the water under the table; with two phases that of the fluid counts",
        unit="kg/m³",
        above=0,
        default=1000.0,
    )
