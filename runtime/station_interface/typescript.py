"""The types of the wire in TypeScript, for the type checker of the pages, from the description."""

from __future__ import annotations

import json

from .openapi import Schema

_PLAIN = {
    "string": "string",
    "integer": "number",
    "number": "number",
    "boolean": "boolean",
    "null": "null",
}
_HEAD = "// Made from pluto_fleet/station/wire.py by `python -m station_interface`: change that.\n"


def declarations(description: Schema) -> str:
    """Return an interface for each schema of a description."""
    schemas = description["components"]["schemas"]
    return "\n".join([_HEAD, *(_interface(name, one) for name, one in schemas.items())])


def _interface(name: str, schema: Schema) -> str:
    lines = [f"/** {_comment(schema['description'])} */", f"export interface {name} {{"]
    for key, one in schema["properties"].items():
        if "description" in one:
            lines.append(f"  /** {_comment(one['description'])} */")
        mark = "" if key in schema["required"] else "?"
        lines.append(f"  {key}{mark}: {_type(one)};")
    if schema["additionalProperties"]:
        lines.append("  [field: string]: unknown;")
    return "\n".join([*lines, "}", ""])


def _comment(text: str) -> str:
    return " ".join(text.split())


def _type(schema: Schema) -> str:
    match schema:
        case {"$ref": str(reference)}:
            return reference.rpartition("/")[2]
        case {"enum": list(values)}:
            return " | ".join(map(json.dumps, values))
        case {"anyOf": list(some)}:
            return " | ".join(map(_type, some))
        case {"type": "array", "items": items}:
            inner = _type(items)
            return f"({inner})[]" if " " in inner else f"{inner}[]"
        case {"type": "object", "additionalProperties": values}:
            return f"Record<string, {_type(values)}>"
        case {"type": str(plain)}:
            return _PLAIN[plain]
    return "unknown"
