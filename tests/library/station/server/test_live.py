"""Pages that are kept up to date: one answer to each question."""

from __future__ import annotations

import asyncio
import json
from collections.abc import Sequence
from dataclasses import replace
from itertools import zip_longest
from pathlib import Path

import pytest

from pluto_fleet.station.web import live
from tests.library.station.jumping import run

from .asking import OURS, SEEN, ALine, Asked, AStation, asked, request, without


def talk(ask: Asked, line: ALine, headers: dict[str, str] = OURS) -> ALine:
    run(ask.api.live(line, request("GET", "/api/live", b"", headers)))
    return line


@pytest.mark.parametrize("headers", [{}, without(origin="null"), without("origin", "x-pluto")])
def test_a_page_of_another_site_is_not_let_in(headers: dict[str, str]) -> None:
    ask = asked()
    line = talk(ask, ALine(SEEN), headers)
    assert line.refused and not line.opened and ask.station.told == 0


@pytest.mark.parametrize("token", [None, "", "guess"])
def test_the_first_message_bears_the_token(token: str | None) -> None:
    ask = asked(token="sesame")
    line = talk(ask, ALine(SEEN if token is None else {**SEEN, "token": token}))
    assert (line.closed, ask.station.told) == (live.NO_TOKEN, 0)
    line = talk(ask, ALine({**SEEN, "token": "sesame"}, SEEN))
    assert (line.closed, len(line.heard)) == (None, 2)


@pytest.mark.parametrize(
    "nonsense",
    [
        "nonsense",
        "[]",
        {},
        {**SEEN, "flight": None},
        {**SEEN, "seen": 1.5},
        '{"flight": "", "seen": NaN, "log": 0, "results": 0}',
        {**SEEN, "me": {"id": "abc"}},
        {**SEEN, "token": 1},
    ],
)
def test_who_talks_nonsense_is_hung_up_on(nonsense: object) -> None:
    ask = asked()
    assert talk(ask, ALine(nonsense, SEEN)).closed == live.MALFORMED
    assert talk(ask, ALine(SEEN, nonsense, SEEN)).closed == live.MALFORMED
    assert ask.station.told == 1


def test_who_asks_too_often_is_hung_up_on() -> None:
    line = talk(asked(), ALine(*[SEEN] * 30))
    assert (len(line.heard), line.closed) == (20, live.TOO_MANY)


def test_who_says_nothing_is_hung_up_on() -> None:
    ask = asked()
    assert talk(ask, ALine(stays=True)).closed == live.SILENT
    line = talk(ask, ALine(SEEN, stays=True))
    assert (len(line.heard), line.closed) == (1, live.SILENT)


def test_a_mistake_of_ours_is_told_to_the_log_and_not_to_the_page(tmp_path: Path) -> None:
    ask = asked(AStation(wrong=ZeroDivisionError("secret")), tmp_path / "audit.log")
    assert talk(ask, ALine(SEEN)).closed == live.TROUBLE
    assert "ZeroDivisionError: secret" in (tmp_path / "audit.log").read_text()


def all_at_once(ask: Asked, lines: Sequence[ALine], clients: Sequence[str] = ()) -> None:
    """Let all of them connect, and end the station once nothing happens any more."""
    live = request("GET", "/api/live")

    async def scene() -> None:
        talks = [
            asyncio.create_task(ask.api.live(line, replace(live, client=client or live.client)))
            for line, client in zip_longest(lines, clients)
        ]
        for _ in range(10):
            await asyncio.sleep(0)
        ask.api.end()
        await asyncio.gather(*talks)

    run(scene())


def test_so_many_pages_and_no_more_are_kept_up_to_date() -> None:
    lines = [ALine(SEEN, stays=True) for _ in range(40)]
    all_at_once(asked(), lines)
    assert [len(line.heard) for line in lines] == [1] * 32 + [0] * 8
    served, others = lines[:32], lines[32:]
    assert {line.closed for line in served} == {live.OVER}
    assert all(line.closed == live.TOO_MANY or line.refused for line in others)


def test_strangers_who_say_nothing_take_no_clients_place() -> None:
    ask = asked(token="sesame")
    strangers = [ALine(stays=True) for _ in range(100)]
    all_at_once(ask, strangers)
    assert {line.closed for line in strangers[:68]} == {live.TOO_MANY}
    assert {line.closed for line in strangers[68:]} == {live.OVER}
    headers = without(authorization="Bearer sesame")
    assert ask("GET", "/api/live", b"", headers).status == 200


def test_who_opens_one_connection_keeps_its_place_beside_who_opens_many() -> None:
    ask, patient = asked(token="sesame"), ALine(stays=True)
    all_at_once(ask, [patient, *(ALine(stays=True) for _ in range(100))], ["10.0.0.7"])
    assert (patient.opened, patient.closed) == (True, live.OVER)


def test_those_who_watch_take_no_place_of_those_who_command() -> None:
    ask = asked(token="sesame", watch_token="poppy")
    watching = [ALine({**SEEN, "token": "poppy"}, stays=True) for _ in range(40)]
    flies = ALine({**SEEN, "token": "sesame"}, stays=True)
    all_at_once(ask, [*watching, flies])
    assert sum(len(line.heard) for line in watching) == 32
    assert len(flies.heard) == 1


ME = {"id": "abc", "name": "Ana", "page": "monitor", "touches": ""}


def test_people_see_who_else_is_there() -> None:
    """What they say of themselves is a text of bounded length, and told once."""
    ask = asked(AStation(busy=lambda: asyncio.sleep(0)), token="sesame", watch_token="poppy")
    long = {"id": "x", "name": "B\x1b" + 100 * "o", "page": "plan", "touches": "trip-key"}
    ana = ALine({**SEEN, "token": "sesame", "me": ME}, SEEN, SEEN, stays=True)
    ben = ALine({**SEEN, "token": "poppy", "me": long}, SEEN, stays=True)
    all_at_once(ask, [ana, ben, ALine({**SEEN, "token": "poppy"}, stays=True)])
    [[person]] = [one["people"] for one in map(json.loads, ana.heard) if one.get("people")]
    assert person == {**long, "name": person["name"], "role": "watch"}
    assert person["name"].startswith("B\\x1boo") and len(person["name"]) <= 41
    first, second = map(json.loads, ben.heard)
    assert first["people"] == [{**ME, "role": "fly"}] and "people" not in second


def test_when_the_station_ends_no_client_is_waited_for() -> None:
    gate = asyncio.Event()
    ask = asked(AStation(busy=gate.wait))
    lines = [ALine(SEEN), ALine(stays=True), ALine(SEEN, SEEN)]
    all_at_once(ask, lines)
    assert {line.closed for line in lines} == {live.OVER}
    assert talk(ask, ALine(SEEN)).refused


def test_one_connects_at_one_address_only() -> None:
    ask, line = asked(), ALine(SEEN)
    run(ask.api.live(line, request("GET", "/api/start")))
    assert line.refused and ask.station.untouched and ask.station.told == 0
