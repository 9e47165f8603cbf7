"""What only the keys of a case together can show to be impossible, or unlikely to be meant."""

import math

import numpy as np

from mpmgeo.case.aliases import NAMED, places
from mpmgeo.case.report import shown
from mpmgeo.case.spec import Case
from mpmgeo.loads import OF_THE_FLUID
from mpmgeo.materials import saturation
from mpmgeo.output.fields import FLUID_FIELDS, TERRAIN_FIELDS
from mpmgeo.positions import resolution

MOST_STEPS = 1e12
"""Steps beyond which no run comes to its end."""

SHARE = "critical_time_step_multiplier"

FROM_FILES = (("prescribed_velocity",), ("hydro_mechanical_coupling",), ("terrain_contact",))
"""Places of parts with `complaints` about their files."""

ONE_PHASE_ONLY = (
    ("stress_scheme_update", "USF", '"USF" is for one phase; accepted with two: "USL", "MUSL"'),
    ("compatibility", None, "two phases have no earlier form that is worth keeping; leave it out"),
    ("terrain_contact", None, "a terrain does not hold the pore fluid; leave one of them out"),
    ("hydro_mechanical_coupling", None, "pressures from a file and two phases exclude each other"),
)
"""Top-level keys and values (None: any) that do not go with two phases, and why."""

SLACK = 1e-9
"""Share of a cell by which a position may lie outside the mesh through round-off, at least."""


def check(tree, parts, report):
    """Report contradictions between the keys of a tree; `parts` holds what could be made of it."""
    sound = _check_bodies(tree, parts, report)
    _check_materials(tree, sound, report)
    _check_point_loads(tree, parts, report)
    _check_steps(tree, parts, report)
    _check_earthquake(parts, report)
    _check_files(parts, report)
    _check_names(tree, report)
    _check_base(parts, report)
    if tree.get("n_phases") == 2:
        _check_two_phases(tree, report)
    _note_idle(tree, report)


def _check_materials(tree, sound, report):
    defined = {}
    for path, law in places(tree, ("materials", "*")):
        number = law.get("id")
        if not _is_number(number) or (*path, "id") in report.errors:
            return
        if number in defined:
            first = report.where(defined[number])
            counts = "counts, but for single particles, which take the last one"
            report.warn((*path, "id"), f"{shown(number)} is taken by {first}, which {counts}")
        defined.setdefault(number, path)
    wanted = [
        ((*path, "material_id"), body.get("material_id"))
        for path, body in places(tree, ("body", "*"))
    ]
    wanted += [
        ((*path, *keys), number) for path, body in sound for number, keys in body.materials.items()
    ]
    wanted += [
        ((*path, "material_id"), entry.get("material_id"))
        for path, entry in places(tree, ("initial_pressure_material", "*"))
    ]
    for here, number in wanted:
        if defined and _is_number(number) and number not in defined:
            known = ", ".join(map(shown, sorted(defined)))
            report.error(here, f"{shown(number)} is no id of a material; defined: {known}")


def _is_number(value):
    return isinstance(value, int | float) and not isinstance(value, bool)


def _check_bodies(tree, parts, report):
    """Report what keeps bodies from being made; return path and object of the active others."""
    bodies = [body for _, body in places(tree, ("body", "*"))]
    if bodies and all(body.get("active") is False for body in bodies):
        report.error(("body",), "no body is active")
    mesh, sound = parts.get(("mesh",)), []
    for path, _ in places(tree, ("body", "*")):
        body = parts.get(path)
        if mesh is None or body is None or not body.active:
            continue
        complaints = list(body.complaints(np.array(mesh.cells_dimension)))
        for keys, message in complaints:
            report.error((*path, *keys), message)
        sound += [] if complaints else [(path, body)]
    return sound


def _check_point_loads(tree, parts, report):
    mesh = parts.get(("mesh",))
    container = tree.get("nodal_point_load")
    if mesh is None or not isinstance(container, list | dict):
        return
    for path, load in parts.items():
        if path[:1] == ("nodal_point_load",) and not _is_inside(load.position, mesh):
            key = 0 if isinstance(container[path[1]], list) else "position"
            box = f"{list(mesh.origin)} to {list(mesh.upper)}"
            report.error((*path, key), f"{list(load.position)} is outside the mesh, {box}")


def _is_inside(position, mesh):
    slack = np.maximum(
        SLACK * np.array(mesh.cells_dimension), resolution(mesh.zero, mesh.origin, mesh.upper)
    )
    low, high = mesh.origin - slack, mesh.upper + slack
    return bool(((low <= position) & (position <= high)).all())


def _check_steps(tree, parts, report):
    time, step = tree.get("time"), tree.get("time_step")
    key = "time" if step is None else "time_step"
    if any(name not in tree or (name,) in report.errors for name in ("time", key)):
        return
    if step is None:
        step = _automatic_step(tree, parts, report)
    if step is not None and not time <= MOST_STEPS * step:
        count = time / step if step else math.inf
        report.error((key,), f"{count:.3g} steps of {step:.3g} s are needed, more than can be made")


def _automatic_step(tree, parts, report):
    """Return about the time step that will be chosen [s]; None if it cannot be told yet."""
    mesh, share = parts.get(("mesh",)), tree.get(SHARE, getattr(Case, SHARE))
    laws = [parts.get(path) for path, _ in places(tree, ("materials", "*"))]
    if mesh is None or None in laws or (SHARE,) in report.errors:
        return None
    two = tree.get("n_phases") == 2
    if two and any(getattr(law, key) is None for law in laws for key in saturation.KEYS):
        return None
    cell = min(mesh.cells_dimension)
    if two:
        steps = [saturation.critical_time_step(law, cell, 0.0) for law in laws]
    else:
        steps = [law.critical_time_step(cell, 0.0) for law in laws]
    return share * min(steps) if steps else None


def _check_earthquake(parts, report):
    motion = parts.get(("earthquake",))
    if motion is None or not motion.active:
        return
    try:
        for warning in motion.record().warnings:
            report.warn((), warning)
    except (OSError, ValueError) as error:
        report.error(("earthquake", "file"), str(error))


def _check_files(parts, report):
    for path, part in parts.items():
        if path[:1] in FROM_FILES:
            for key, message in part.complaints():
                report.error((*path, key), message)


def _check_names(tree, report):
    """Report entries whose names are those of the same file."""
    for place in NAMED:
        taken = {}
        for path, entry in places(tree, (*place, "*")):
            name = entry.get("name")
            if isinstance(name, str) and name.casefold() in taken:
                first = report.where(taken[name.casefold()])
                report.error((*path, "name"), f"{shown(name)} is taken by {first}")
            elif isinstance(name, str):
                taken[name.casefold()] = path


def _check_base(parts, report):
    """Report planes that are to have two velocities."""
    motion, taken = parts.get(("earthquake",)), {}
    if motion is not None and motion.active and parts.get(("terrain_contact",)) is None:
        taken["Z0"] = ("earthquake",)
    for path, part in parts.items():
        plane = getattr(part, "plane", None) if path[:1] == ("prescribed_velocity",) else None
        if plane in taken:
            report.error((*path, "plane"), f"{plane} is moved by {report.where(taken[plane])}")
        elif plane:
            taken[plane] = path


def _check_two_phases(tree, report):
    """Report what two phases lack, and what does not go with them."""
    for path, law in places(tree, ("materials", "*")):
        for key in saturation.KEYS:
            if key not in law:
                report.error((*path, key), "missing; needed with two phases")
    for key, value, message in ONE_PHASE_ONLY:
        if key in tree and value in (None, tree[key]):
            report.error((key,), message)


def _note_idle(tree, report):
    """Note what only acts together with parts that the case does not have."""
    two = tree.get("n_phases") == 2
    for key in () if two else OF_THE_FLUID:
        if tree.get(key):
            report.note((key,), "has no effect with one phase")
    results = tree.get("results")
    results = results if isinstance(results, dict) else {}
    dry = [("material_point_results", () if two else FLUID_FIELDS, "exists with two phases only")]
    if not tree.get("terrain_contact"):
        dry.append(("stl_contact_mesh", TERRAIN_FIELDS, "exists with a terrain only"))
    for key, fields, why in dry:
        words = results.get(key)
        for index, word in enumerate(words if isinstance(words, list) else ()):
            if isinstance(word, str) and word in fields:
                report.note(("results", key, index), f"{shown(word)} {why}")
