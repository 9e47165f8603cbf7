"""Every spelling found in old manuals, examples and programs, and the key it stands for."""

from typing import NamedTuple

from mpmgeo.case.kinds import containers, declared
from mpmgeo.case.reading.places import places
from mpmgeo.case.spec import Case


class Alias(NamedTuple):
    """An old spelling of a key at a place, as `places` has it.

    `is_unread`: MPM-Geomechanics does not know the old spelling, so with its name in
    `compatibility` the key is ignored; `is_equal`: both spellings are current, so nothing is noted;
    `wins`: the old spelling counts where both are given, as in MPM-Geomechanics; `unless`: objects
    of these types have a key of the old spelling.
    """

    place: tuple[str, ...]
    old: str
    new: str
    is_unread: bool = False
    is_equal: bool = False
    wins: bool = False
    unless: tuple[str, ...] = ()


ALIASES = (
    Alias((), "material", "materials", is_equal=True, wins=True),
    Alias((), "time_step_multiplier", "critical_time_step_multiplier", is_unread=True),
    Alias((), "nodal_point_loads", "nodal_point_load", is_unread=True),
    Alias(("results",), "fields", "material_point_results", is_unread=True),
    Alias(("results",), "material-point-results", "material_point_results", is_unread=True),
    Alias(("results",), "grid-nodal-results", "grid_nodal_results", is_unread=True),
    Alias(("nodal_point_load", "*"), "position", "point", is_equal=True),
    Alias(("damping",), "alpha", "value", unless=("mass",)),
    Alias(("damping", "*"), "alpha", "value", unless=("mass",)),
)

OBSOLETE = {
    ((), "dtFraction"): "critical_time_step_multiplier",
    ((), "nThreads"): "n_threads",
    ((), "stressSchemeUpdate;"): "stress_scheme_update",
    ((), "load_box"): "load_distributed_box",
}
"""(place, key) of obsolete keys that are ignored with a warning → the key to use."""

IGNORED = {
    ("body", "*"): {"id": "Ignored: bodies are numbered in order"},
    ("damping",): {"value": "Read with local damping only"},
}
"""Keys of complete cases that are accepted and have no effect, with their description."""

FIELD_LISTS = ("material_point_results", "grid_nodal_results", "stl_contact_mesh")
FIELD_WRAPPERS = ("fields", "material_point_results", "grid_nodal_results")
"""Keys of objects that examples put around a list of fields."""

AUTOMATIC = ("time_step", "n_threads")
"""Top-level keys for which 0 means the same as an absent key."""


def rename(tree, report):
    """Replace old spellings in a case's tree by the canonical ones, noting each."""
    as_there = tree.get("compatibility") is not None
    for alias in ALIASES:
        for path, node in places(tree, alias.place):
            if alias.old in node and node.get("type") not in alias.unless:
                is_ignored = as_there and alias.is_unread and alias.new not in node
                (_ignore_one if is_ignored else _rename_one)(alias, path, node, report)
    _flatten_field_lists(tree, report)
    _drop_automatic(tree)
    _drop_threshold(tree, report)
    _truncate_print(tree, report)
    _raise_material(tree, report)
    _take_material_id(tree, report)
    _open_words(tree)
    _name_entries(tree)


def _ignore_one(alias, path, node, report):
    del node[alias.old]
    why = f'with "compatibility", since MPM-Geomechanics reads "{alias.new}" only'
    report.note((*path, alias.old), f"ignored {why}")


def _rename_one(alias, path, node, report):
    old_path, new_path = (*path, alias.old), (*path, alias.new)
    if alias.new in node:
        used, unused = (alias.old, alias.new) if alias.wins else (alias.new, alias.old)
        report.warn((*path, unused), f'ignored, since "{used}" is given too')
        if not alias.wins:
            del node[alias.old]
            return
    elif not alias.is_equal:
        remark = ", which MPM-Geomechanics does not read under this spelling"
        report.note(old_path, f'read as "{alias.new}"{remark if alias.is_unread else ""}')
    node[alias.new] = node.pop(alias.old)
    report.written[new_path] = report.written.get(old_path, alias.old)


def _flatten_field_lists(tree, report):
    """Turn every list of fields written as one word or inside an object into a plain list."""
    for path, results in places(tree, ("results",)):
        for key in FIELD_LISTS:
            value, here = results.get(key), (*path, key)
            if isinstance(value, dict) and len(value) == 1:
                wrapper, inside = next(iter(value.items()))
                if wrapper in FIELD_WRAPPERS and isinstance(inside, list | str):
                    written = report.written.get(here, key)
                    report.note((*here, wrapper), f'read as the list "{key}" itself')
                    report.written[here] = f"{written}.{wrapper}"
                    value = inside
            if key in results:
                results[key] = [value] if isinstance(value, str) else value


def _drop_automatic(tree):
    for key in AUTOMATIC:
        value = tree.get(key)
        if value == 0 and not isinstance(value, bool):
            del tree[key]


def _drop_threshold(tree, report):
    """Search for contact in the usual radius where none, or less, is given."""
    for path, terrain in places(tree, ("terrain_contact",)):
        value = terrain.get("distance_threshold")
        if isinstance(value, int | float) and not isinstance(value, bool) and value <= 0:
            del terrain["distance_threshold"]
            report.note((*path, "distance_threshold"), f"{value} stands for the usual radius")


def _truncate_print(tree, report):
    """Round the number of outputs down as MPM-Geomechanics does, since nothing depends on it."""
    for path, results in places(tree, ("results",)):
        value = results.get("print")
        if isinstance(value, float) and not value.is_integer() and abs(value) < 2**31:
            results["print"] = int(value)
            report.note((*path, "print"), f"{value} is rounded to {int(value)}")


def _raise_material(tree, report):
    """Make one material of all listed particles a key of the body."""
    for path, body in places(tree, ("body", "*")):
        listed = body.get("particles")
        number = listed.get("material_id") if isinstance(listed, dict) else None
        if isinstance(number, int | float | str) and not isinstance(number, bool):
            body.setdefault("material_id", listed.pop("material_id"))
            report.note((*path, "particles", "material_id"), "read as the material of the body")


def _take_material_id(tree, report):
    """Use the key that MPM-Geomechanics asks for beside `material_id` only where that is absent."""
    for path, entry in places(tree, ("initial_pressure_material", "*")):
        if "material" in entry:
            number = entry.pop("material")
            if "material_id" not in entry:
                entry["material_id"] = number
                report.written[(*path, "material_id")] = "material"


def _open_words(tree):
    """Make an object of a word that stands for one, in small letters whatever its own."""
    for key, _, field in declared(Case):
        if field.metadata["word"] and isinstance(tree.get(key), str):
            tree[key] = {"type": tree[key].casefold()}


def _name_entries(tree):
    """Give the entries that write a file of their own a name: their key, or their number."""
    for place, classes in containers(Case):
        prefix = getattr(classes[0], "called", None)
        for path, entry in places(tree, (*place, "*")) if prefix else ():
            number = path[-1]
            key = f"{prefix}_{number + 1}" if isinstance(number, int) else number
            entry.setdefault("name", key)
