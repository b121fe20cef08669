"""What a rule is: it hears of some kinds of events, and says what must not be."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Protocol

if TYPE_CHECKING:
    from plutoc_runtime.domain.trace import Event

Say = Callable[[str], object]
"""Takes the sentence of a violation."""

Hears = Callable[["Event"], None]

OVER = "over"
"""The kind of the last thing that a rule hears: what should have happened by now and has not?"""


class Rule(Protocol):
    """One thing that must be true of every run."""

    @property
    def hears(self) -> Mapping[str, Hears]:
        """What to call, by the kind of event, such as `trip.launched`, or by its family, `trip`."""
        ...


def at(event: Event) -> str:
    """Return when it happened, for the beginning of a sentence."""
    return f"{float(str(event['t'])):g} s"


def flight(event: Event) -> tuple[object, object, object, object]:
    """Return which flight an event is about."""
    return event["trip"], event["drone"], event["round"], event["attempt"]


def named(flown: tuple[object, object, object, object]) -> str:
    """Return a flight in words."""
    trip, drone, round_, attempt = flown
    return f"{trip} ({drone}, round {round_}, attempt {attempt})"


def names(event: Event, key: str) -> list[str]:
    """Return a fact that is a list of names."""
    value = event[key]
    assert isinstance(value, list)
    return [str(name) for name in value]
