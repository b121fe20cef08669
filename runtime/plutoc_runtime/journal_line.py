"""An event as one line of JSON: what a trace, or a journal, keeps of it."""

from __future__ import annotations

import json
from collections.abc import Callable
from json.encoder import encode_basestring_ascii
from math import isfinite
from typing import TYPE_CHECKING, Any

from .cli.as_json import dumped

if TYPE_CHECKING:
    from .trace import Event


def line(event: Event) -> str:
    """Return an event as a line of JSON, without the end of the line; numbers have three decimals.

    There is one for each transition, so each kind of event has a template, made once.
    """
    kind = event["event"], len(event)
    template = _TEMPLATES.get(kind)
    if template is None:
        facts = [json.dumps(key).replace("%", "%%") + ": %s" for key in event]
        template = _TEMPLATES[kind] = "{" + ", ".join(facts) + "}"
    return template % tuple([_WRITE[type(fact)](fact) for fact in event.values()])


def exact(event: Event) -> str:
    """Return an event as a line of JSON with every number as it is: what the journal keeps."""
    return json.dumps(event)


class _Writers(dict[type, Callable[[Any], str]]):
    """How a fact of each type is written; what is not here is left to `dumped`."""

    def __missing__(self, _: type) -> Callable[[Any], str]:
        return dumped


def _number(value: float) -> str:
    return repr(round(value, 3) + 0.0) if isfinite(value) else "null"  # + 0.0: never -0.0


def _list(values: list[Any]) -> str:
    return "[" + ", ".join([_WRITE[type(value)](value) for value in values]) + "]"


_TEMPLATES: dict[tuple[object, int], str] = {}

_WRITE = _Writers(
    {
        str: encode_basestring_ascii,
        int: repr,
        float: _number,
        list: _list,
        type(None): lambda _: "null",
    }
)
