"""The station answers all that is asked, and never with a mistake of its own."""

from __future__ import annotations

import asyncio
import json
from pathlib import Path
from tempfile import TemporaryDirectory

from hypothesis import given, settings
from hypothesis import strategies as st

from pluto_fleet.station.config import StationConfig
from pluto_fleet.station.session import Phase
from pluto_fleet.station.station import Station
from pluto_fleet.station.web.addresses import ADDRESSES
from pluto_fleet.station.web.api import Api
from pluto_fleet.station.web.audit import Audit
from pluto_fleet.station.web.guard import Guard
from pluto_fleet.station.web.http import Reply, Request
from tests.library.files.an_app import APP
from tests.library.station.jumping import run
from tests.library.station.plan.drawing import FLEET, a_plan

from .asking import HOST, OURS
from .serving import Served, served, status

METHODS = st.sampled_from(["GET", "HEAD", "POST", "PUT", "DELETE", "OPTIONS", "PATCH", "\x00", ""])
ADDRESS = st.sampled_from(
    [*(one.path for one in ADDRESSES), "/", "/map", "/pages/main.js", "/pages/index.html"]
)
PATHS = st.one_of(
    ADDRESS,
    st.builds(lambda one, other: one + other, ADDRESS, st.text(max_size=8)),
    st.text(max_size=20),
)
JSON = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=8),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=6), inner),
    max_leaves=8,
)
ALMOST = st.fixed_dictionaries(
    {},
    optional={
        "id": st.text(max_size=70) | JSON,
        "revision": st.integers(0, 3) | JSON,
        "missions": st.lists(JSON, max_size=3) | JSON,
        "how": st.sampled_from(["rtl", "land"]) | JSON,
        "mission": JSON,
        "name": st.sampled_from(["A", "../x"]) | JSON,
        "places": st.lists(st.fixed_dictionaries({"name": st.text(max_size=3), "x": JSON})) | JSON,
        "image": JSON,
        "ways": st.lists(st.lists(st.lists(st.floats(0, 20), min_size=2, max_size=3))) | JSON,
        "polygon": JSON,
        "spacing": st.sampled_from([1, "2 m"]) | JSON,
    },
)
BODIES = st.one_of(
    st.binary(max_size=40),
    st.builds(lambda data: json.dumps(data).encode(), JSON | ALMOST),
    st.text(max_size=40).map(lambda text: text.encode("utf-8", "surrogatepass")),
)
NAMES = ["host", "origin", "x-pluto", "content-type", "authorization", "sec-fetch-site"]
VALUES = [
    "",
    HOST,
    f"http://{HOST}",
    "1",
    "application/json",
    "application/toml",
    "null",
    "none",
    "image/png",
]
HEADERS = st.one_of(
    st.just(OURS),
    st.dictionaries(
        st.sampled_from([*NAMES, "if-none-match", "accept-encoding"]) | st.text(max_size=8),
        st.sampled_from([*VALUES, "Bearer sesame", "gzip", "cross-site"]) | st.text(max_size=12),
    ),
    st.builds(
        lambda name, value: {**OURS, name: value}, st.sampled_from(NAMES), st.sampled_from(VALUES)
    ),
)
QUERIES = st.dictionaries(
    st.sampled_from(["flight", "seen", "log", "results", "revision", "token", "name"]),
    st.text(max_size=8) | st.integers(-3, 10**20).map(str),
    max_size=4,
)


@st.composite
def requests(draw: st.DrawFn) -> Request:
    """Draw a request, sound or not."""
    body = draw(BODIES)

    async def read(most: int) -> bytes:
        return body

    return Request(
        method=draw(METHODS),
        path=draw(PATHS),
        query=draw(QUERIES),
        headers=draw(HEADERS),
        read=read,
        client="127.0.0.1",
        local=draw(st.sampled_from(["127.0.0.1", "::1", "", "x"])),
    )


def a_station(folder: Path) -> Station:
    """Return the real one, at which nothing flies."""
    settings = StationConfig(folder=folder, fleet=FLEET, faults={})
    settings.own_folder.mkdir()
    station = Station(APP, settings, a_plan())
    station.begin()
    return station


async def no_pause(_: float) -> None:
    """Let nothing wait."""


def may_command(request: Request) -> bool:
    """Whether a request has all that a command must have."""
    headers = request.headers
    return headers.get("x-pluto") == "1" and headers.get("host") == HOST


@settings(max_examples=25, derandomize=True, deadline=None)
@given(asked=st.lists(requests(), min_size=1, max_size=10), token=st.sampled_from([None, "sesame"]))
def test_no_request_finds_a_mistake_and_what_is_refused_changes_nothing(
    asked: list[Request], token: str | None
) -> None:
    with TemporaryDirectory() as folder:
        station = a_station(Path(folder))
        guard = Guard(host="127.0.0.1", port=8765, token=token)
        api = Api(station, guard, Audit(None), pause=no_pause)

        async def scene() -> None:
            for request in asked:
                before = station.plan.revision, station.map.revision
                if request.path != "/api/start":  # nothing is to fly here
                    reply = await api.answer(request)
                    sound(reply)
                    if not may_command(request) or reply.status != 200:
                        assert (station.plan.revision, station.map.revision) == before

        run(scene())
        assert station.phase is Phase.IDLE


def sound(reply: Reply) -> None:
    """Hold an answer to what every answer is."""
    assert reply.status in {200, 304, 400, 401, 403, 404, 405, 409, 415, 429}
    named = {name.lower() for name, _ in reply.headers}
    assert {"content-security-policy", "x-content-type-options"} <= named
    for _, value in reply.headers:
        assert value.isascii() and value.isprintable()
    if reply.type == "application/json" and reply.body:
        json.loads(reply.body)


LINES = st.sampled_from(
    [
        b"GET / HTTP/1.1\r\n",
        b"POST /api/start HTTP/1.1\r\n",
        b"PUT /api/plan HTTP/1.1\r\n",
        b"GET /api/live HTTP/1.1\r\n",
        b"POST /api/plan/import?revision=1 HTTP/1.0\r\n",
        b"Host: %s\r\n",
        b"Origin: http://%s\r\n",
        b"X-Pluto: 1\r\n",
        b"Content-Type: application/json\r\n",
        b"Content-Length: 11\r\n",
        b"Transfer-Encoding: chunked\r\n",
        b"Upgrade: websocket\r\n",
        b"Connection: upgrade\r\n",
        b"Connection: close\r\n",
        b"Sec-WebSocket-Version: 13\r\n",
        b"Sec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==\r\n",
        b"Expect: 100-continue\r\n",
        b"\r\n",
        b'{"id": "1"}',
        b"b\r\n",
        b"0\r\n\r\n",
        b"\x81\x02{}",
    ]
)
RAW = st.lists(LINES | st.binary(max_size=6), min_size=1, max_size=14).map(b"".join)


@settings(max_examples=8, derandomize=True, deadline=None)
@given(asked=st.lists(RAW, min_size=30, max_size=60))
def test_no_bytes_find_a_mistake(asked: list[bytes]) -> None:
    async def scene(station: Served) -> None:
        host = station.host.encode()
        answers = [station.say(raw.replace(b"%s", host), b"\r\n\r\n\r\n\r\n") for raw in asked]
        for answer in await asyncio.gather(*answers):
            assert not answer or status(answer) < 500
            assert b"Traceback" not in answer

    async def whole() -> None:
        async with served() as station:
            await scene(station)
            await station.stop()

    run(whole())
