"""Transfers of velocity between particles and nodes: one file each, one line each in TRANSFERS."""

from mpmgeo.transfers.apic import Apic
from mpmgeo.transfers.flip import Flip
from mpmgeo.transfers.tpic import Tpic

TRANSFERS = (Flip, Apic, Tpic)

__all__ = ["TRANSFERS", "Apic", "Flip", "Tpic"]
