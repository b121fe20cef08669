"""Which promises of missions that are started no order of their flights can keep: told, not refused."""

from __future__ import annotations

import asyncio
import time
from collections.abc import Sequence
from copy import deepcopy
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from ...files.promise_check import impossible
from ...shared.time.hours import Hours
from .problems import sentence

if TYPE_CHECKING:
    from ...app import App
    from ...files.fleet import FleetFile
    from ...shared.domain.model import Mission

MOST = 10
"""The most sentences that are told at once."""


def promised(missions: Sequence[Mission[Any]]) -> Sequence[Mission[Any]]:
    """Return copies of missions, as their flight changes them; none if nothing is promised of any."""
    return deepcopy(missions) if any(one.promises for one in missions) else ()


async def broken(missions: Sequence[Mission[Any]], app: App, fleet: FleetFile) -> Sequence[str]:
    """Return a sentence for each promise that cannot be kept, found in a thread: flights go on meanwhile."""
    if not missions:
        return ()
    beside = replace(fleet, airspace=replace(fleet.airspace))  # threads share no cache of routes
    return await asyncio.to_thread(_sentences, missions, app, beside, Hours(time.time(), ""))


def _sentences(
    missions: Sequence[Mission[Any]], app: App, fleet: FleetFile, hours: Hours
) -> Sequence[str]:
    found = [sentence(one, ()) for one in impossible(missions, app, fleet, hours)]
    more = len(found) - MOST
    return found if more <= 0 else [*found[:MOST], f"… and {more} more"]
