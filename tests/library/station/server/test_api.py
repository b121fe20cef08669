"""What is answered, what is refused, and that what is refused changes nothing."""

from __future__ import annotations

import asyncio
import json
from pathlib import Path

import pytest

from pluto_fleet.shared.domain.errors import BadInput
from pluto_fleet.station.commands import Malformed
from pluto_fleet.station.web.addresses import ADDRESSES

from .asking import OURS, AStation, asked, request, said, without

CHANGES = [
    ("POST", "/api/start", {"id": "one"}),
    ("POST", "/api/stop", {"id": "two", "how": "rtl"}),
    ("PUT", "/api/plan", {"revision": 1, "missions": []}),
    ("POST", "/api/plan/example", {"revision": 1}),
]


def test_a_command_is_done_and_its_answer_said() -> None:
    ask = asked()
    reply = ask("POST", "/api/pause", {"id": "one", "mission": "North"})
    assert (reply.status, said(reply)) == (200, "pause is done")
    assert ask.station.done == [("pause", {"mission": "North"})]


@pytest.mark.parametrize(
    ("error", "status"), [(BadInput("nothing flies"), 409), (Malformed("no mission is named"), 400)]
)
def test_why_a_command_was_not_done_is_said(error: Exception, status: int) -> None:
    reply = asked(AStation(wrong=error))("POST", "/api/pause", {"id": "one"})
    assert reply.status == status
    assert said(reply).startswith(str(error))


def test_a_mistake_of_ours_is_told_to_the_log_and_not_to_the_client(tmp_path: Path) -> None:
    ask = asked(AStation(wrong=ZeroDivisionError("secret")), tmp_path / "audit.log")
    for reply in (
        ask("POST", "/api/start", {"id": "one"}),
        ask("GET", "/api/live"),
    ):
        assert reply.status == 500
        assert b"secret" not in reply.body and b"Traceback" not in reply.body
    assert "ZeroDivisionError: secret" in (tmp_path / "audit.log").read_text()


@pytest.mark.parametrize(("method", "path", "body"), CHANGES)
@pytest.mark.parametrize(
    ("headers", "status"),
    [
        ({}, 403),
        ({"host": OURS["host"]}, 403),
        (without("x-pluto"), 403),
        (without(host="rebound.example"), 403),
        (without(origin="http://evil.example"), 403),
        (without(sec_fetch_site="cross-site"), 403),
        (without("content-type"), 415),
        (without(content_type="text/plain"), 415),
        (without(content_type="application/x-www-form-urlencoded"), 415),
    ],
)
def test_a_page_of_another_site_changes_nothing(
    method: str, path: str, body: object, headers: dict[str, str], status: int
) -> None:
    ask = asked()
    assert ask(method, path, body, headers).status == status
    assert ask.station.untouched
    assert ask(method, path, body).status == 200
    assert not ask.station.untouched


@pytest.mark.parametrize(("method", "path", "body"), CHANGES)
def test_without_the_token_nothing_changes_and_one_waits_to_be_told(
    method: str, path: str, body: object
) -> None:
    ask = asked(token="sesame")
    for headers in (OURS, without(authorization="Bearer guess")):
        reply = ask(method, path, body, headers, token="sesame")
        assert reply.status == 401
        assert ("WWW-Authenticate", "Bearer") in reply.headers
    assert ask.station.untouched
    assert len(ask.paused) == 2
    assert ask(method, path, body, without(authorization="Bearer sesame")).status == 200
    assert len(ask.paused) == 2


def test_who_has_the_token_for_watching_reads_everything_and_commands_nothing() -> None:
    ask = asked(token="sesame", watch_token="poppy")
    watch = without(authorization="Bearer poppy")
    for address in ADDRESSES:
        needed = {
            name: "one" if one.type is str else "1"
            for name, one in address.query.items()
            if one.needed
        }
        reply = ask(address.method, address.path, {"id": "1"}, watch, **needed)
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
    ask = asked(token="sesame")
    gate = asyncio.Event()

    async def pause(_: float) -> None:
        await gate.wait()

    ask.api._pause = pause
    stop = request("POST", "/api/stop", {"id": "1"}, without(authorization="Bearer sesame"))
    start = request("POST", "/api/start", {"id": "2"}, without(authorization="Bearer sesame"))
    guess = request("POST", "/api/start", {"id": "3"})
    guesses = [asyncio.create_task(ask.api.answer(guess)) for _ in range(200)]
    assert (await ask.api.answer(start)).status == 200
    assert (await ask.api.answer(stop)).status == 200
    gate.set()
    assert {(await each).status for each in guesses} == {401}


BAD_BODIES = [
    "",
    "{",
    "[]",
    "null",
    '"start"',
    "{}",
    '{"id": 1}',
    '{"id": ""}',
    f'{{"id": "{"x" * 65}"}}',
    '{"id": "a", "id": "b"}',
    '{"id": "a", "n": NaN}',
    '{"id": "a", "n": 1e999}',
    '{"id": "a", "n": -Infinity}',
    f'{{"id": "a", "n": {10**20}}}',
    f'{{"id": "a", "n": {"9" * 5000}}}',
    '{"id": "a", "n": ' + "[" * 40 + "]" * 40 + "}",
    '{"id": "a", "n": ' + "[" * 100_000,
    '{"id": "a", "text": "\\ud800"}',
    '{"id": "\\udfff"}',
]


@pytest.mark.parametrize("body", BAD_BODIES, ids=range(len(BAD_BODIES)))
def test_what_makes_no_sense_changes_nothing(body: str) -> None:
    ask = asked()
    for path in ("/api/start", "/api/stop", "/api/plan/example"):
        reply = ask("POST", path, body)
        assert reply.status == 400
        assert said(reply).endswith("nothing was changed")
    assert ask("PUT", "/api/plan", body).status == 400
    assert ask("POST", "/api/start", b'{"id": "\xff"}').status == 400
    assert ask.station.untouched


@pytest.mark.parametrize(
    "body",
    [
        {"missions": []},
        {"revision": True, "missions": []},
        {"revision": "1", "missions": []},
        {"revision": 1.0, "missions": []},
        {"revision": 1},
        {"revision": 1, "missions": {}},
        {"revision": 1, "missions": [], "more": 1},
    ],
)
def test_a_plan_of_another_shape_is_not_taken(body: object) -> None:
    ask = asked()
    assert ask("PUT", "/api/plan", body).status == 400
    assert ask.station.untouched


def test_who_has_drawn_on_an_old_plan_is_given_the_newest() -> None:
    ask = asked()
    assert ask("PUT", "/api/plan", {"revision": 1, "missions": [1]}).status == 200
    reply = ask("PUT", "/api/plan", {"revision": 1, "missions": [2]})
    assert reply.status == 409
    assert json.loads(reply.body) == {"revision": 2, "missions": [1], "problems": []}


def test_a_missions_file_is_taken_in() -> None:
    ask = asked()
    toml = without(content_type="application/toml; charset=utf-8")
    reply = ask("POST", "/api/plan/import", 'name = "é"', toml, revision="1")
    assert json.loads(reply.body)["missions"] == ['name = "é"']
    for body, revision, status in (
        (b"a = \xff", "2", 400),
        (b"nonsense", "2", 400),
        (b"a = 1", "two", 400),
        (b"a = 1", "-2", 400),
        (b"a = 1", "²", 400),
        (b"a = 1", "9" * 5000, 400),
        (b"a = 1", "1", 409),
    ):
        assert ask("POST", "/api/plan/import", body, toml, revision=revision).status == status
    assert ask("POST", "/api/plan/import", "a = 1", OURS, revision="2").status == 415
    assert ask.station.plan.revision == 2


@pytest.mark.parametrize(
    ("file", "told"),
    [
        (None, "missions.toml"),
        (" ", "missions.toml"),
        ("North field.toml", "North field.toml"),
        ("ü 田.toml", "ü 田.toml"),
        ("a\x1b[31m\n\u202eb\ud800.toml", "a\\x1b[31m\\n\\u202eb\\ud800.toml"),
        ("<b>" + 9999 * "x", f"<b>{76 * 'x'}…"),
    ],
)
def test_a_file_that_is_refused_has_its_own_name(file: str | None, told: str) -> None:
    """Another may have chosen it: it is a text, and no long one."""
    ask = asked()
    toml = without(content_type="application/toml")
    query = {} if file is None else {"file": file}
    reply = ask("POST", "/api/plan/import", "nonsense", toml, revision="1", **query)
    assert reply.status == 400
    assert json.loads(reply.body) == {"said": f"{told}:1: expected ="}


def test_what_there_is_can_be_read() -> None:
    ask = asked()
    assert json.loads(ask("GET", "/api/app").body) == {"name": "alfalfa", "role": "fly"}
    assert json.loads(ask("GET", "/api/plan").body)["revision"] == 1
    assert ask("GET", "/api/plan.toml").body == b"[[mission]]\n"
    assert json.loads(ask("GET", "/api/live", flight="a").body) == {"version": 1, "flight": "a"}
    results = json.loads(ask("GET", "/api/results.json").body)
    assert results == [{"value": "nan"}, {"value": [1.5, "inf"]}]
    console = ask("GET", "/api/console.txt")
    assert console.body == b"<script>alert(1)</script>?"
    assert console.type.startswith("text/plain")
    assert ask("HEAD", "/api/app").status == 200


@pytest.mark.parametrize("number", ["", "-1", "1.5", "x", "1" * 400, "٣", "1_0"])
def test_what_was_seen_is_a_number(number: str) -> None:
    ask = asked()
    assert ask("GET", "/api/live", seen=number).status == 400
    assert ask.station.told == 0


TAKEN = {(one.path, one.method) for one in ADDRESSES}


@pytest.mark.parametrize(
    "path", [*sorted({path for path, _ in TAKEN}), "/", "/pages/main.js", "/map", "/nowhere", "*"]
)
@pytest.mark.parametrize(
    "method", ["DELETE", "PATCH", "OPTIONS", "TRACE", "CONNECT", "PROPFIND", "get", "POST", "PUT"]
)
def test_an_address_takes_the_methods_that_it_has(method: str, path: str) -> None:
    ask = asked()
    reply = ask(method, path)
    if (path, method) not in TAKEN:
        assert reply.status in (404, 405)
        assert ("Allow" in dict(reply.headers)) is (reply.status == 405)
    assert ask.station.untouched


def test_a_page_elsewhere_gets_no_leave_to_ask() -> None:
    reply = asked()("OPTIONS", "/api/start", b"", without("x-pluto"))
    assert reply.status == 403
    assert not any(name.lower().startswith("access-control") for name, _ in reply.headers)


def test_of_too_many_commands_some_are_refused_but_never_what_brings_drones_down() -> None:
    ask = asked()
    starts = [ask("POST", "/api/start", {"id": f"{n}"}).status for n in range(50)]
    assert starts == [200] * 20 + [429] * 30
    edits = [ask("POST", "/api/plan/example", {"revision": n + 1}).status for n in range(21)]
    assert edits == [200] * 20 + [429]
    stops = [ask("POST", "/api/stop", {"id": f"{n}"}).status for n in range(50)]
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
    assert (await ask.api.answer(request("POST", "/api/stop", {"id": "s"}))).status == 200
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
    assert "Cross-Origin-Opener-Policy" not in dict(reply.headers)
    assert "X-Frame-Options" in dict(reply.headers)


def test_a_picture_is_asked_for_by_the_number_of_its_result() -> None:
    ask = asked()
    assert ask("GET", "/api/photo", result="1").body == b"whole"
    assert ask("GET", "/api/photo", result="1", size="thumb").body == b"small"
    gone = ask("GET", "/api/photo", result="2")
    assert (gone.status, json.loads(gone.body)) == (404, {"said": "result 2 has no picture"})
    assert ask("GET", "/api/photo", result="x").status == 400
    assert ask("GET", "/api/photo", result="1", size="huge").status == 400
    assert ask("GET", "/api/photo", result="1", flight="f" * 200).status == 400
    assert ask("GET", "/api/results.zip", flight="older").status == 404
    assert ask("GET", "/api/results.csv").type == "text/csv; charset=utf-8"
    assert ask("POST", "/api/photo").status == 405
