"""A line for each command, taken or refused."""

from __future__ import annotations

import json
from pathlib import Path

from starlette.requests import HTTPConnection

from pluto_fleet.station.web.audit import Audit

from .asking import OURS, asked, request, without


def lines(file: Path) -> list[dict[str, object]]:
    return [json.loads(line) for line in file.read_text().splitlines()]


def test_what_was_done_and_what_was_refused_stands_there(tmp_path: Path) -> None:
    file = tmp_path / "audit.log"
    ask = asked(file=file)
    ask("POST", "/api/decide", {"id": "one", "mission": "<b>\u2028North", "answer": "done"})
    ask("POST", "/api/start", {"id": "two"}, without(origin="http://evil.example"))
    ask("POST", "/api/plan/example", {"revision": 9})
    ask("GET", "/pages/../secret")
    ask("GET", "/api/plan")
    done, refused, stale, nowhere = lines(file)
    assert done == {
        "time": "1970-01-01T00:00:00Z",
        "client": "127.0.0.1",
        "do": "/api/decide",
        "given": {"id": "one", "mission": "<b>\u2028North", "answer": "done"},
        "status": 200,
        "said": "decide is done",
    }
    assert refused["refused"] == "POST /api/start"
    assert (refused["origin"], refused["status"]) == ("http://evil.example", 403)
    assert (stale["do"], stale["status"]) == ("/api/plan/example", 409)
    assert (nowhere["refused"], nowhere["status"]) == ("GET /pages/../secret", 404)


def test_who_gave_a_command_stands_there_by_their_own_account(tmp_path: Path) -> None:
    file = tmp_path / "audit.log"
    ask = asked(file=file)
    for name in ("Z%C3%BCbeyde", "a%0A%1B[31m", "x" * 9_999, "%ff", ""):
        ask("POST", "/api/pause", {"id": "one"}, {**OURS, "x-pluto-who": name})
    assert [line.get("by") for line in lines(file)] == [
        *("Zübeyde", "a\\n\\x1b[31m", f"{39 * 'x'}…", "\ufffd", None)
    ]


def test_its_owner_alone_reads_it_and_no_token_stands_there(tmp_path: Path) -> None:
    file = tmp_path / "audit.log"
    ask = asked(file=file, token="sesame")
    ask("POST", "/api/start", {"id": "one"}, without(authorization="Bearer sesame"))
    ask("POST", "/api/start", {"id": "two"}, without(authorization="Bearer guess"))
    assert file.stat().st_mode & 0o777 == 0o600
    assert "sesame" not in file.read_text() and "guess" not in file.read_text()


def test_what_is_long_is_cut(tmp_path: Path) -> None:
    file = tmp_path / "audit.log"
    deep: object = []
    for _ in range(20):
        deep = [deep]
    given: dict[str, object] = {f"key {n}": n for n in range(1000)}
    given |= {"id": "one", "text": "x" * 10_000, "list": list(range(1000)), "deep": {"a": deep}}
    asked(file=file)("POST", "/api/start", given)
    assert file.stat().st_size < 2000
    assert len(lines(file)) == 1


def test_a_stranger_does_not_push_out_what_was_done(tmp_path: Path) -> None:
    file = tmp_path / "audit.log"
    ask = asked(file=file)
    for _ in range(100):
        ask("GET", "/nowhere")
    assert len(lines(file)) == 20
    ask.times.append(1.0)
    ask("GET", "/nowhere")
    assert lines(file)[20] == {
        "time": "1970-01-01T00:00:00Z",
        "refused too, without a line": 80,
    }


def test_it_grows_no_further_than_twice_its_size(tmp_path: Path) -> None:
    file = tmp_path / "audit.log"
    file.write_bytes(b"x" * (4 * 1024 * 1024))
    for n in range(2):
        asked = HTTPConnection(request("POST", f"/{n}").scope("http"))
        Audit(file, now=lambda: 0.0).done(asked, {}, 200, "")
    assert len(lines(file)) == 2
    assert sorted(each.name for each in tmp_path.iterdir()) == ["audit.log", "audit.log.1"]


def test_where_nothing_can_be_written_a_stop_is_done_all_the_same(tmp_path: Path) -> None:
    (tmp_path / "linked").symlink_to(tmp_path / "elsewhere")
    for file in (Path("/dev/full"), tmp_path, tmp_path / "no" / "audit.log", tmp_path / "linked"):
        ask = asked(file=file)
        assert ask("POST", "/api/stop", {"id": "one", "how": "rtl"}).status == 200
        assert ask.station.done == [("stop", {"how": "rtl"})]
    assert not (tmp_path / "elsewhere").exists()
