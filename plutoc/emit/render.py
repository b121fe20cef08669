"""Rendering files: a Jinja2 template places the values, Black formats Python."""

from __future__ import annotations

from pathlib import Path

import black
from black.mode import TargetVersion
from jinja2 import Environment, FileSystemLoader, StrictUndefined

from plutoc.emit.markup import header
from plutoc.emit.python import LINE_LENGTH

_TEMPLATES = Path(__file__).with_name("templates")
_ENVIRONMENT = Environment(
    loader=FileSystemLoader(_TEMPLATES),
    undefined=StrictUndefined,
    autoescape=False,  # what needs it comes escaped, for the language that it goes into
    trim_blocks=True,
    lstrip_blocks=True,
    keep_trailing_newline=True,
)
_MODE = black.Mode(line_length=LINE_LENGTH, target_versions={TargetVersion.PY311})


def render(template: str, **values: object) -> str:
    """Return a template with the values in their places."""
    return _ENVIRONMENT.get_template(f"{template}.jinja").render(values)


def verbatim(name: str) -> str:
    """Return a file that is handed on as it is."""
    return (_TEMPLATES / name).read_text("utf-8")


def formatted(text: str) -> str:
    """Return a module as Black writes it."""
    return black.format_str(text, mode=_MODE)


def owned(text: str, source_name: str) -> str:
    """Return a module that plutoc rewrites each time, with its header.

    The header stands first: nothing that a user wrote can get into the two lines in which Python
    looks for a file's encoding.
    """
    return f"# {header(source_name)}\n# fmt: off\n{formatted(text)}"
