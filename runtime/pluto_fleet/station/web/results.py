"""The addresses of results: files to download, and pictures."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Protocol

from ...shared.domain.errors import BadInput
from ..commands import Malformed
from .http import Reply, Request, json_reply, said, text_reply
from .strict_json import asked_number

PHOTO = "/api/photo"
RESULTS = (
    *("/api/results.json", "/api/results.csv", "/api/results.geojson", "/api/results.zip"),
    PHOTO,
)

_LONGEST_FLIGHT = 100
_SIZES = ("", "full", "thumb")


class ServedResults(Protocol):
    """The results that are served. `flight` is an id, or empty for the current flight."""

    async def results(self, flight: str) -> list[object]:
        """Return the results as mappings."""

    async def csv(self, flight: str) -> str:
        """Return the table of values."""

    async def geojson(self, flight: str) -> dict[str, object]:
        """Return the results that have a place."""

    async def archive(self, flight: str) -> Path:
        """Write an archive of the pictures into a file, which the caller deletes."""

    async def picture(self, flight: str, number: int, *, small: bool) -> tuple[bytes, str]:
        """Return the picture of a result and its media type."""


async def read_results(results: ServedResults, request: Request) -> Reply:
    """Answer with results; what there is not is 404, with a sentence."""
    flight = request.query.get("flight", "")
    if len(flight) > _LONGEST_FLIGHT:
        raise Malformed(f"flight is the id of a flight, of at most {_LONGEST_FLIGHT} characters")
    try:
        return await _found(results, request, flight)
    except BadInput as why:
        if isinstance(why, Malformed):
            raise
        return said(404, str(why))


async def _found(results: ServedResults, request: Request, flight: str) -> Reply:
    match request.path:
        case "/api/results.csv":
            return text_reply(await results.csv(flight), "results.csv", "text/csv")
        case "/api/results.geojson":
            text = json.dumps(await results.geojson(flight), ensure_ascii=False)
            return text_reply(text, "results.geojson", "application/geo+json")
        case "/api/results.zip":
            file = await results.archive(flight)
            return Reply(
                status=200, type="application/zip", headers=(_named("results.zip"),), file=file
            )
        case "/api/photo":
            return await _picture(results, request, flight)
        case _:
            reply = json_reply(200, await results.results(flight))
            return Reply(status=200, body=reply.body, headers=(_named("results.json"),))


async def _picture(results: ServedResults, request: Request, flight: str) -> Reply:
    size = request.query.get("size", "")
    if size not in _SIZES:
        raise Malformed("size is thumb, or full")
    number = asked_number(request.query, "result")
    content, kind = await results.picture(flight, number, small=size == "thumb")
    return Reply(status=200, body=content, type=kind)


def _named(name: str) -> tuple[str, str]:
    return ("Content-Disposition", f'attachment; filename="{name}"')
