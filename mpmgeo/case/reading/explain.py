"""What the JSON Schema finds wrong in a case, in words that help to put it right."""

from functools import cache

from mpmgeo.case.reading.aliases import FIELD_LISTS, OBSOLETE
from mpmgeo.case.reading.schema import CONTAINERS, INTEGERS, case_schema
from mpmgeo.case.reading.words import meant
from mpmgeo.values import shown

FIELD_ENTRIES = tuple((key, "*") for key in FIELD_LISTS)

LIMITS = {
    "exclusiveMinimum": "above",
    "minimum": "at least",
    "exclusiveMaximum": "below",
    "maximum": "at most",
}
MOST_HINTS = 100
"""Unknown keys of one object that are compared with the known ones, which takes its time."""

NOUNS = {
    "number": ("a number", "numbers"),
    "integer": ("a whole number", "whole numbers"),
    "boolean": ("true or false", "truth values"),
    "string": ("text in double quotes", "texts in double quotes"),
    "array": ("a list", "lists"),
    "object": ("an object { … }", "objects { … }"),
}


def validate(tree, report):
    """Report everything in a tree of canonical keys that the schema does not allow."""
    validator = _validator()
    schema = validator.schema
    for error in validator.iter_errors(tree):
        path = tuple(error.absolute_path)
        if error.validator == "additionalProperties":
            _unknown(error, path, schema, report)
        elif error.validator in ("required", "anyOf"):
            _missing(error, path, schema, report)
        else:
            _wrong(error, path, schema, report)


@cache
def _validator():
    """Return what looks at trees; made once, which takes as long as looking at one."""
    from jsonschema import Draft202012Validator

    return Draft202012Validator(case_schema())


def place_of(path) -> tuple[str, ...]:
    """Return the place of a path: `*` stands for the name or position of an entry."""
    place = ["*" if isinstance(key, int) else key for key in path]
    for container in CONTAINERS:
        depth = len(container)
        if len(place) > depth and tuple(place[:depth]) == container:
            place[depth] = "*"
    return tuple(place)


def accepted(schema, is_limit=False, plural=False) -> str:
    """Return in words which values a schema accepts; `is_limit`: name the range of integers too."""
    if "enum" in schema or "const" in schema:
        words = ", ".join(shown(word) for word in schema.get("enum", [schema.get("const")]))
        return f"words out of {words}" if plural else words
    if "$ref" in schema:
        return NOUNS["object"][plural]
    if schema.get("maxItems") == 0:
        return "an empty list"
    kinds = schema.get("type", "object")
    kind = kinds if isinstance(kinds, str) else kinds[0]
    if kind != "array":
        null = " or null" if "null" in kinds else ""
        name = ", or a name" if kinds == ["integer", "string"] else ""
        name = ", or the word of its type" if kinds == ["object", "string"] else name
        words = "".join(f", or {shown(word)}" for word in schema.get("examples", ()))
        return NOUNS[kind][plural] + null + _limits(schema, is_limit) + name + words
    count = f" of {schema['minItems']}" if schema.get("minItems", 0) > 1 else ""
    if "prefixItems" in schema:
        return f"{NOUNS[kind][plural]}{count} {accepted(schema['prefixItems'][0], plural=True)}"
    link = count or " of"
    text = f"{NOUNS[kind][plural]}{link} {accepted(schema['items'], is_limit, plural=True)}"
    if "then" in schema:
        return f"{text}, or {NOUNS['object'][0]}"
    return f"{text}, or an object of such entries" if "object" in kinds else text


def _limits(schema, is_limit):
    names = [
        f"{text} {schema[name]:g}" if abs(schema[name]) < 1e6 else f"{text} {schema[name]}"
        for name, text in LIMITS.items()
        if name in schema and (is_limit or schema[name] != INTEGERS.get(name))
    ]
    return " " + " and ".join(names) if names else ""


def _wrong(error, path, schema, report):
    value, place = error.instance, place_of(path)
    near = meant(value, error.schema.get("enum", error.schema.get("examples", ())))
    hint = f"; did you mean {shown(near)}?" if near else ""
    text = accepted(error.schema, is_limit=error.validator in LIMITS)
    if place[-2:] in FIELD_ENTRIES and isinstance(value, str):
        report.warn(path, f"{shown(value)} is no field, ignored{hint or f'; known: {text}'}")
    else:
        if isinstance(value, str) and error.schema.get("type") in ("number", "integer"):
            text += ", without quotes"
        about = _about(error, schema)
        report.error(path, f"{shown(value)} is not accepted; accepted: {text}{about}{hint}")


def _missing(error, path, schema, report):
    if error.validator == "anyOf":
        keys = [error.validator_value[0]["required"][0]]
    else:
        keys = [key for key in error.validator_value if key not in error.instance]
    known = schema["properties"]
    for _, node in _around(error, schema):
        known = node.get("properties", known) if isinstance(node, dict) else known
    for key in keys:
        wanted = known.get(key, {})
        text = wanted.get("description", "")
        about = f"; needed: {accepted(wanted)}{text and f' ({text})'}" if wanted else ""
        report.error((*path, key), f"missing{about}")


def _unknown(error, path, schema, report):
    known = error.schema["properties"]
    current = [key for key in known if not known[key].get("deprecated")]
    place = place_of(path)
    for number, key in enumerate(key for key in error.instance if key not in known):
        near = OBSOLETE.get((place, key)) or (number < MOST_HINTS and meant(key, current))
        hint = f'; did you mean "{near}"?' if near else _home(key, schema)
        report.warn((*path, key), f"unknown key, ignored{hint}")


def _home(key, schema):
    """Return a remark on where else a key is known."""
    if key in schema["properties"]:
        return "; it belongs to the top level"
    parts = schema["$defs"].items()
    homes = [name for name, part in parts if key in part["properties"] and key != "type"]
    return f'; it belongs to "{homes[0]}"' if homes else ""


def _about(error, schema):
    """Return the description of the innermost key around an error, in brackets."""
    text = ""
    for step, node in _around(error, schema):
        if step == "properties":
            text = ""
        elif isinstance(node, dict):
            text = node.get("description", text)
    return f" ({text})" if text else ""


def _around(error, schema):
    """Yield the steps that lead to an error, and what is there of the schema, outer ones first."""
    node = schema
    for step in error.absolute_schema_path:
        while isinstance(node, dict) and step not in node and "$ref" in node:
            node = schema["$defs"][node["$ref"].rpartition("/")[2]]
            yield None, {"properties": node.get("properties", {})}
        node = node[step]
        yield step, node
