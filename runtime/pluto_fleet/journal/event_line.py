"""Formatting an event as one line of JSON, for a trace or a journal."""

from __future__ import annotations

import json
from collections.abc import Callable
from json.encoder import encode_basestring_ascii
from math import isfinite
from typing import TYPE_CHECKING, Any

from ..shared.domain.text import shown
from ..shared.domain.trace import dumped

if TYPE_CHECKING:
    from ..shared.domain.trace import Event


def line(event: Event) -> str:
    """Return an event as a line of JSON, without the end of the line; numbers have three decimals."""
    return _TEMPLATES[tuple(event)] % tuple([_WRITE[type(fact)](fact) for fact in event.values()])


def exact(event: Event) -> str:
    """Return an event as a line of JSON with exact numbers, for the journal."""
    return _TEMPLATES[tuple(event)] % tuple([_EXACT[type(fact)](fact) for fact in event.values()])


class _Templates(dict[tuple[str, ...], str]):
    """Caches a template for each set of facts: there is one for each transition."""

    def __missing__(self, facts: tuple[str, ...]) -> str:
        named = [json.dumps(fact).replace("%", "%%") + ": %s" for fact in facts]
        template = self[facts] = "{" + ", ".join(named) + "}"
        return template


class _Writers(dict[type, Callable[[Any], str]]):
    """Writers for each type of fact; other types are left to `dumped`."""

    def __missing__(self, _: type) -> Callable[[Any], str]:
        return dumped


class _ExactWriters(dict[type, Callable[[Any], str]]):
    """The same without rounding."""

    def __missing__(self, _: type) -> Callable[[Any], str]:
        return _as_can_be


def _as_can_be(value: object) -> str:
    """Write a value that may not be plain data, as hooks can set anything."""
    try:
        return json.dumps(value, default=shown)
    except (TypeError, ValueError):  # keys that are not text, or cycles
        return json.dumps(shown(value))


class _Numbers(dict[float, str]):
    """A cache of formatted numbers: times, places and full batteries recur."""

    def __missing__(self, value: float) -> str:
        if not isfinite(value):
            return "null"
        if len(self) >= _MOST_NUMBERS:
            self.clear()
        written = self[value] = repr(round(value, 3) + 0.0)  # + 0.0: never -0.0
        return written


def _exact(value: float) -> str:
    return repr(value) if isfinite(value) else json.dumps(value)  # exact


def _list(values: list[Any]) -> str:
    return "[" + ", ".join([_WRITE[type(value)](value) for value in values]) + "]"


def _exact_list(values: list[Any]) -> str:
    return "[" + ", ".join([_EXACT[type(value)](value) for value in values]) + "]"


_TEMPLATES = _Templates()

_MOST_NUMBERS = 4096
_NUMBERS = _Numbers()
"""The size of the cache; 0 and -0 are one number, and written alike."""

_WRITE = _Writers(
    {
        str: encode_basestring_ascii,
        int: repr,
        float: _NUMBERS.__getitem__,
        list: _list,
        type(None): lambda _: "null",
    }
)

_EXACT = _ExactWriters(
    {
        str: encode_basestring_ascii,
        int: repr,
        float: _exact,
        list: _exact_list,
        type(None): lambda _: "null",
    }
)
