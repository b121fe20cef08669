"""An event as one line of JSON: what a trace, or a journal, keeps of it."""

from __future__ import annotations

import json
from collections.abc import Callable
from json.encoder import encode_basestring_ascii
from math import isfinite
from typing import TYPE_CHECKING, Any

from plutoc_runtime.domain.text import shown
from plutoc_runtime.domain.trace import dumped

if TYPE_CHECKING:
    from plutoc_runtime.domain.trace import Event


def line(event: Event) -> str:
    """Return an event as a line of JSON, without the end of the line; numbers have three decimals."""
    return _TEMPLATES[tuple(event)] % tuple([_WRITE[type(fact)](fact) for fact in event.values()])


def exact(event: Event) -> str:
    """Return an event as a line of JSON with every number as it is: what the journal keeps."""
    return _TEMPLATES[tuple(event)] % tuple([_EXACT[type(fact)](fact) for fact in event.values()])


class _Templates(dict[tuple[str, ...], str]):
    """The lines of all events with these facts: there is one for each transition."""

    def __missing__(self, facts: tuple[str, ...]) -> str:
        named = [json.dumps(fact).replace("%", "%%") + ": %s" for fact in facts]
        template = self[facts] = "{" + ", ".join(named) + "}"
        return template


class _Writers(dict[type, Callable[[Any], str]]):
    """How a fact of each type is written; what is not here is left to `dumped`."""

    def __missing__(self, _: type) -> Callable[[Any], str]:
        return dumped


class _ExactWriters(dict[type, Callable[[Any], str]]):
    """The same, but nothing is rounded."""

    def __missing__(self, _: type) -> Callable[[Any], str]:
        return _as_can_be


def _as_can_be(value: object) -> str:
    """Write what may be no plain data: a hook may put anything anywhere."""
    try:
        return json.dumps(value, default=shown)
    except (TypeError, ValueError):  # keys that are no text, circles
        return json.dumps(shown(value))


class _Numbers(dict[float, str]):
    """Numbers as they are written: a time, a place and a full battery come up again and again."""

    def __missing__(self, value: float) -> str:
        if not isfinite(value):
            return "null"
        if len(self) >= _MOST_NUMBERS:
            self.clear()
        written = self[value] = repr(round(value, 3) + 0.0)  # + 0.0: never -0.0
        return written


def _exact(value: float) -> str:
    return repr(value) if isfinite(value) else json.dumps(value)  # as Python reads it again


def _list(values: list[Any]) -> str:
    return "[" + ", ".join([_WRITE[type(value)](value) for value in values]) + "]"


def _exact_list(values: list[Any]) -> str:
    return "[" + ", ".join([_EXACT[type(value)](value) for value in values]) + "]"


_TEMPLATES = _Templates()

_MOST_NUMBERS = 4096
_NUMBERS = _Numbers()
"""No more than so many; 0 and -0 are one number, and written alike."""

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
