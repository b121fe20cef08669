"""The addresses of flights of the past."""

from __future__ import annotations

import json
from typing import Any

import pytest

from .asking import asked, said

OF_ONE = [
    ("/api/flights/replay", {"flight": "one", "start": 0.0}),
    ("/api/flights/report", {"flight": "one"}),
]


@pytest.mark.parametrize(("path", "answer"), OF_ONE)
def test_a_flight_is_asked_for_by_its_id(path: str, answer: Any) -> None:
    reply = asked()("GET", path, flight="one")
    assert reply.status == 200
    assert json.loads(reply.body) == answer


@pytest.mark.parametrize("path", [*(path for path, _ in OF_ONE), "/api/console.txt"])
def test_a_flight_that_is_not_there_is_not_found(path: str) -> None:
    reply = asked()("GET", path, flight="../one")
    assert (reply.status, said(reply)) == (404, "there is no flight '../one' here")


def test_files_of_a_flight_are_downloaded() -> None:
    """The console and the results without an id, or an empty one, are those of the flight of now."""
    ask = asked()
    for path, body in (("/api/flights/mcap", b"one"), ("/api/console.txt", b"one")):
        reply = ask("GET", path, flight="one")
        assert (reply.status, reply.body) == (200, body)
        assert dict(reply.headers)["Content-Disposition"].startswith("attachment")
    assert ask("GET", "/api/console.txt").body != b"one"
    assert ask("GET", "/api/console.txt", flight="").body != b"one"


@pytest.mark.parametrize("start", ["-1", "nan", "inf", "x", "1" * 99, "٣"])
def test_a_time_that_is_none_is_refused(start: str) -> None:
    reply = asked()("GET", "/api/flights/replay", b"", None, flight="one", start=start)
    assert reply.status == 400
    assert "start must be a number of seconds" in said(reply)


def test_a_part_is_asked_for_by_its_time() -> None:
    reply = asked()("GET", "/api/flights/replay", b"", None, flight="one", start="12.5")
    assert json.loads(reply.body)["start"] == 12.5
    first = asked()("GET", "/api/flights/replay", b"", None, flight="one", start="")
    assert json.loads(first.body)["start"] == 0.0


def test_lists_need_no_id() -> None:
    ask = asked()
    assert json.loads(ask("GET", "/api/flights").body) == [{"id": "one"}]
    assert json.loads(ask("GET", "/api/drones/hours").body) == [{"id": "cf1"}]


def test_reading_needs_the_token() -> None:
    for path in ("/api/flights", "/api/flights/mcap", "/api/drones/hours"):
        assert asked(token="a" * 32)("GET", path, flight="one").status == 401
