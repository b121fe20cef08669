"""The address at which a Start is forecast: given up when its client goes away."""

from __future__ import annotations

import asyncio
from contextlib import suppress

from ...shared.domain.errors import BadInput
from ..commands import Malformed
from ..preflight.start import PlannedStart
from .http import Reply, json_reply, said
from .served import Asked

GONE = Reply(status=499)
"""The answer to a client that has gone away."""


async def preflight(asked: Asked) -> Reply:
    """Answer what a Start would do; raise `Malformed` if the question is none."""
    making = asyncio.ensure_future(asked.station.forecast(_planned(dict(asked.given))))
    gone = asyncio.ensure_future(asked.request.gone())
    try:
        await asyncio.wait([making, gone], return_when=asyncio.FIRST_COMPLETED)
        if not making.done():
            return GONE
        return json_reply(200, making.result())
    except BadInput as error:
        return said(409, str(error))
    finally:
        for one in (making, gone):
            one.cancel()
        with suppress(asyncio.CancelledError, BadInput):
            await making  # what it has begun has ended


def _planned(given: dict[str, object]) -> PlannedStart:
    revision, missions = given.pop("revision", None), given.pop("missions", None)
    only_failed, runs = given.pop("only_failed", None) or False, given.pop("runs", None)
    if type(revision) is not int:
        raise Malformed("a forecast needs revision: that of the plan, a whole number")
    if missions is not None and not (
        isinstance(missions, list) and all(isinstance(key, str) for key in missions)
    ):
        raise Malformed("a forecast needs missions: the keys of missions of the plan, or null")
    if type(only_failed) is not bool:
        raise Malformed("only_failed of a forecast is true or false")
    if runs is not None and type(runs) is not int:
        raise Malformed("runs of a forecast is a whole number, or null")
    if given:
        raise Malformed("a forecast takes revision, missions, only_failed and runs")
    return PlannedStart(revision=revision, missions=missions, only_failed=only_failed, runs=runs)
