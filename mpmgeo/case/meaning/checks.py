"""What only the parts of a case together can show to be impossible, or unlikely to be meant."""

from dataclasses import fields

import numpy as np

from mpmgeo.boundaries.terrain import TerrainContact
from mpmgeo.case.kinds import containers
from mpmgeo.case.meaning.bodies import check_bodies, check_materials
from mpmgeo.case.meaning.deformation import check_deformation
from mpmgeo.case.meaning.domains import check_domains
from mpmgeo.case.meaning.phases import check_phases, note_idle
from mpmgeo.case.meaning.rest import check_rest
from mpmgeo.case.meaning.scaling import check_scaling
from mpmgeo.case.meaning.schemes import check_schemes
from mpmgeo.case.meaning.slips import warn_of_slips
from mpmgeo.case.meaning.start import check_start
from mpmgeo.case.meaning.steps import check_steps
from mpmgeo.case.meaning.transfers import check_transfers
from mpmgeo.case.spec import ACTIONS, Case
from mpmgeo.loads import BaseAcceleration, InTime, PrescribedVelocity
from mpmgeo.positions import resolution
from mpmgeo.values import shown

SLACK = 1e-9
"""Share of a cell by which a position may lie outside the mesh through round-off, at least."""


def check(draft, report):
    """Report contradictions between the parts of a draft."""
    sound = check_bodies(draft, report)
    check_materials(draft, sound, report)
    _check_points(draft, report)
    check_steps(draft, report)
    check_rest(draft, report)
    check_scaling(draft, report)
    check_schemes(draft, report)
    check_domains(draft, report)
    check_deformation(draft, report)
    check_transfers(draft, report)
    check_start(draft, report)
    _check_files(draft, report)
    _check_names(draft, report)
    _check_base(draft, report)
    _check_energy(draft, report)
    _check_in_time(draft, report)
    check_phases(draft, report)
    note_idle(draft, report)
    warn_of_slips(draft, sound, report)


def _actions(draft):
    """Yield all actions that could be made, as parts."""
    for action in ACTIONS:
        yield from (part for part in draft.of(action.key) if part.made is not None)


def _check_points(draft, report):
    """Report points of actions that lie outside the mesh."""
    for mesh in draft.made("mesh"):
        for part in _actions(draft):
            for key in part.made.in_mesh:
                point = part.values[key]
                if not _is_inside(point, mesh):
                    box = f"{list(mesh.origin)} to {list(mesh.upper)}"
                    report.error(part.at(key), f"{list(point)} is outside the mesh, {box}")


def _is_inside(position, mesh):
    slack = np.maximum(
        SLACK * np.array(mesh.cells_dimension), resolution(mesh.zero, mesh.origin, mesh.upper)
    )
    low, high = mesh.origin - slack, mesh.upper + slack
    return bool(((low <= position) & (position <= high)).all())


def _check_files(draft, report):
    """Report files of actions that cannot be used, and what is odd in the others."""
    for part in _actions(draft):
        complaints = list(part.made.complaints())
        for key, message in complaints:
            report.error(part.at(key), message)
        for message in () if complaints else part.made.remarks_on_file():
            report.warn((), message)


def _check_names(draft, report):
    """Report entries whose names are those of the same file."""
    for place, classes in containers(Case):
        taken = {}
        for part in draft.of(*place) if hasattr(classes[0], "called") else ():
            name = part.values.get("name", "").casefold()
            if name in taken:
                first = report.where(taken[name])
                report.error(part.at("name"), f"{shown(part.values['name'])} is taken by {first}")
            elif name:
                taken[name] = part.path


def _check_energy(draft, report):
    """Report a balance of energy of what is as in MPM-Geomechanics."""
    for results in draft.of("results"):
        if "energy" in results.given and draft.whole.values.get("compatibility") is not None:
            message = "there is no balance of energy with compatibility; leave one of them out"
            report.error(results.at("energy"), message)


def _check_in_time(draft, report):
    """Report loads in time of what is as in MPM-Geomechanics."""
    if draft.whole.values.get("compatibility") is None:
        return
    for part in (*draft.of("gravity"), *_actions(draft)):
        keys = [item.name for item in fields(InTime) if item.name in part.given]
        if keys and isinstance(part.made, InTime):
            message = "MPM-Geomechanics knows no loads in time; leave it or compatibility out"
            report.error(part.at(keys[0]), message)


def _check_base(draft, report):
    """Report planes that are to have two velocities."""
    taken = {}
    for base in draft.of(BaseAcceleration.key):
        if base.made and base.made.active and not draft.made(TerrainContact.key):
            taken["Z0"] = base.path
    for part in draft.of(PrescribedVelocity.key):
        plane = part.made and part.made.plane
        if plane in taken:
            first = report.where(taken[plane])
            report.error(part.at("plane"), f"{plane} is moved by {first}")
        elif plane:
            taken[plane] = part.path
