"""What pages are told of events: what came of each, and of which nothing did."""

from __future__ import annotations

import json
from typing import Any

from pluto_fleet.station.happened import KEPT, EventRows


def raised(id: str, t: float = 1.0, **more: object) -> dict[str, Any]:
    """Return the event of a journal that says that something has happened."""
    return {"t": t, "event": "event.raised", "id": id, "kind": "smoke", "raised": t, **more}


def over(id: str, **what: str) -> dict[str, Any]:
    """Return that of what came of it."""
    return {"t": 2.0, "event": "event.over", "id": id, **what}


def rows(*events: dict[str, Any]) -> list[Any]:
    """Return what pages are told after these."""
    told = EventRows()
    for event in events:
        told.take(event)
    return [*told]


def test_it_is_told_where_it_was_what_it_was_about_and_what_two_creators_made_of_it() -> None:
    [row] = rows(
        raised("a", at=[1.0, 2.0, 1.2], track="t7", drone="cf1", fields={"kind": "dog"}),
        over("a", made="Look"),
        over("a", why="second made no mission of it"),
    )
    assert (row["name"], row["at"], row["track"], row["drone"]) == (
        "smoke",
        [1.0, 2.0, 1.2],
        "t7",
        "cf1",
    )
    assert (row["fields"], row["made"]) == ({"kind": "dog"}, ["Look"])
    assert (row["why"], row["over"]) == ("second made no mission of it", 2.0)


def test_until_a_creator_has_answered_nothing_is_decided() -> None:
    [row] = rows(raised("a"))
    assert (row["made"], row["why"], row["over"]) == ([], "", None)


def test_the_flights_that_it_breaks_off_are_told() -> None:
    off = {"t": 1.0, "event": "trip.interrupted", "mission": "Patrol", "trip": "1"}
    other, row = rows(raised("a"), raised("b"), {**off, "by": "b"}, off)
    assert (other["broke_off"], row["broke_off"]) == ([], ["Patrol"])


def test_what_was_kept_for_too_long_is_told_with_why_nothing_came_of_it() -> None:
    gone = {"t": 9.0, "event": "event.dropped", "id": "a", "kind": "smoke", "why": "it is too old"}
    [row] = rows(gone)
    assert (row["name"], row["why"], row["over"]) == ("smoke", "it is too old", 9.0)


def test_of_a_flood_the_newest_are_known_and_a_page_is_told_each_change_once() -> None:
    told = EventRows()
    for number in range(3 * KEPT):
        told.take(raised(f"e{number}", t=float(number)))
    assert [row["time"] for row in told] == [float(2 * KEPT + one) for one in range(KEPT)]
    assert told.look(1)
    told.take(over("e0", made="too late to be shown"))
    assert not told.look(2)
    told.take(over(f"e{3 * KEPT - 1}", made="Look"))
    assert told.look(2)
    [change] = map(json.loads, told.since(1))
    assert change["made"] == ["Look"]
