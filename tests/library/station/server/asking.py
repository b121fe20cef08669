"""A station of a few lines that remembers what was changed, and ways to ask it."""

from __future__ import annotations

import asyncio
import json
from collections.abc import Awaitable, Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, cast
from urllib.parse import urlencode

from pluto_fleet.app import App
from pluto_fleet.process.apart import Answers
from pluto_fleet.station.config import StationConfig
from pluto_fleet.station.flight_files import FlightFiles
from pluto_fleet.station.map.pictures import Logo
from pluto_fleet.station.plan.plan import MissionPlan
from pluto_fleet.station.preflight.forecast import without_runs
from pluto_fleet.station.preflight.preflight import PlannedStart
from pluto_fleet.station.station import Station
from pluto_fleet.station.web.api import Api
from pluto_fleet.station.web.audit import Audit
from pluto_fleet.station.web.guard import Guard
from pluto_fleet.station.wire import Forecast
from pluto_fleet.station.wire_app import AppData
from tests.library.files.an_app import APP
from tests.library.station.in_threads import InThreads
from tests.library.station.jumping import run
from tests.library.station.plan.drawing import FLEET

HOST = "127.0.0.1:8765"
OURS = {
    "host": HOST,
    "origin": f"http://{HOST}",
    "sec-fetch-site": "same-origin",
    "x-pluto": "1",
    "content-type": "application/json",
}
"""What a page of the station's own sends."""
SEEN = {"flight": "", "seen": 0, "log": 0, "results": 0}


NOWHERE = StationConfig(folder=Path("/nowhere"), fleet=FLEET, faults={})
"""A station's folder that there is not."""


class AStation(Station):
    """A station at which every command can be given, and is remembered; or all goes wrong."""

    def __init__(
        self,
        app: App = APP,
        config: StationConfig = NOWHERE,
        *,
        wrong: Exception | None = None,
        busy: Callable[[], Awaitable[object]] | None = None,
        files: Answers[FlightFiles] | None = None,
    ) -> None:
        plan = MissionPlan(app, config.fleet, None, now=lambda: 0.0)
        super().__init__(app, config, plan, files or InThreads(app, config))
        self.described = cast(AppData, {"name": "alfalfa"})
        self.wrong, self.busy, self.told = wrong, busy, 0
        self.done: list[tuple[str, Mapping[str, object]]] = []

    async def _meanwhile(self) -> None:
        if self.wrong is not None:
            raise self.wrong
        if self.busy is not None:
            await self.busy()

    async def command(self, name: str, id: str, given: Mapping[str, object], by: str = "") -> str:
        if name not in ("stop", "cut-motors"):
            await self._meanwhile()
        self.done.append((name, given))
        return f"{name} is done"

    async def newer(self, flight: str, seen: int, log: int, results: int) -> str:
        await self._meanwhile()
        self.told += 1
        return json.dumps({"version": self.told, "flight": flight})

    async def forecast(self, asked: PlannedStart) -> Forecast:
        await self._meanwhile()
        return without_runs(asked.revision, [])

    @property
    def untouched(self) -> bool:
        """Whether nothing has been changed."""
        return not self.done and self.plan.revision == 1


@dataclass(frozen=True, slots=True, kw_only=True)
class Request:
    """A request, as a web server would hand it on."""

    method: str
    path: str
    query: Mapping[str, str]
    headers: Mapping[str, str]
    body: bytes
    client: str = "127.0.0.1"
    local: str = "127.0.0.1"
    gone: Callable[[], Awaitable[object]] | None = None
    """Waits until the client goes away; None: it stays."""

    def scope(self, kind: str) -> dict[str, Any]:
        """Return what ASGI says of it."""
        headers = [(name.encode(), text.encode("latin-1")) for name, text in self.headers.items()]
        return {
            "type": kind,
            "asgi": {"version": "3.0", "spec_version": "2.4"},
            "method": self.method,
            "path": self.path,
            "query_string": urlencode(self.query).encode(),
            "headers": headers,
            "client": (self.client, 1),
            "server": (self.local, 1),
            "extensions": {"http.response.pathsend": {}},
        }


@dataclass(frozen=True, slots=True, kw_only=True)
class Reply:
    """An answer."""

    status: int
    body: bytes
    headers: tuple[tuple[str, str], ...]

    @property
    def type(self) -> str:
        """Its media type."""
        return next((text for name, text in self.headers if name == "content-type"), "")

    def header(self, name: str) -> str:
        """Return one of its headers."""
        return dict(self.headers)[name]


class Asgi:
    """What serves a station, asked without a web server."""

    def __init__(self, api: Api) -> None:
        self._api = api
        self.end = api.end

    async def answer(self, request: Request) -> Reply:
        """Ask this, and return the answer."""
        begun: dict[str, Any] = {}
        body = bytearray()
        parts = [{"type": "http.request", "body": request.body}]

        async def receive() -> dict[str, Any]:
            if parts:
                return parts.pop()
            await (request.gone or asyncio.Event().wait)()
            return {"type": "http.disconnect"}

        async def send(message: Any) -> None:
            if message["type"] == "http.response.start":
                begun.update(message)
            elif message["type"] == "http.response.pathsend":
                body.extend(Path(message["path"]).read_bytes())
            else:
                body.extend(message["body"])

        await self._api(request.scope("http"), receive, send)
        headers = tuple((name.decode(), text.decode("latin-1")) for name, text in begun["headers"])
        return Reply(status=begun["status"], body=bytes(body), headers=headers)

    async def live(self, line: ALine, request: Request) -> None:
        """Let a page connect."""
        await self._api(request.scope("websocket"), line.receive, line.send)


class ALine:
    """A page that says these things over a WebSocket, and then hangs up, or waits for ever."""

    def __init__(self, *says: object, stays: bool = False) -> None:
        self.says = [each if isinstance(each, str) else json.dumps(each) for each in says]
        self.stays = stays
        self.opened = False
        self.heard: list[str] = []
        self.closed: int | None = None
        self._connects = True

    @property
    def refused(self) -> bool:
        """Whether it was not let in at all."""
        return self.closed is not None and not self.opened

    async def receive(self) -> dict[str, Any]:
        """Say the next."""
        if self._connects:
            self._connects = False
            return {"type": "websocket.connect"}
        if not self.says and self.stays:
            await asyncio.Event().wait()
        if not self.says:
            return {"type": "websocket.disconnect", "code": 1005}
        return {"type": "websocket.receive", "text": self.says.pop(0)}

    async def send(self, message: Any) -> None:
        """Hear something."""
        if message["type"] == "websocket.accept":
            self.opened = True
        elif message["type"] == "websocket.send":
            self.heard.append(message["text"])
        else:
            self.closed = message.get("code", 1000)


@dataclass
class Asked:
    """A station, what serves it, and a clock that goes on only when told."""

    station: AStation
    api: Asgi
    times: list[float]
    paused: list[float]

    def __call__(
        self,
        method: str,
        path: str,
        body: bytes | str | object = b"",
        headers: Mapping[str, str] | None = None,
        **query: str,
    ) -> Reply:
        """Ask this, as a page of the station's own does, and return the answer."""
        return run(self.api.answer(request(method, path, body, headers, **query)))


def request(
    method: str,
    path: str,
    body: bytes | str | object = b"",
    headers: Mapping[str, str] | None = None,
    **query: str,
) -> Request:
    """Return what a page of the station's own asks, or a program that sends these headers."""
    if not isinstance(body, bytes):
        body = (body if isinstance(body, str) else json.dumps(body)).encode()

    sent = OURS if headers is None else headers
    return Request(method=method, path=path, query=query, headers=sent, body=body)


def asked(
    station: AStation | None = None,
    file: Path | None = None,
    logo: Logo | None = None,
    gate: asyncio.Event | None = None,
    **guard: Any,
) -> Asked:
    """Serve a station without a web server; who guesses a token waits at the gate."""
    station = station or AStation()
    times, paused = [0.0], list[float]()

    async def pause(seconds: float) -> None:
        paused.append(seconds)
        if gate is not None:
            await gate.wait()

    def clock() -> float:
        return times[-1]

    api = Api(
        station,
        Guard(**{"host": "127.0.0.1", "port": 8765, **guard}),
        Audit(file, now=lambda: 0.0, clock=clock),
        clock=clock,
        pause=pause,
        logo=logo,
    )
    return Asked(station, Asgi(api), times, paused)


def said(reply: Reply) -> str:
    """Return the sentence in an answer."""
    found = json.loads(reply.body)["said"]
    assert isinstance(found, str)
    return found


def without(*names: str, **other: str) -> dict[str, str]:
    """Return a page's headers but for these, and with those."""
    kept = {name: value for name, value in OURS.items() if name not in names}
    return {**kept, **{name.replace("_", "-"): value for name, value in other.items()}}
