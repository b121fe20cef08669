"""The rules as a TextMate grammar, which most editors read."""

from __future__ import annotations

from json import dumps

from plutoc.highlight.rules import RULES, Kind

SCOPES = {
    Kind.COMMENT: "comment.line.number-sign",
    Kind.TEXT: "string.quoted.double",
    Kind.NUMBER: "constant.numeric",
    Kind.PARAMETER: "variable.parameter",
    Kind.DECLARED: "entity.name.function",
    Kind.WORD: "keyword.other",
    Kind.CONSTANT: "constant.language",
    Kind.STATUS: "constant.other.status",
    Kind.TYPE: "support.type",
    Kind.TERMINAL: "variable.language",
    Kind.BLOCK: "entity.name.type",
    Kind.ARROW: "keyword.operator.arrow",
}


def grammar() -> str:
    """Return the grammar as the text of a `.tmLanguage.json` file."""
    patterns = [{"name": f"{SCOPES[rule.kind]}.pluto", "match": rule.pattern} for rule in RULES]
    whole = {
        "name": "Pluto",
        "scopeName": "source.pluto",
        "fileTypes": ["pluto"],
        "patterns": patterns,
    }
    return dumps(whole, indent=2) + "\n"
