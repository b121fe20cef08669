"""What is answered, what is refused, and that what is refused changes nothing."""

from __future__ import annotations

import asyncio
import json
from pathlib import Path

import pytest
from openapi_spec_validator import validate

from pluto_fleet.station.operation import Operation
from pluto_fleet.station.results.exports import Exports
from pluto_fleet.station.web.handlers import DESCRIPTION, HANDLERS, OPERATIONS, json_reply
from station_interface.made import made

from .asking import OURS, AStation, asked, request, said, without

ADDRESSES = tuple(OPERATIONS.values())
COMMANDS = [one for one in ADDRESSES if one.role == "fly"]


def query_of(address: Operation) -> dict[str, str]:
    """Return what must be asked with an address."""
    needed = [name for name in address.query if name not in address.defaults]
    return {name: "1" if name in ("revision", "result") else "one" for name in needed}


def test_each_address_is_answered() -> None:
    assert {*HANDLERS, "live"} == set(OPERATIONS)


def test_a_mistake_of_ours_is_told_to_the_log_and_not_to_the_client(tmp_path: Path) -> None:
    ask = asked(AStation(wrong=ZeroDivisionError("secret")), tmp_path / "audit.log")
    for reply in (
        ask("POST", "/api/start", {"id": "one"}),
        ask("GET", "/api/live"),
    ):
        assert reply.status == 500
        assert b"secret" not in reply.body and b"Traceback" not in reply.body
    assert "ZeroDivisionError: secret" in (tmp_path / "audit.log").read_text()


def test_a_number_that_json_does_not_have_is_a_word() -> None:
    reply = json_reply([{"value": float("nan")}, {"value": (1.5, float("inf"))}])
    assert json.loads(bytes(reply.body)) == [{"value": "nan"}, {"value": [1.5, "inf"]}]


def test_the_picture_of_a_result_is_given_whole_or_small(monkeypatch: pytest.MonkeyPatch) -> None:
    async def picture(_: object, flight: str, number: int, *, small: bool) -> tuple[bytes, str]:
        return f"{flight}/{number}".encode(), "image/jpeg" if small else "image/png"

    monkeypatch.setattr(Exports, "picture", picture)
    ask = asked()
    for size, kind in (("", "image/png"), ("full", "image/png"), ("thumb", "image/jpeg")):
        reply = ask("GET", "/api/photo", flight="a-flight", result="7", size=size)
        assert (reply.status, reply.type, reply.body) == (200, kind, b"a-flight/7")
    assert ask("GET", "/api/photo", result="7", size="huge").status == 400


def test_a_page_of_another_site_changes_nothing() -> None:
    elsewhere = without("x-pluto"), without(origin="http://evil.example"), without(host="rebound")
    given = {"id": "one", "revision": 1, "missions": []}
    for address in COMMANDS:
        types = [(without(content_type="text/plain"), 415)] if address.body is not None else []
        for headers, status in (*((one, 403) for one in elsewhere), *types):
            ask = asked()
            reply = ask(address.method, address.path, given, headers, **query_of(address))
            assert (reply.status, ask.station.untouched) == (status, True), address.path


def test_without_the_token_nothing_changes_and_one_waits_to_be_told() -> None:
    ask = asked(token="sesame")
    for address in COMMANDS:
        for headers in (OURS, without(authorization="Bearer guess")):
            query = {**query_of(address), "token": "sesame"}
            reply = ask(address.method, address.path, {"id": "one"}, headers, **query)
            assert reply.status == 401 and ("www-authenticate", "Bearer") in reply.headers
    assert ask.station.untouched
    assert len(ask.paused) == 2 * len(COMMANDS)
    headers = without(authorization="Bearer sesame")
    assert ask("POST", "/api/start", {"id": "one"}, headers).status == 200
    assert len(ask.paused) == 2 * len(COMMANDS)


def test_who_has_the_token_for_watching_reads_everything_and_commands_nothing() -> None:
    ask = asked(token="sesame", watch_token="poppy")
    watch = without(authorization="Bearer poppy")
    for address in ADDRESSES:
        reply = ask(address.method, address.path, {"id": "1"}, watch, **query_of(address))
        if address.role == "watch":
            assert reply.status in (200, 400, 404), address.path  # no ways, no pictures
        else:
            assert reply.status == 403 and "may watch and not command" in said(reply)
    assert ask.station.untouched
    roles = [
        json.loads(ask("GET", "/api/app", b"", without(authorization=f"Bearer {token}")).body)[
            "role"
        ]
        for token in ("poppy", "sesame")
    ]
    assert roles == ["watch", "fly"]
    posts = {one.path for one in ADDRESSES if one.method != "GET" and one.role == "watch"}
    assert posts == {"/api/ways"}  # it changes nothing


async def test_many_who_guess_keep_no_owner_out() -> None:
    gate = asyncio.Event()
    ask = asked(token="sesame", gate=gate)
    stop = request(
        "POST", "/api/stop", {"id": "1", "how": "rtl"}, without(authorization="Bearer sesame")
    )
    start = request("POST", "/api/start", {"id": "2"}, without(authorization="Bearer sesame"))
    guess = request("POST", "/api/start", {"id": "3"})
    guesses = [asyncio.create_task(ask.api.answer(guess)) for _ in range(200)]
    await asyncio.sleep(0)
    assert (await ask.api.answer(start)).status == 200
    assert (await ask.api.answer(stop)).status == 200
    assert len(ask.paused) == 32  # the others are answered at once
    gate.set()
    assert {(await each).status for each in guesses} == {401}


def test_of_too_many_commands_some_are_refused_but_never_what_brings_drones_down() -> None:
    ask = asked()
    starts = [ask("POST", "/api/start", {"id": f"{n}"}).status for n in range(50)]
    assert starts == [200] * 20 + [429] * 30
    edits = [ask("POST", "/api/plan/example", {"revision": n + 1}).status for n in range(21)]
    assert edits == [200] * 20 + [429]
    stops = [ask("POST", "/api/stop", {"id": f"{n}", "how": "rtl"}).status for n in range(50)]
    assert stops == [200] * 50
    cuts = [ask("POST", "/api/cut-motors", {"id": f"{n}", "drone": "cf1"}) for n in range(50)]
    assert [one.status for one in cuts] == [200] * 50
    ask.times.append(0.5)
    assert [ask("POST", "/api/start", {"id": "x"}).status for _ in range(11)][9:] == [200, 429]


async def test_a_stop_is_taken_when_all_others_wait() -> None:
    gate = asyncio.Event()
    station = AStation(busy=gate.wait)
    ask = asked(station)
    waiting = []
    for n in range(64):
        ask.times.append(float(n))
        start = request("POST", "/api/start", {"id": f"{n}"})
        waiting.append(asyncio.create_task(ask.api.answer(start)))
        await asyncio.sleep(0)
    poll = request("GET", "/api/live")
    polls = [asyncio.create_task(ask.api.answer(poll)) for _ in range(33)]
    await asyncio.sleep(0)
    one_more = await ask.api.answer(request("POST", "/api/start", {"id": "one more"}))
    assert one_more.status == 503
    assert (await ask.api.answer(request("GET", "/"))).status == 200
    assert (
        await ask.api.answer(request("POST", "/api/stop", {"id": "s", "how": "rtl"}))
    ).status == 200
    cut = request("POST", "/api/cut-motors", {"id": "c", "drone": "cf1"})
    assert (await ask.api.answer(cut)).status == 200
    assert [what for what, _ in station.done] == ["stop", "cut-motors"]
    gate.set()
    assert {(await each).status for each in waiting} == {200}
    assert [(await each).status for each in polls] == [200] * 32 + [503]


@pytest.mark.parametrize(
    ("method", "path", "type"),
    [
        ("GET", "/", "text/html; charset=utf-8"),
        ("GET", "/api/app", "application/json"),
        ("GET", "/nowhere", "application/json"),
        ("POST", "/api/start", "application/json"),
    ],
)
def test_every_answer_says_what_a_browser_must_not_do_with_it(
    method: str, path: str, type: str
) -> None:
    reply = asked()(method, path, {"id": "one"})
    headers = {name.lower(): value for name, value in reply.headers}
    assert reply.type == type
    assert len(headers) == len(reply.headers)
    assert headers["x-content-type-options"] == "nosniff"
    assert headers["cross-origin-resource-policy"] == "same-origin"
    assert headers["referrer-policy"] == "no-referrer"
    assert headers["cache-control"] == ("no-cache" if path == "/" else "no-store")
    assert headers["cross-origin-opener-policy"] == "same-origin"
    policy = headers["content-security-policy"].split("; ")
    assert policy[0] == "default-src 'none'"
    assert "frame-ancestors 'none'" in policy
    assert "unsafe" not in headers["content-security-policy"]


def test_where_others_may_listen_a_browser_is_told_nothing_that_it_would_not_heed() -> None:
    headers = {"host": "192.168.0.7:8765"}
    reply = asked(host="192.168.0.7", token="sesame")("GET", "/", b"", headers)
    assert reply.status == 200
    assert "cross-origin-opener-policy" not in dict(reply.headers)
    assert "x-frame-options" in dict(reply.headers)


@pytest.mark.parametrize(("file", "text"), made().items(), ids=[file.name for file in made()])
def test_what_is_made_from_the_types_of_the_wire_is_current(file: Path, text: str) -> None:
    """`python -m station_interface` makes it anew."""
    assert file.read_text(encoding="utf-8") == text


def test_the_description_is_valid_openapi_and_is_served() -> None:
    validate(json.loads(DESCRIPTION.read_text(encoding="utf-8")))
    assert asked()("GET", "/api/openapi.json").body == DESCRIPTION.read_bytes()
