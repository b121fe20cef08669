"""A station behind the real web server, in the same loop as the client that asks it byte by byte."""

from __future__ import annotations

import asyncio
import json
from collections.abc import AsyncIterator, Callable, Coroutine, Mapping
from contextlib import asynccontextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from websockets.typing import Origin

from pluto_fleet.station.web.api import Api
from pluto_fleet.station.web.audit import Audit
from pluto_fleet.station.web.guard import Guard
from pluto_fleet.station.web.listening import listening, port_of
from pluto_fleet.station.web.server import serve
from tests.library.station.jumping import run

from .asking import AStation


@dataclass
class Served:
    """A station that is being served."""

    station: AStation
    port: int
    token: str | None = None

    @property
    def host(self) -> str:
        return f"127.0.0.1:{self.port}"

    @property
    def origin(self) -> Origin:
        """The site of the station's own pages."""
        return Origin(f"http://{self.host}")

    @property
    def headers(self) -> dict[str, str]:
        """What a page of the station's own sends."""
        return {
            "Host": self.host,
            "Origin": self.origin,
            "X-Pluto": "1",
            "Content-Type": "application/json",
            "Connection": "close",
            **({} if self.token is None else {"Authorization": f"Bearer {self.token}"}),
        }

    def request(
        self,
        method: str,
        path: str,
        body: object = None,
        headers: Mapping[str, str] | None = None,
        **other: str,
    ) -> bytes:
        """Return the bytes of a request; names of headers have _ for -."""
        content = b"" if body is None else json.dumps(body).encode()
        named = {name.replace("_", "-"): value for name, value in other.items()}
        sent = {**(self.headers if headers is None else headers), **named}
        if content:
            sent.setdefault("Content-Length", str(len(content)))
        lines = [f"{method} {path} HTTP/1.1", *(f"{name}: {text}" for name, text in sent.items())]
        return "\r\n".join([*lines, "", ""]).encode() + content

    async def say(self, *parts: bytes) -> bytes:
        """Send bytes and return all that comes back, until the server hangs up."""
        reader, writer = await asyncio.open_connection("127.0.0.1", self.port)
        try:
            with suppress(ConnectionError):
                for part in parts:
                    writer.write(part)
                    await writer.drain()
            return await all_of(reader)
        finally:
            writer.close()

    async def stop(self) -> None:
        """Press Stop, and see that it is taken."""
        answer = await self.say(self.request("POST", "/api/stop", {"id": "stop", "how": "land"}))
        assert status(answer) == 200


async def all_of(reader: asyncio.StreamReader) -> bytes:
    """Read until the other side hangs up, as it must."""
    found = b""
    async with asyncio.timeout(600):
        with suppress(ConnectionError):
            while part := await reader.read(65536):
                found += part
    return found


def status(answer: bytes) -> int:
    """Return the status of an answer."""
    return int(answer.split(b" ", 2)[1])


@asynccontextmanager
async def hosted(api: Callable[[Guard], Api], **guard: Any) -> AsyncIterator[Guard]:
    """Serve what a guard lets in on a port that is free."""
    with listening("127.0.0.1", 0) as listener:
        guarded = Guard(host="127.0.0.1", port=port_of(listener), **guard)
        ready = asyncio.Event()
        serving = asyncio.create_task(serve(api(guarded), listener, ready.set))
        try:
            await ready.wait()
            yield guarded
        finally:
            serving.cancel()
            with suppress(asyncio.CancelledError):
                await serving


@asynccontextmanager
async def served(
    file: Path | None = None, *, station: AStation | None = None, **guard: Any
) -> AsyncIterator[Served]:
    """Serve a station that remembers what it is told."""
    station = station or AStation()
    async with hosted(lambda guard: Api(station, guard, Audit(file)), **guard) as guarded:
        yield Served(station, guarded.port, guarded.token)


Scene = Callable[[Served], Coroutine[object, object, None]]


def play(scene: Scene, file: Path | None = None, **served_with: Any) -> None:
    """Serve a station for a scene, at whose end a Stop is still taken."""

    async def whole() -> None:
        async with served(file, **served_with) as station:
            await scene(station)
            await station.stop()

    run(whole())
