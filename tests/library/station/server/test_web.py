"""The real web server: what is sent byte by byte, slowly, too much of it, or not to its end."""

from __future__ import annotations

import asyncio
import json
import socket
import sys
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from websockets.asyncio.client import connect
from websockets.exceptions import ConnectionClosed

from pluto_fleet.cli.serve import serve
from pluto_fleet.shared.connections import CONNECTIONS
from pluto_fleet.shared.domain.errors import BadInput
from pluto_fleet.station.map.pictures import LARGEST
from pluto_fleet.station.web.guard import Guard
from pluto_fleet.station.web.listening import address, listening, port_of
from tests.library.files.an_app import APP
from tests.library.station.jumping import run
from tests.library.station.map.test_drawn import ward

from .asking import SEEN, AStation
from .serving import Served, play, served, status

LARGE = b"x" * (1024 * 1024 + 1)
CHUNK = b"%x\r\n" % 65536 + b"x" * 65536 + b"\r\n"


def test_a_body_that_is_too_long_is_not_read() -> None:
    async def scene(station: Served) -> None:
        plan = station.request("PUT", "/api/plan", Content_Length=str(len(LARGE)))
        assert status(await station.say(plan)) == 413
        assert status(await station.say(plan, LARGE)) == 413
        endless = station.request("PUT", "/api/plan", Transfer_Encoding="chunked")
        assert status(await station.say(endless, *[CHUNK] * 40)) == 413
        start = station.request("POST", "/api/start", Content_Length=str(len(LARGE) - 1))
        body = b'{"id": "1"}' + b" " * (len(LARGE) - 1 - 11)
        assert status(await station.say(start, body)) == 200
        station.station.done.clear()
        huge = station.request("PUT", "/api/plan", Content_Length="9" * 19)
        assert status(await station.say(huge)) in (400, 413)
        assert station.station.untouched

    play(scene)


def test_a_floor_plan_may_be_larger_than_other_bodies(tmp_path: Path) -> None:
    """Up to its own limit, beyond which nothing is read."""
    png = b"\x89PNG\r\n\x1a\n" + b"x" * (2 << 20)

    async def scene() -> None:
        station = AStation()
        station.map = ward(tmp_path)
        async with served(station=station) as there:
            for length, sent, answer in ((len(png), png, 200), (LARGEST + 1, b"", 413)):
                about: Any = {"Content_Length": str(length), "Content_Type": "image/png"}
                head = there.request("PUT", "/api/map/image?revision=0", **about)
                assert status(await there.say(head, sent)) == answer
        assert station.map.image is not None and station.map.image.read_bytes() == png

    run(scene())


def test_what_is_said_twice_counts_for_nothing_and_no_proxy_is_believed(tmp_path: Path) -> None:
    """A proxy may believe the other length: what follows could be another's request."""

    async def scene(station: Served) -> None:
        start = station.request("POST", "/api/start", {"id": "1"})
        twice = start.replace(b"X-Pluto", b"Origin: http://evil.example\r\nX-Pluto")
        assert status(await station.say(twice)) == 403
        bad = station.request("POST", "/api/start", {"id": "1"}, Origin="http://evil.example")
        bad = bad.replace(b"close", b"keep-alive")
        answer = await station.say(bad + station.request("GET", "/nowhere"))
        assert answer.count(b"HTTP/1.1 403") == 1 and answer.count(b"HTTP/1.1 404") == 1
        for method, path in (("POST", "/api/start"), ("GET", "/api/app")):
            both = station.request(
                method,
                path,
                Connection="keep-alive",
                Content_Length="4",
                Transfer_Encoding="chunked",
            )
            answer = await station.say(both + b"0\r\n\r\n" + start)
            assert status(answer) == 400 and answer.count(b"HTTP/1.1") == 1
            assert b"says its length once" in answer
        assert station.station.untouched
        proxied = station.request("POST", "/api/start", {"id": "1"}, X_Forwarded_For="6.6.6.6")
        assert status(await station.say(proxied)) == 200

    play(scene, tmp_path / "audit.log")
    assert "6.6.6.6" not in (tmp_path / "audit.log").read_text()


def test_what_does_not_come_is_not_waited_for_nor_who_does_not_read() -> None:
    """Neither a head nor a body; and an answer that is not made in time is given up."""

    async def scene(station: Served) -> None:
        assert await station.say(b"") == b""
        assert await station.say(b"GET / HTTP/1.1\r\nHost: ") == b""
        start = station.request("POST", "/api/start", Content_Length="11")
        assert status(await station.say(start, b'{"id"')) == 408
        kept = station.request("GET", "/", Connection="keep-alive")
        assert status(await station.say(kept, b"GET")) == 200
        assert station.station.untouched
        station.station.busy = asyncio.Event().wait
        asks = station.request("POST", "/api/start", {"id": "1"})
        assert await station.say(asks) == b""

    play(scene)


def test_strangers_keep_out_no_client_with_the_token() -> None:
    """Those who say nothing, nor those who guess and do not read what they are answered."""

    async def scene(station: Served) -> None:
        bearer = {"Authorization": "Bearer sesame", "Connection": "keep-alive"}
        reader, writer = await asyncio.open_connection("127.0.0.1", station.port)
        app = station.request("GET", "/api/app", None, {**station.headers, **bearer})
        writer.write(app)
        assert b"200 OK" in await reader.readline()
        guess = {**station.headers, "Authorization": "Bearer guess"}
        strangers = []
        for number in range(CONNECTIONS + 20):
            strangers.append(await asyncio.open_connection("127.0.0.1", station.port))
            if number % 2:
                strangers[-1][1].write(station.request("GET", "/api/app", None, guess))
        writer.write(app)
        while b"200 OK" not in (line := await reader.readline()):
            assert line, "the connection with the token was closed"
        await station.stop()
        for _, each in (*strangers, (reader, writer)):
            each.close()

    play(scene, token="sesame")


def test_a_page_stays_connected() -> None:
    async def scene(station: Served) -> None:
        where = f"ws://{station.host}/api/live"
        async with connect(where, origin=station.origin) as page:
            for n in (1, 2, 3):
                await page.send(json.dumps(SEEN))
                assert json.loads(await page.recv())["version"] == n
            await page.send(b"\x00\x01")
            with pytest.raises(ConnectionClosed) as closed:
                await page.recv()
            assert closed.value.rcvd is not None and closed.value.rcvd.code == 4400
        async with connect(where, origin=station.origin) as page:
            await page.send("x" * 70_000)
            with pytest.raises(ConnectionClosed) as closed:
                await page.recv()
            assert closed.value.rcvd is not None and closed.value.rcvd.code == 1009

    play(scene)


async def test_it_ends_at_once_with_clients_connected() -> None:
    async with served() as station:

        async def endless() -> None:
            await asyncio.Event().wait()

        station.station.busy = endless
        where = f"ws://{station.host}/api/live"
        page = await connect(where, origin=station.origin)
        await page.send(json.dumps(SEEN))
        start = station.request("POST", "/api/start", {"id": "1"})
        waits = asyncio.create_task(station.say(start))
    async with asyncio.timeout(60):
        with pytest.raises(ConnectionClosed) as closed:
            await page.recv()
        assert closed.value.rcvd is not None and closed.value.rcvd.code == 1012
        await waits


def test_a_port_is_taken_once_and_free_again_at_once() -> None:
    taken = pytest.raises(BadInput, match="is taken, perhaps by another station")
    with listening("127.0.0.1", 0) as first:
        assert first.proto == socket.IPPROTO_TCP  # else asyncio lets each answer wait for 40 ms
        port = port_of(first)
        with taken:
            listening("127.0.0.1", port)
        with socket.create_connection(("127.0.0.1", port)):
            pass
    listening("127.0.0.1", port).close()


@pytest.mark.parametrize(
    ("host", "port", "why"),
    [
        ("192.0.2.1", 0, "no such address"),
        ("127.0.0.1", -1, "--port -1"),
        ("127.0.0.1", 70_000, "--port 70000"),
        ("\x00", 0, "no such address"),
    ],
)
def test_where_it_cannot_listen_is_said_in_words(host: str, port: int, why: str) -> None:
    with pytest.raises(BadInput, match=why):
        listening(host, port)


def test_the_address_is_what_one_types() -> None:
    assert address(Guard(host="127.0.0.1", port=8765), None) == "http://127.0.0.1:8765/"
    assert address(Guard(host="::1", port=80), "a") == "http://[::1]:80/#token=a"
    named = Guard(host="127.0.0.1", port=1, names=("ward.example",))
    assert address(named, "a") == "http://127.0.0.1:1/#token=a"
    assert "0.0.0.0" not in address(Guard(host="0.0.0.0", port=8765), "a")


def test_without_the_extra_it_says_how_to_come_by_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delitem(sys.modules, "pluto_fleet.station.web.server")
    monkeypatch.setitem(sys.modules, "uvicorn", None)
    options: Any = SimpleNamespace(refuse_what_is_simulated=lambda: None)
    with pytest.raises(BadInput, match=r"pip install 'alfalfa\[station\]'"):
        serve(APP, options)
