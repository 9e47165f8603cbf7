"""The manual's reference tables and the committed schema, generated from the declarations.

`python -m mpmgeo.case.tables` in a checkout of the repository brings both up to date.
"""

import json
from collections.abc import Iterator
from dataclasses import MISSING
from pathlib import Path

from mpmgeo.case.canonical import plain
from mpmgeo.case.kinds import declared, word_of
from mpmgeo.case.reading.aliases import ALIASES, IGNORED, OBSOLETE
from mpmgeo.case.reading.explain import accepted
from mpmgeo.case.reading.schema import case_schema, definition_of
from mpmgeo.case.spec import Case
from mpmgeo.output.fields import (
    FLUID_FIELDS,
    FURTHER_FIELDS,
    GRID_FIELDS,
    PARTICLE_FIELDS,
    TERRAIN_FIELDS,
)

MARK = "<!-- From here on generated: python -m mpmgeo.case.tables -->\n"


UNREAD = "; ignored with `compatibility`, as there"


def update(root: Path) -> None:
    """Write the schema and the tables into the repository at `root`."""
    (root / "schemas" / "case.schema.json").write_text(schema_text(), encoding="utf-8")
    page = root / "manual" / "input.md"
    written = page.read_text(encoding="utf-8").partition(MARK)[0]
    page.write_text(written + MARK + tables(), encoding="utf-8")


def schema_text() -> str:
    """Return the text of schemas/case.schema.json."""
    return json.dumps(case_schema(), indent=2, ensure_ascii=False) + "\n"


def tables() -> str:
    """Return the reference tables of all keys, in Markdown."""
    parts = [_section(*part) for part in _objects(Case, ())]
    parts += [
        _fields("Fields of `results.material_point_results`", PARTICLE_FIELDS),
        _fields("Further fields, by name only", FURTHER_FIELDS | FLUID_FIELDS),
        _fields("Fields of `results.grid_nodal_results`", GRID_FIELDS),
        _fields("Fields of `results.stl_contact_mesh`", TERRAIN_FIELDS),
        _spellings(),
        _without_effect(),
    ]
    return "\n" + "\n".join(parts)


def _objects(cls, place) -> Iterator[tuple[type, tuple]]:
    """Yield every dataclass a case consists of with its place, outer ones first."""
    yield cls, place
    for key, kind, _ in declared(cls):
        inner = kind.item if kind.is_container else kind
        for part in inner.classes:
            yield from _objects(part, (*place, key, *(["*"] if kind.is_container else [])))


def _section(cls, place):
    word = word_of(cls)
    title = f"`{_dotted(place)}`" if place else "The top level"
    title += f" of type `{word}`" if word else ""
    text = f"## {title}\n\n{cls.__doc__.splitlines()[0]}\n"
    rows = [_row(item, _schema_of(cls, place)) for item in declared(cls)]
    return text + (_table(("key", "value", "unit", "default", "meaning"), rows) if rows else "")


def _schema_of(cls, place):
    schema = case_schema()
    name = definition_of(place, word_of(cls))
    return schema["$defs"][name] if name else schema


def _row(item, schema):
    metadata, default = item.field.metadata, item.field.default
    value = accepted(schema["properties"][item.key])
    return f"`{item.key}`", value, metadata["unit"], _default(default), metadata["doc"]


def _default(value):
    if value is MISSING:
        return "required"
    text = json.dumps(plain(value)) if value is not None else ""
    return f"`{text}`" if 0 < len(text) < 40 else ""


def _fields(title, fields):
    rows = [(f"`{key}`", text) for key, text in fields.items()]
    return f"## {title}\n" + _table(("field", "content"), rows)


def _spellings():
    rows = [
        (
            f"`{_dotted((*alias.place, alias.old))}`",
            f"`{_dotted((*alias.place, alias.new))}`{UNREAD if alias.is_unread else ''}",
        )
        for alias in ALIASES
    ]
    rows += [
        (f"`{_dotted((*place, key))}`", f"ignored; use `{new}`")
        for (place, key), new in OBSOLETE.items()
    ]
    return "## Other spellings\n" + _table(("spelling", "read as"), rows)


def _without_effect():
    rows = [
        (f"`{_dotted((*place, key))}`", text)
        for place, keys in IGNORED.items()
        for key, text in keys.items()
    ]
    return "## Keys without effect\n" + _table(("key", "why"), rows)


def _table(head, rows):
    lines = [head, ["---"] * len(head), *rows]
    return "\n" + "".join(f"| {' | '.join(map(str, line))} |\n" for line in lines)


def _dotted(place):
    return ".".join(place)


if __name__ == "__main__":
    update(Path.cwd())
