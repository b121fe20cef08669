"""A station of a few lines that remembers what was changed, and ways to ask it."""

from __future__ import annotations

import asyncio
import json
from collections.abc import Awaitable, Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, cast

from pluto_fleet.shared.domain.airspace import Airspace
from pluto_fleet.shared.domain.errors import BadInput
from pluto_fleet.station.map.drawn import DrawnMap
from pluto_fleet.station.map.ways import DrawnWays
from pluto_fleet.station.plan.library import PlanLibrary
from pluto_fleet.station.plan.plan import MissionPlan
from pluto_fleet.station.preflight.forecast import without_runs
from pluto_fleet.station.preflight.start import PlannedStart
from pluto_fleet.station.sign import Logo
from pluto_fleet.station.web.api import Api
from pluto_fleet.station.web.audit import Audit
from pluto_fleet.station.web.guard import Guard
from pluto_fleet.station.web.http import Reply, Request
from pluto_fleet.station.wire import Forecast
from pluto_fleet.station.wire_app import AppData
from tests.library.station.jumping import run
from tests.library.station.plan.drawing import a_plan

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


class SomeResults:
    """Results of which some are no numbers, and one picture."""

    async def results(self, flight: str) -> list[object]:
        return [{"value": float("nan")}, {"value": (1.5, float("inf"))}]

    async def csv(self, flight: str) -> str:
        return "number\r\n"

    async def geojson(self, flight: str) -> dict[str, object]:
        return {"type": "FeatureCollection", "features": []}

    async def archive(self, flight: str) -> Path:
        raise BadInput(f"there is no flight '{flight}' here")

    async def picture(self, flight: str, number: int, *, small: bool) -> tuple[bytes, str]:
        if number != 1:
            raise BadInput(f"result {number} has no picture")
        return (b"small" if small else b"whole"), "image/png"


SPACE = Airspace(size=(20.0, 12.0))
NOWHERE = Path("/nowhere")
"""A folder that there is not."""


def _unread(text: str, file: str) -> tuple[int, str]:
    return 0, ""


@dataclass
class ThePast:
    """One flight of the past, which is named `one`."""

    def flights(self) -> object:
        return [{"id": "one"}]

    def hours(self) -> object:
        return [{"id": "cf1"}]

    def replay(self, id: str, start: float, /) -> object:
        return {"flight": self._known(id), "start": start}

    def report(self, id: str, /) -> object:
        return {"flight": self._known(id)}

    def mcap(self, id: str, /) -> bytes:
        return self._known(id).encode()

    def console(self, id: str, /) -> str:
        return self._known(id)

    def results(self, id: str, /) -> object:
        return [self._known(id)]

    def _known(self, id: str) -> str:
        if id != "one":
            raise BadInput(f"there is no flight {id!r} here")
        return id


@dataclass
class AStation:
    """A station at which everything can be done, or goes wrong."""

    plan: MissionPlan = field(default_factory=a_plan)
    past: ThePast = field(default_factory=ThePast)
    map: DrawnMap = field(default_factory=lambda: DrawnMap(SPACE, NOWHERE / "map.toml"))
    ways: DrawnWays = field(default_factory=lambda: DrawnWays(SPACE))
    library: PlanLibrary = field(default_factory=lambda: PlanLibrary(NOWHERE / "plans", _unread))
    image: Path | None = None
    done: list[tuple[str, Mapping[str, object]]] = field(default_factory=list)
    wrong: Exception | None = None
    told: int = 0
    busy: Callable[[], Awaitable[object]] | None = None

    @property
    def described(self) -> AppData:
        return cast(AppData, {"name": "alfalfa"})

    async def edit(self, revision: int, missions: object, /) -> None:
        self.plan.replace(revision, missions)

    async def command(self, name: str, id: str, given: Mapping[str, object], by: str, /) -> str:
        if self.wrong is not None:
            raise self.wrong
        if self.busy is not None and name not in ("stop", "cut-motors"):
            await self.busy()
        self.done.append((name, given))
        return f"{name} is done"

    async def newer(self, flight: str, seen: int, log: int, results: int) -> str:
        if self.wrong is not None:
            raise self.wrong
        if self.busy is not None:
            await self.busy()
        self.told += 1
        return json.dumps({"version": self.told, "flight": flight})

    async def forecast(self, asked: PlannedStart, /) -> Forecast:
        if self.wrong is not None:
            raise self.wrong
        if self.busy is not None:
            await self.busy()
        return without_runs(None, asked.revision, [])

    def console(self) -> str:
        return "<script>alert(1)</script>\ud800"

    @property
    def exports(self) -> SomeResults:
        return SomeResults()

    @property
    def untouched(self) -> bool:
        """Whether nothing has been changed."""
        return not self.done and self.plan.revision == 1


@dataclass
class Asked:
    """A station, what serves it, and a clock that goes on only when told."""

    station: AStation
    api: Api
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

    async def read(most: int) -> bytes:
        assert isinstance(body, bytes)
        return body

    return Request(
        method=method,
        path=path,
        query=query,
        headers=OURS if headers is None else headers,
        read=read,
        client="127.0.0.1",
        local="127.0.0.1",
    )


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
    return Asked(station, api, times, paused)


def said(reply: Reply) -> str:
    """Return the sentence in an answer."""
    found = json.loads(reply.body)["said"]
    assert isinstance(found, str)
    return found


def without(*names: str, **other: str) -> dict[str, str]:
    """Return a page's headers but for these, and with those."""
    kept = {name: value for name, value in OURS.items() if name not in names}
    return {**kept, **{name.replace("_", "-"): value for name, value in other.items()}}
