"""What a Crazyflie is, for people who look at their drones."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from . import parameters
from .preflight import decks

if TYPE_CHECKING:
    from .session import Session


async def facts_of(session: Session) -> Mapping[str, str]:
    """Return its firmware and its decks, as far as it tells them."""
    found = {"protocol": str(session.cf.platform.get_protocol_version())}
    if await parameters.complete(session):
        known = parameters.known(session)
        revision = _revision(known)
        if revision:
            found["firmware"] = revision
        found["decks"] = ", ".join(decks(session)) or "none"
    return found


def _revision(known: Mapping[str, float]) -> str:
    high, low = known.get("firmware.revision0"), known.get("firmware.revision1", 0.0)
    if high is None:
        return ""
    changed = ", changed by hand" if known.get("firmware.modified") else ""
    return f"{int(high):08x}{int(low):04x}{changed}"
