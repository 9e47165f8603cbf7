"""What a case may say of the method: scheme, shape functions, and what belongs to them."""

from dataclasses import dataclass
from functools import reduce
from operator import or_

from mpmgeo.mpm.schemes import SCHEMES, NewmarkNumbers
from mpmgeo.parameters import parameter
from mpmgeo.shapes import SHAPES
from mpmgeo.shapes.lme import LocalMaxEnt
from mpmgeo.transfers import TRANSFERS, Flip

Transfer = reduce(or_, TRANSFERS)


@dataclass(frozen=True)
class Method:
    """How the equations of motion are solved."""

    method: str | None = parameter(
        "Choice of all of it that a case does not make itself; absent: the defaults",
        choices=("recommended",),
        default=None,
    )
    stress_scheme_update: str = parameter(
        "When stresses are updated: last, last with modified velocities, first, or between a "
        "predictor and a corrector",
        choices=tuple(SCHEMES),
        default="USL",
    )
    shape_function: str = parameter(
        "Interpolation between particles and grid", choices=tuple(SHAPES), default="GIMP"
    )
    transfer: Transfer = parameter(
        "How the particles take on the velocity of the nodes", default=Flip(), word=True
    )
    npc: NewmarkNumbers = parameter(
        "The numbers of the schemes NPC and NPC-CD", default=NewmarkNumbers()
    )
    lme: LocalMaxEnt = parameter("The numbers of the shape LME", default=LocalMaxEnt())
    particle_domain: str = parameter(
        "Size of particles in interpolation: as at the start, or following their deformation",
        choices=("initial", "updated"),
        default="initial",
    )
    plane_strain: str = parameter(
        "Whether one layer of particles is solved for all where nothing changes across",
        choices=("auto", "off"),
        default="auto",
    )
    volumetric_locking: str = parameter(
        "Cure of it, by the mean volume strain of cells", choices=("off", "cells"), default="off"
    )
