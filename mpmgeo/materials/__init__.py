"""Material laws: one file each, one line each in LAWS."""

from mpmgeo.materials.elastic import Elastic

LAWS = (Elastic,)
