"""The templates: they place what Python has decided."""

from __future__ import annotations

from dataclasses import fields
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING

from plutoc.emit.memory import edition, remembered

if TYPE_CHECKING:
    from collections.abc import Mapping

    from _typeshed import DataclassInstance
    from jinja2 import Environment

_FOLDER = Path(__file__).with_name("templates")
_ENDING = ".jinja"


def render(template: str, view: DataclassInstance) -> str:
    """Return a template with the view's fields in their places."""
    name = f"{template}{_ENDING}"
    # one may include others, so all of them count
    made_of = (edition("jinja2"), repr(sorted(_templates().items())), name, repr(view))
    return remembered(made_of, lambda: _rendered(name, view))


def verbatim(name: str) -> str:
    """Return a file that is handed on as it is."""
    return (_FOLDER / name).read_bytes().decode()


def _rendered(name: str, view: DataclassInstance) -> str:
    values = {field.name: getattr(view, field.name) for field in fields(view)}
    return _environment().get_template(name).render(values)


@cache
def _templates() -> Mapping[str, str]:
    """Return the text of each template."""
    files = sorted(_FOLDER.glob(f"*{_ENDING}"))
    return {file.name: file.read_bytes().decode() for file in files}


@cache
def _environment() -> Environment:
    from jinja2 import DictLoader, Environment, StrictUndefined

    # Nothing is escaped here: what needs it comes escaped, for the language that it goes into.
    return Environment(
        loader=DictLoader(_templates()),
        undefined=StrictUndefined,
        autoescape=False,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
    )
