"""Material laws: one file each, one line each in LAWS."""

from mpmgeo.materials.elastic import Elastic
from mpmgeo.materials.mohr_coulomb import MohrCoulomb
from mpmgeo.materials.neo_hookean import NeoHookean
from mpmgeo.materials.newtonian import Newtonian

LAWS = (Elastic, MohrCoulomb, NeoHookean, Newtonian)
