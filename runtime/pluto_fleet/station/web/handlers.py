"""What is done at each address: a function of its name, with its checked parameters.

`BadInput` is answered as a sentence, and `Stale` with the newest of what was to be changed. A change
is answered with that, too.
"""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable, Mapping
from contextlib import suppress
from dataclasses import dataclass
from operator import methodcaller
from pathlib import Path
from typing import TYPE_CHECKING, Any

from starlette.requests import Request
from starlette.responses import FileResponse, Response

from ...files.reading import decoded
from ...shared.domain.errors import BadInput
from ...shared.domain.text import cut_off, printable
from ..flight_files import FlightFiles
from ..interface import Interface
from ..operation import JSON, Operation, operations_of
from ..preflight.preflight import PlannedStart
from ..results.exports import Exports, json_text
from ..wire import MapData, Role, SavedPlans
from ..wire_app import PlanData
from .audit import who

if TYPE_CHECKING:
    from starlette.types import Receive, Scope, Send

    from ..history.past import PastFlights
    from ..station import Station

DESCRIPTION = Path(__file__).parent.parent / "openapi.json"
"""The description of the interface, which is made of its declaration."""
MISSIONS_FILE = "missions.toml"
_DRAWING = "the drawing"
_LONGEST_NAME = 80


@dataclass(frozen=True, slots=True, kw_only=True)
class Asked:
    """A request that was let in."""

    station: Station
    request: Request
    operation: Operation
    role: Role
    given: Mapping[str, Any]
    """What was sent, without what is supposed of the rest."""
    body: bytes = b""


Handler = Callable[..., Awaitable[Response | str | None]]
"""It is given what is `Asked`, and the parameters of its operation by their names; a text is a sentence."""


def json_reply(data: object, status: int = 200) -> Response:
    """Answer with data as JSON; numbers that JSON lacks become texts."""
    return Response(json_text(data).encode("ascii"), status, media_type=JSON)


def said(text: str, status: int = 200) -> Response:
    """Answer with a sentence."""
    return json_reply({"said": text}, status)


async def app(asked: Asked) -> Response:
    """Answer with app and fleet, and with the role of who asks."""
    return json_reply({**asked.station.described, "role": asked.role})


async def description(_: Asked) -> Response:
    """Answer with the description of this interface."""
    return Response(DESCRIPTION.read_bytes(), media_type=JSON)


async def command(asked: Asked, id: str, **given: Any) -> str:
    """Carry out the command that the address names."""
    name = asked.operation.name.replace("_", "-")
    return await asked.station.command(name, id, given, who(asked.request))


# The plan


async def plan(asked: Asked) -> Response:
    """Answer with the plan, once all its problems are known."""
    await asked.station.plan.examined()
    return json_reply(asked.station.plan.data())


async def plan_file(asked: Asked) -> Response:
    """Answer with the plan as a missions file."""
    return _text(asked, asked.station.plan.export_toml(), MISSIONS_FILE)


async def replace_plan(asked: Asked, revision: int, missions: object) -> None:
    """Replace the plan's missions."""
    await asked.station.changes.edit(revision, missions)


async def import_plan(asked: Asked, revision: int, file: str) -> None:
    """Replace the plan's missions by those of a file, whose name is not trusted."""
    name = cut_off(printable(file.strip()), _LONGEST_NAME) or MISSIONS_FILE
    await asked.station.plan.import_file(decoded(asked.body, name), revision, name)


async def add_example(asked: Asked, revision: int) -> None:
    """Add an example to the plan."""
    asked.station.plan.example(revision)


async def saved_plans(asked: Asked) -> Response:
    """Answer with all plans that are kept."""
    return json_reply(await _kept(asked, asked.station.library.everything))


async def save_plan(asked: Asked, name: str, **how: Any) -> None:
    """Keep the plan under a name."""
    text = asked.station.plan.export_toml()
    await _kept(asked, lambda: asked.station.library.save(name, text, **how))


async def delete_plan(asked: Asked, name: str) -> None:
    """Put a plan into the trash."""
    await _kept(asked, lambda: asked.station.library.delete(name))


async def restore_plan(asked: Asked, id: str) -> None:
    """Take a plan out of the trash."""
    await _kept(asked, lambda: asked.station.library.restore(id))


async def _kept(asked: Asked, do: Callable[[], object]) -> object:
    async with asked.station.library.one_at_a_time:
        return await asyncio.to_thread(do)


async def open_plan(asked: Asked, name: str, revision: int, add: bool) -> None:
    """Take a plan that was kept in place of what has not been started, or beside it."""
    drawn = asked.station.plan
    text = await asyncio.to_thread(asked.station.library.text, name)
    shapes, _ = await asyncio.to_thread(drawn.saved, text, name)
    if add:
        drawn.add(shapes, revision)
    else:
        drawn.take_instead(shapes, revision)


async def preflight(asked: Asked, only_failed: bool | None, **given: Any) -> Response:
    """Answer what a Start would do; it is given up when its client goes away."""
    start = PlannedStart(only_failed=only_failed is True, **given)
    making = asyncio.ensure_future(asked.station.forecast(start))
    gone = asyncio.ensure_future(_gone(asked.request))
    try:
        await asyncio.wait([making, gone], return_when=asyncio.FIRST_COMPLETED)
        return json_reply(making.result()) if making.done() else Response(status_code=499)
    finally:
        making.cancel()
        gone.cancel()
        with suppress(asyncio.CancelledError, BadInput):
            await making  # what it has begun has ended


async def _gone(request: Request) -> None:
    while (await request.receive())["type"] != "http.disconnect":
        pass


# The map


async def map_data(asked: Asked) -> Response:
    """Answer with the map."""
    return json_reply(asked.station.map.data())


async def change_map(asked: Asked, revision: int, **_: object) -> None:
    """Take what was drawn on the map; what was not sent stays."""
    drawn = {name: value for name, value in asked.given.items() if name != "revision"}
    await asked.station.map.change(revision, drawn)


async def take_floor_plan(asked: Asked, revision: int, name: str) -> None:
    """Take a picture as the floor plan."""
    await asked.station.map.take_picture(revision, name, asked.body)


async def take_drawing(asked: Asked, revision: int, file: str) -> None:
    """Take what another program has drawn."""
    name = cut_off(printable(file.strip()), _LONGEST_NAME) or _DRAWING
    await asked.station.map.take_drawing(revision, name, asked.body)


async def find_ways(asked: Asked, ways: list[Any]) -> Response:
    """Answer with the ways between pairs of places."""
    return json_reply(await asked.station.ways.ways(ways))


async def sweep_area(asked: Asked, **_: object) -> Response:
    """Answer with the trips of an area."""
    area = {name: value for name, value in asked.given.items() if value is not None}
    return json_reply(await asked.station.ways.sweep(area))


# Flights of the past, and results: of none, it is the flight of now


async def of_the_past(asked: Asked, **given: Any) -> Response:
    """Answer of flights of the past as the operation is called, read and written apart from this process."""
    operation = asked.operation
    question = methodcaller(operation.name, *(given[name] for name in operation.query))
    return Response(await asked.station.files.ask(_json, question), media_type=JSON)


def _json(files: FlightFiles, question: Callable[[PastFlights], object]) -> str:
    return json_text(question(files.past))


async def mcap(asked: Asked, flight: str) -> Response:
    """Answer with a flight as an MCAP file."""
    content = await asked.station.files.ask(_mcap, flight)
    return _download(content, "flight.mcap", asked.operation.media)


def _mcap(files: FlightFiles, flight: str) -> bytes:
    return files.past.mcap(flight)


async def console(asked: Asked, flight: str) -> Response:
    """Answer with the console."""
    if flight:
        return _text(asked, await asked.station.files.ask(_console, flight))
    session = asked.station.session
    return _text(asked, session.feed.console() if session is not None else "")


def _console(files: FlightFiles, flight: str) -> str:
    return files.past.console(flight)


_EXPORTS: Mapping[str, Callable[[Exports, str], Awaitable[str]]] = {
    "results": Exports.results,
    "results_table": Exports.csv,
    "results_on_map": Exports.geojson,
}


async def exported(asked: Asked, flight: str) -> Response:
    """Answer with the results as the operation is called, to be downloaded."""
    return _text(asked, await _EXPORTS[asked.operation.name](asked.station.exports, flight))


async def pictures(asked: Asked, flight: str) -> Response:
    """Answer with an archive of the pictures."""
    file = await asked.station.exports.archive(flight)
    kind = asked.operation.media
    return _Passing(file, media_type=kind, filename="results.zip", stat_result=file.stat())


async def photo(asked: Asked, result: int, flight: str, size: str) -> Response:
    """Answer with the picture of a result."""
    exports = asked.station.exports
    content, kind = await exports.picture(flight, result, small=size == "thumb")
    return Response(content, media_type=kind)


class _Passing(FileResponse):
    """A file that is deleted once it was sent, or could not be."""

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        try:
            await super().__call__(scope, receive, send)
        finally:
            Path(self.path).unlink(missing_ok=True)


def _text(asked: Asked, text: str, name: str = "") -> Response:
    """Answer with a text to be downloaded: under the last part of its address, if no name is given."""
    kind = asked.operation.media
    kind = kind if kind == JSON else f"{kind}; charset=utf-8"
    name = name or asked.operation.path.rpartition("/")[2]
    return _download(text.encode("utf-8", "replace"), name, kind)


def _download(content: bytes, name: str, kind: str) -> Response:
    named = {"Content-Disposition": f'attachment; filename="{name}"'}
    return Response(content, headers=named, media_type=kind)


OPERATIONS = operations_of(Interface)

HANDLERS: Mapping[str, Handler] = {
    **{name: command for name, one in OPERATIONS.items() if one.is_command},
    **dict.fromkeys(("flights", "replay", "report", "hours"), of_the_past),
    **dict.fromkeys(_EXPORTS, exported),
    **{
        one.__name__: one
        for one in (
            *(app, description, plan, plan_file, replace_plan, import_plan, add_example),
            *(saved_plans, save_plan, delete_plan, restore_plan, open_plan, preflight),
            *(map_data, change_map, take_floor_plan, take_drawing, find_ways, sweep_area),
            *(mcap, console, pictures, photo),
        )
    },
}
NEWEST: Mapping[Any, Callable[[Asked], Awaitable[Response]]] = {
    PlanData: plan,
    MapData: map_data,
    SavedPlans: saved_plans,
}
"""What answers with the newest of what was to be changed, by the type of that."""
