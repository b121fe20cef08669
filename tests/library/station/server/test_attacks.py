"""Those who have no token, or send what is two things at once, keep no one out who has one."""

from __future__ import annotations

import asyncio
import json

import pytest
from websockets.asyncio.client import connect

from pluto_fleet.station.requests import Said
from pluto_fleet.station.web import server
from pluto_fleet.station.web.addresses import ADDRESSES, LARGE_BODY, Address
from pluto_fleet.station.web.api import Api
from pluto_fleet.station.web.http import Reply, said
from pluto_fleet.station.web.served import Asked

from .asking import SEEN
from .serving import Served, play, status


@pytest.mark.parametrize("method", ["GET", "POST"])
def test_a_request_with_two_lengths_ends_its_connection(method: str) -> None:
    """A proxy may believe the other one: what follows could be another's request."""

    async def scene(station: Served) -> None:
        both = station.request(
            method,
            "/api/start" if method == "POST" else "/api/app",
            Content_Length="4",
            Transfer_Encoding="chunked",
            Connection="keep-alive",
        )
        stop = station.request("POST", "/api/stop", {"id": "s", "how": "land"})
        answer = await station.say(both + b"0\r\n\r\n" + stop)
        assert status(answer) == 400 and answer.count(b"HTTP/1.1") == 1
        assert b"says its length once" in answer
        assert station.station.untouched

    play(scene)


def test_strangers_who_are_answered_keep_out_no_client_with_the_token(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Nor do those who ask again and again, nor those who do not read what they are answered."""
    monkeypatch.setattr(server, "_CONNECTIONS", 16)
    monkeypatch.setattr(Api, "_slow_down", lambda _: asyncio.Event().wait())

    async def scene(station: Served) -> None:
        bearer = {"Authorization": "Bearer sesame", "Connection": "keep-alive"}
        owner = await asyncio.open_connection("127.0.0.1", station.port)
        app = station.request("GET", "/api/app", None, {**station.headers, **bearer})
        owner[1].write(app)
        assert b"200 OK" in await owner[0].readline()
        strangers = [await asyncio.open_connection("127.0.0.1", station.port) for _ in range(40)]
        for _, writer in strangers:
            guess = {**station.headers, "Authorization": "Bearer guess"}
            writer.write(station.request("GET", "/api/app", None, guess))
        for reader, _ in strangers[:20]:
            assert b"401" not in await reader.read()
        owner[1].write(app)
        while b"200 OK" not in (line := await owner[0].readline()):
            assert line, "the connection with the token was closed"
        for _, writer in (owner, *strangers):
            writer.close()

    play(scene, token="sesame")


def test_a_body_is_large_only_where_an_address_says_so() -> None:
    body = b"x" * (3 * 1024 * 1024)
    sizes: list[int] = []

    async def keep(asked: Asked) -> Reply:
        sizes.append(len(asked.body))
        return said(200, "kept")

    picture = Address(
        method="PUT",
        path="/api/picture",
        says="",
        answers=Said,
        body=("image/png",),
        most_bytes=LARGE_BODY,
        do=keep,
    )

    async def scene(station: Served) -> None:
        for path, much, expected in (
            ("/api/picture", len(body), 200),
            ("/api/picture", LARGE_BODY + 1, 413),
            ("/api/plan/import", len(body), 413),
        ):
            kind = "image/png" if path == "/api/picture" else "application/toml"
            asked = station.request("PUT", path, Content_Length=str(much), Content_Type=kind)
            if path == "/api/plan/import":
                asked = asked.replace(b"PUT", b"POST")
            assert status(await station.say(asked, body)) == expected
        assert sizes == [len(body)]

    play(scene, addresses=(*ADDRESSES, picture))


def test_tabs_without_the_token_that_say_nothing_keep_out_no_page_with_it() -> None:
    async def scene(station: Served) -> None:
        where = f"ws://{station.host}/api/live"
        silent = [await connect(where, origin=station.origin) for _ in range(40)]
        async with connect(where, origin=station.origin) as page:
            await page.send(json.dumps({**SEEN, "token": "sesame"}))
            assert json.loads(await page.recv())["version"] == 1
        for each in silent:
            await each.close()

    play(scene, token="sesame")
