"""Diagnostics for GitHub Actions: a workflow command a line, shown beside the code it is about.

The format is of GitHub's own page "Workflow commands for GitHub Actions".
"""

from __future__ import annotations

from plutoc.diagnostic import Diagnostic, Related
from plutoc_runtime.domain.text import printable

_Properties = dict[str, str | int]


def render_line(diagnostic: Diagnostic) -> str:
    """Return one diagnostic as a workflow command, without its end of line."""
    source, span = diagnostic.source, diagnostic.span
    line, column = source.position(span.start)
    end_line, end_column = source.position(span.end)
    properties: _Properties = {"file": source.path, "line": line, "endLine": end_line}
    if line == end_line:  # columns of a place over several lines are refused
        properties |= {"col": column, "endColumn": end_column}
    text = [diagnostic.message + (f" ({diagnostic.label})" if diagnostic.label else "")]
    text += [_related(related) for related in diagnostic.related]
    text += [f"help: {diagnostic.help}"] if diagnostic.help else []
    properties["title"] = diagnostic.code
    return _command(diagnostic.severity.value, properties, text)


def render_trouble(sentence: str) -> str:
    """Return what kept a file from being read, as a workflow command."""
    return _command("error", {"title": "plutoc"}, [sentence])


def _related(related: Related) -> str:
    line, column = related.source.position(related.span.start)
    return f"{related.source.path}:{line}:{column}: {related.label}"


def _command(name: str, properties: _Properties, text: list[str]) -> str:
    facts = ",".join(f"{key}={_property(str(value))}" for key, value in properties.items())
    message = "\n".join(text)
    return f"::{name} {facts}::{_data(message)}"


def _data(text: str) -> str:
    lines = (printable(line).replace("%", "%25") for line in text.split("\n"))
    return "%0A".join(lines)


def _property(text: str) -> str:
    return _data(text).replace(":", "%3A").replace(",", "%2C")
