"""From the events of a flight to its results, each a row of the contract with pages."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from ...jobs.flown import ACTS_BESIDE
from ...journal.facts import DRAINED
from ...report.sentences import sentence_of
from ...shared.domain.actions import MEASURE
from ...shared.domain.text import bounded
from .meaning import Meaning, Meanings

if TYPE_CHECKING:
    from ...shared.domain.actions import Action
    from ...shared.domain.trace import Event
    from ..wire import PhotoValue, Result

NameOf = Callable[[Sequence[float]], str | None]
"""Returns the named place or zone that contains a point, or None."""

LONGEST_VALUE = 1_000
"""Characters of an action's result on pages; all of it is in the results' file."""

LARGEST_ROUNDED = 1_000_000
"""Pages show six digits of a number; larger whole numbers are sent as text, in full."""

LONGEST_TAG = 80
"""Characters of a text that an action returned, as a finding on the map."""

VERDICTS = {"mission.judged": "not accepted", "mission.extended": "more to do"}


def nowhere(_: Sequence[float]) -> str | None:
    """Name no place: the map has no named ones."""
    return None


class ResultRows:
    """Makes the results of one flight, in order; the first is number 1."""

    def __init__(
        self,
        flight: str,
        actions: Mapping[str, Action],
        meanings: Meanings,
        name_of: NameOf = nowhere,
    ) -> None:
        """`flight` is the id by which its pictures are asked for."""
        self._flight, self._actions, self._meanings = flight, actions, meanings
        self._name_of = name_of
        self._beside: dict[tuple[object, object], Any] = {}
        """Where actions are done that are done beside their targets, by mission and trip."""
        self._brought: dict[object, tuple[Result, Any]] = {}
        """What the last trip of each drone has brought, until it is told how it came home."""
        self.last = 0
        self.pictures: dict[int, str] = {}
        """The files of photos, as their cameras named them, by the numbers of their results."""

    def take(self, event: Event) -> tuple[Result, Any] | None:
        """Process an event; return the result that it brings, and its value in full.

        A result of before, known by its number, is returned once more if the event says more of it.
        Of a `trip.completed`, `did` must be the trip.
        """
        kind = event["event"]
        if kind == ACTS_BESIDE:
            self._beside[event["mission"], event["trip"]] = event["at"]
        elif kind == "trip.failed":
            self._beside.pop((event["mission"], event["trip"]), None)
        elif kind == "trip.launched":
            self._brought.pop(event["drone"], None)
        elif kind == "trip.completed":
            self._brought[event["drone"]] = brought = self._completed(event)
            return brought
        elif kind == "action.result":
            return self._on_the_way(event)
        elif kind == DRAINED:
            return self._drained(event)
        elif (verdict := VERDICTS.get(str(kind))) is not None:
            said = f"{verdict}: {event.get('reason') or sentence_of(event)}"
            return self._row(event) | {"kind": "verdict", "value": said}, said
        return None

    def _row(self, event: Event) -> Result:
        fact: Any = event.get
        self.last += 1
        return {
            "number": self.last,
            "time": fact("t"),
            "mission": fact("mission"),
            "trip": fact("trip"),
            "round": fact("round"),
            "attempt": fact("attempt"),
            "drone": fact("drone"),
            "kind": "result",
            "action": None,
            "parameters": {},
            "target": None,
            "at": None,
            "place": None,
            "value": None,
            "values": [],
            "tags": [],
            "layers": [],
            "drained": None,
        }

    def _drained(self, event: Event) -> tuple[Result, Any] | None:
        """Say of what a drone has brought last that it came home with less than its reserve."""
        brought = self._brought.pop(event["drone"], None)
        if brought is not None:
            brought[0]["drained"] = round(float(str(event["level"])), 4)
        return brought

    def _completed(self, event: Event) -> tuple[Result, Any]:
        did: Any = event["did"]
        row = self._row(event)
        row["target"] = did["target"]
        row["at"] = self._beside.pop((event["mission"], event["trip"]), None)
        return self._done(row, str(did["action"]), did.get("parameters", {}), event.get("result"))

    def _on_the_way(self, event: Event) -> tuple[Result, Any]:
        """Return what an action has brought while its drone flew on."""
        fact: Any = event.get
        row = self._row(event)
        if fact("at") is not None:
            row["at"] = [round(one, 3) for one in fact("at")]
        return self._done(row, fact("action"), fact("parameters", {}), fact("result"))

    def _done(
        self, row: Result, name: str | None, parameters: Mapping[str, Any], data: Any
    ) -> tuple[Result, Any]:
        """Say what an action has brought; one without a name is a hook's own."""
        action = self._actions.get(name or "")  # none: the app had it when it flew
        usual = {one.name: one.default for one in action.parameters} if action else {}
        given = {**usual, **parameters}
        quantity = None
        if name == MEASURE:
            quantity = given.pop("quantity", None)
        meaning = self._meanings.of(name or "", quantity)
        value = plain(data)
        row["action"] = name
        row["parameters"] = given
        place = row["at"] or row["target"]
        row["place"] = None if place is None else self._name_of(place)
        row["kind"], row["layers"] = meaning.kind, [*meaning.layers]
        if isinstance(data, dict) and "$photo" in data:
            if meaning.kind != "handling":
                row["kind"] = "photo"
            photo = self._photo(row["number"], data["$photo"])
            row["value"] = photo
            row["tags"] = photo["sees"] if meaning.finds is not None else []
            return row, photo
        number = meaning.number(value)
        if number is not None:
            row["values"] = [number]
        row["tags"] = _found(meaning, value)
        row["value"] = _in_words(value)
        return row, value

    def _photo(self, number: int, photo: Mapping[str, Any]) -> PhotoValue:
        picture, file = None, photo.get("file")
        if file is not None:
            self.pictures[number] = str(file)
            picture = f"/api/photo?result={number}&flight={self._flight}"
        return {
            "position": photo["position"],
            "width": photo["width"],
            "height": photo["height"],
            "sees": [*photo["sees"]],
            "sharpness": photo["sharpness"],
            "picture": picture,
        }


def _found(meaning: Meaning, value: object) -> list[str]:
    if meaning.finds is None:
        return []
    if isinstance(value, str) and value.strip():
        return [bounded(value, LONGEST_TAG)]
    return [meaning.finds] if value is True else []


def plain(data: Any) -> Any:
    """Return a value of the journal without the journal's reserved keys."""
    match data:
        case {"$photo": inside} | {"$text": inside} | {"$number": inside}:
            return inside
        case {"$tuple": list(parts)} | list(parts):
            return [plain(part) for part in parts]
        case dict():
            return {name: plain(part) for name, part in data.items()}
        case _:
            return data


def _in_words(value: Any) -> str | int | float | bool | None:
    """Return an action's result as a page shows it."""
    match value:
        case int() if abs(value) >= LARGEST_ROUNDED:
            return str(value)
        case list() | dict():
            value = json.dumps(value, ensure_ascii=False)
    shown: str | int | float | bool | None = value
    return bounded(shown, LONGEST_VALUE) if isinstance(shown, str) else shown
