"""The templates: they place what Python has decided."""

from __future__ import annotations

from dataclasses import fields
from functools import cache
from importlib.resources import files
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from _typeshed import DataclassInstance
    from jinja2 import Environment


def render(template: str, view: DataclassInstance) -> str:
    """Return a template with the view's fields in their places."""
    values = {field.name: getattr(view, field.name) for field in fields(view)}
    return _environment().get_template(f"{template}.jinja").render(values)


def verbatim(name: str) -> str:
    """Return a file that is handed on as it is."""
    return files(__package__).joinpath("templates", name).read_text(encoding="utf-8")


@cache
def _environment() -> Environment:
    from jinja2 import Environment, PackageLoader, StrictUndefined

    # Nothing is escaped here: what needs it comes escaped, for the language that it goes into.
    return Environment(
        loader=PackageLoader(__package__),
        undefined=StrictUndefined,
        autoescape=False,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
    )
