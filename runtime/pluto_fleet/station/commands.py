"""The commands of a station, and their arguments."""

from __future__ import annotations

from collections.abc import Mapping

from ..jobs.job import MISHAPS
from ..shared.domain.errors import BadInput
from ..shared.domain.text import quoted

_MISSION, _TRIP = {"mission": (str,)}, {"trip": (str,)}
_ALL = {"mission": (str, type(None))}
_JOINING = ("category", "home", "uri", "navigation", "options")
"""The keys of a drone in a fleet file, which says all that is wrong with them."""
_ANY = (str, list, dict, int, float, bool, type(None))

NEEDS: Mapping[str, Mapping[str, tuple[type, ...]]] = {
    "start": {"revision": (int, type(None)), "missions": (list, type(None))},
    "stop": {"how": (str,)},
    "resume": {},
    "discard": {},
    "pause": _ALL,
    "go-on": _ALL,
    "skip": {**_MISSION, "trip": (str, type(None))},
    "cancel": _ALL,
    "decide": {**_MISSION, "answer": (str,)},
    "change-trips": {**_MISSION, "trips": (list,), "replaces": (list, type(None))},
    "prioritise": {**_MISSION, **_TRIP, "priority": (int,)},
    "retire": {"drone": (str,)},
    "bring-back": {"drone": (str,)},
    "join": {"drone": (str,), **dict.fromkeys(_JOINING, _ANY)},
    "mishap": {"drone": (str,), "kind": (str,)},
    "cut-motors": {"drone": (str,)},
}
"""The arguments of each command; those that may be null are optional."""

HOWS = ("rtl", "land")

LARGEST = 1_000_000_000
"""The largest absolute priority, as in a missions file."""


class Malformed(BadInput):
    """A malformed command: it lacks an argument, for example."""


def checked(name: str, given: Mapping[str, object]) -> dict[str, object]:
    """Return a command's arguments; raise `Malformed` if one is missing or invalid."""
    needs = NEEDS.get(name)
    if needs is None:
        raise Malformed(f"there is no command {quoted(name)}")
    for key in given:
        if key not in needs:
            raise Malformed(f"{name} takes no {quoted(key)}")
    arguments: dict[str, object] = {}
    for key, types in needs.items():
        value = given.get(key)
        if type(value) not in types:
            raise Malformed(f"{name} needs {key}: {_said(types)}")
        arguments[key] = value
    chosen = arguments.get("missions")
    if isinstance(chosen, list) and not all(isinstance(key, str) for key in chosen):
        raise Malformed(f"{name} needs missions: the keys of missions of the plan, or null")
    if name == "stop" and arguments["how"] not in HOWS:
        raise Malformed('stop needs how: "rtl", all fly home first, or "land", where they are')
    if name == "mishap" and arguments["kind"] not in MISHAPS:
        raise Malformed(f"mishap needs kind: one of {', '.join(MISHAPS)}")
    priority = arguments.get("priority")
    if isinstance(priority, int) and abs(priority) > LARGEST:
        raise Malformed(f"a priority is no more than {LARGEST}")
    return arguments


def _said(types: tuple[type, ...]) -> str:
    names = {str: "a text", int: "a whole number", list: "a list", type(None): "null"}
    names |= {dict: "an object", float: "a number", bool: "true or false"}
    return " or ".join(names[one] for one in types)
