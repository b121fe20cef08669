"""The handlers of results: files to download, and pictures; what there is not is 404, with a sentence."""

from __future__ import annotations

from ..commands import Malformed
from .flights import flight_in, or_404
from .http import Reply, text_reply
from .served import Asked
from .strict_json import asked_number

CSV, GEOJSON, ZIP, PICTURES = "text/csv", "application/geo+json", "application/zip", "image/*"

_SIZES = ("", "full", "thumb")


async def results(asked: Asked) -> Reply:
    """Answer with the results, to be downloaded."""

    async def found(flight: str) -> Reply:
        text = await asked.station.exports.results(flight)
        return Reply(status=200, body=text.encode(), headers=(_named("results.json"),))

    return await or_404(found(flight_in(asked)))


async def results_table(asked: Asked) -> Reply:
    """Answer with the table of values."""

    async def found(flight: str) -> Reply:
        return text_reply(await asked.station.exports.csv(flight), "results.csv", CSV)

    return await or_404(found(flight_in(asked)))


async def results_on_map(asked: Asked) -> Reply:
    """Answer with the results that have a place."""

    async def found(flight: str) -> Reply:
        text = await asked.station.exports.geojson(flight)
        return text_reply(text, "results.geojson", GEOJSON)

    return await or_404(found(flight_in(asked)))


async def pictures(asked: Asked) -> Reply:
    """Answer with an archive of the pictures."""

    async def found(flight: str) -> Reply:
        file = await asked.station.exports.archive(flight)
        return Reply(status=200, type=ZIP, headers=(_named("results.zip"),), file=file)

    return await or_404(found(flight_in(asked)))


async def photo(asked: Asked) -> Reply:
    """Answer with the picture of a result."""
    query = asked.request.query
    size, number = query.get("size", ""), asked_number(query, "result")
    if size not in _SIZES:
        raise Malformed("size is thumb, or full")

    async def found(flight: str) -> Reply:
        exports = asked.station.exports
        content, kind = await exports.picture(flight, number, small=size == "thumb")
        return Reply(status=200, body=content, type=kind)

    return await or_404(found(flight_in(asked)))


def _named(name: str) -> tuple[str, str]:
    return ("Content-Disposition", f'attachment; filename="{name}"')
