"""The JSON Schema of cases, generated from the declarations."""

from dataclasses import MISSING

from mpmgeo.case.canonical import plain
from mpmgeo.case.kinds import containers, declared, listed, word_of
from mpmgeo.case.reading.aliases import ALIASES, IGNORED
from mpmgeo.case.spec import Case

DIALECT = "https://json-schema.org/draft/2020-12/schema"
INTEGERS = {"minimum": -(2**31), "maximum": 2**31 - 1}
"""Whole numbers that every later step can hold."""

CONTAINERS = tuple(place for place, _ in containers(Case))
"""Places of the lists of objects that a case may also write as an object."""

BOUNDS = {
    "above": "exclusiveMinimum",
    "minimum": "minimum",
    "below": "exclusiveMaximum",
    "maximum": "maximum",
}
SCALARS = {
    "number": {"type": "number"},
    "integer": {"type": "integer"},
    "boolean": {"type": "boolean"},
    "text": {"type": "string"},
    "file": {"type": "string", "minLength": 1},
    "free": {"type": "object"},
}


def case_schema() -> dict:
    """Return the JSON Schema (2020-12) of case files, in canonical and old spellings."""
    definitions = {}
    root = _object(Case, (), definitions)
    root["properties"] = {
        "$schema": {"type": "string", "description": "Name of this schema, for editors"},
        **root["properties"],
    }
    return {
        "$schema": DIALECT,
        "title": "mpmgeo case",
        **root,
        "$defs": dict(sorted(definitions.items())),
    }


def _object(cls, place, definitions):
    """Return the schema of a dataclass: its keys, their old spellings, ignored keys, no others."""
    properties = {} if word_of(cls) is None else {"type": {"const": word_of(cls)}}
    required = []
    for key, kind, item in declared(cls):
        properties[key] = _property(key, kind, item, place, definitions)
        if item.default is MISSING:
            required.append(key)
    for key, text in IGNORED.get(place, {}).items():
        properties.setdefault(key, {"description": text})
    spellings = _old_spellings(place, properties)
    result = {
        "type": "object",
        "description": cls.__doc__.splitlines()[0],
        "properties": properties | spellings,
        "additionalProperties": False,
    }
    return result | _required(required, place)


def _required(keys, place):
    """Return the schema that demands keys, each in its canonical or in an old spelling."""
    result, choices = {"required": []}, []
    for key in keys:
        old = [alias.old for alias in ALIASES if alias.place == place and alias.new == key]
        if old:
            choices.append({"anyOf": [{"required": [word]} for word in (key, *old)]})
        else:
            result["required"].append(key)
    return result | ({"allOf": choices} if choices else {})


def _old_spellings(place, properties):
    result = {}
    for alias in ALIASES:
        if alias.place == place and alias.new in properties and alias.old not in properties:
            text = f'Other spelling of "{alias.new}"'
            old = {"description": text} | ({} if alias.is_equal else {"deprecated": True})
            result[alias.old] = properties[alias.new] | old
    return result


def _property(key, kind, item, place, definitions):
    unit = f" [{item.metadata['unit']}]" if item.metadata["unit"] else ""
    result = {"description": item.metadata["doc"] + unit}
    result |= _value(kind, item.metadata, (*place, key), definitions)
    if item.default is MISSING and kind.is_container:
        result |= {"minItems": 1, "minProperties": 1}
    elif item.default is not MISSING and item.default is not None:
        result["default"] = plain(item.default)
    return result


def _value(kind, metadata, place, definitions):
    if kind.name == "object":
        one = _reference(kind, place, definitions)
        if metadata.get("word"):
            return _or_word(one, kind)
        return _or_list(one) if metadata.get("several") else one
    if kind.is_container:
        entry = _value(kind.item, metadata, (*place, "*"), definitions)
        return {"type": ["array", "object"], "items": entry, "additionalProperties": entry}
    if kind.name == "fixed":
        entry = _value(kind.item, metadata, place, definitions)
        size = {"minItems": kind.length, "maxItems": kind.length}
        one = {"type": "array", "items": entry} | size
        return _or_object(one, kind, place, definitions) if kind.classes else one
    if kind.name == "list":
        entry = _value(kind.item, metadata, place, definitions)
        types = ["array", "string"] if kind.item.name == "text" else "array"
        return {"type": types, "items": entry}
    if kind.name == "map":
        entry = _value(kind.item, metadata, place, definitions)
        return {"type": "object", "additionalProperties": entry}
    return _scalar(kind, metadata)


def _or_list(one):
    """Return the schema of an object, or a list of such objects, from that of an object."""
    choice = {"if": {"type": "array"}, "then": {"items": one}, "else": one}
    return {"type": ["object", "array"], **choice}


def _or_word(one, kind):
    """Return the schema of an object, or of the word of its type, from that of the object."""
    words = {"enum": [word_of(cls) for cls in kind.classes]}
    return {"type": ["object", "string"], "if": {"type": "string"}, "then": words, "else": one}


def _or_object(one, kind, place, definitions):
    """Return the schema of a list, or of an object in its place, from that of the list."""
    whole = _reference(kind, place, definitions)
    return one | {"type": ["array", "object"], "if": {"type": "object"}, "then": whole}


def _scalar(kind, metadata):
    result = dict(SCALARS[kind.name])
    if kind.is_nullable:
        result["type"] = [result["type"], "null"]
    if kind.name == "integer" and metadata["choices"] is None:
        result |= INTEGERS
    if metadata["names"] is not None:
        result["type"] = [result["type"], "string"]
    if metadata["words"]:  # of which only texts have to be one
        result["type"] = [result["type"], "string"]
        result |= {
            "pattern": f"^({'|'.join(metadata['words'])})$",
            "examples": list(metadata["words"]),
        }
    for name, value in metadata["bounds"].items():
        result[BOUNDS[name]] = value
    if metadata["choices"] is not None:
        result["enum"] = list(metadata["choices"])
    return result


def _reference(kind, place, definitions):
    """Return a reference to the schema of an object, after adding it to the definitions."""
    name = definition_of(place)
    if name not in definitions:
        definitions[name] = {}
        if word_of(kind.classes[0]) is None:
            definitions[name] = _object(kind.classes[0], place, definitions)
        else:
            definitions[name] = _choice(kind.classes, name, place, definitions)
        if keys := listed(kind.classes[0]):
            _allow_list(definitions[name], keys)
    return {"$ref": f"#/$defs/{name}"}


def definition_of(place, word=None) -> str:
    """Return the name of the definition of an object at a place whose `"type"` is a word."""
    keys = [*place[:-1], *(key for key in (*place[-1:], word) if key not in ("*", None))]
    return "_".join("entry" if key == "*" else key for key in keys)


def _choice(classes, name, place, definitions):
    """Return the schema of an object whose class the word `"type"` chooses."""
    branches = []
    for cls in classes:
        definitions[f"{name}_{word_of(cls)}"] = _object(cls, place, definitions)
        condition = {"properties": {"type": {"const": word_of(cls)}}, "required": ["type"]}
        branches.append({"if": condition, "then": {"$ref": f"#/$defs/{name}_{word_of(cls)}"}})
    words = [word_of(cls) for cls in classes]
    kind = {"type": "string", "enum": words}
    return {
        "type": "object",
        "properties": {"type": kind},
        "required": ["type"],
        "allOf": branches,
    }


def _allow_list(schema, keys):
    """Let an object also be written as the list of the values of some keys."""
    entries = [schema["properties"][key] for key in keys]
    schema["type"] = ["array", "object"]
    schema |= {"prefixItems": entries, "minItems": len(entries), "maxItems": len(entries)}
