"""Values that are well formed and hardly meant, each with the slip that it most likely is.

Limits are such that soils, rocks and liquids, and materials softened to save time steps, stay
within them. What only a built case shows is in `case/building/proportions.py`.
"""

from math import degrees, radians, tan
from typing import NamedTuple

from mpmgeo.case.kinds import declared


class Slip(NamedTuple):
    """A key of a part of a case, values between which (exclusive) it is doubtful, and why.

    `stiffness`: only in a material of at least that [Pa]; a softer one has no units in mind.
    """

    key: str
    above: float
    below: float
    why: str
    stiffness: float = 0.0


MUCH = float("inf")
ANGLE = "is little for an angle in degrees; in radians it would be {degrees:.4g}°"
LIGHT = "is little for kg/m³; is it in t/m³, or a unit weight in kN/m³?"
HEAVY = "is much for kg/m³; is it a unit weight in N/m³?"
SOFT = "is little for Pa; is it in MPa or GPa?"
HARD = "is more than any material has, diamond 1.2e12 Pa"

SLIPS = {
    "materials": (
        Slip("friction", 0, 1.6, ANGLE),
        Slip("softening.friction.residual", 0, 1.6, ANGLE),
        Slip("dilation", 0, 0.6, ANGLE),
        Slip("density", 0, 50, LIGHT, stiffness=1e5),
        Slip("density", 13_600, MUCH, HEAVY),
        Slip("density_fluid", 0, 50, LIGHT),
        Slip("density_fluid", 5_000, MUCH, HEAVY),
        Slip("young", 0, 100, SOFT),
        Slip("young", 1e13, MUCH, HARD),
        Slip("bulk", 0, 100, SOFT),
        Slip("bulk", 1e13, MUCH, HARD),
        Slip("bulk_fluid", 0, 1e4, SOFT + " water has 2.2e9 Pa"),
        Slip("hydraulic_conductivity", 1, MUCH, "is much for m/s, gravel has 0.01 to 1"),
    ),
    "terrain_contact": (
        Slip("friction", 1.5, 89.9, "is much for a coefficient; tan {value:g}° is {tan:.3g}"),
        Slip("friction", 89.9, MUCH, "is much for a coefficient of friction"),
    ),
}
"""Key of a part, or of a list of parts → what may be doubtful in it."""


def warn_of_slips(draft, sound, report):
    """Warn of values in the parts of a draft that are hardly meant, and have an effect.

    `sound`: bodies that know their materials.
    """
    used = {number for part in sound for number in part.made.materials}
    for place, slips in SLIPS.items():
        for part in draft.of(place):
            if part.made is None or (place == "materials" and part.made.id not in used):
                continue
            fields = {item.key: item.field.name for item in declared(type(part.made))}
            stiffness = getattr(part.made, "young", getattr(part.made, "bulk", 0.0))
            for slip in [slip for slip in slips if stiffness >= slip.stiffness]:
                value = getattr(part.made, fields.get(slip.key, ""), None)
                for number in value if isinstance(value, tuple) else (value,):
                    if number is not None and slip.above < number < slip.below:
                        report.warn(part.at(slip.key), f"{number:g} {_reason(slip.why, number)}")
                        break


def _reason(why, value):
    return why.format(value=value, degrees=degrees(value), tan=tan(radians(value)))
