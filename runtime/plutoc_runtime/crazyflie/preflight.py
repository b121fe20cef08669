"""Why a Crazyflie must not take off now. Nothing of this arms or moves it."""

from __future__ import annotations

import time
from collections.abc import Iterator
from typing import TYPE_CHECKING

from . import parameters, words
from .certainty import LONG, MOST

if TYPE_CHECKING:
    from .battery import Battery
    from .options import Options
    from .session import Session
    from .state import State

_DECK = "deck."
_SETTLING = 1.5
"""Seconds that an estimate may take to settle, after it began anew."""


async def problems(session: Session, battery: Battery, options: Options) -> list[str]:
    """Return all reasons."""
    version = session.cf.platform.get_protocol_version()
    if version < words.PROTOCOL:
        return [words.old_firmware(version)]  # what else it says need not be so
    if session.lacks:
        return [words.lacks_variables(session.lacks)]
    state = session.now()
    found = [*_of_state(state), *_of_battery(state, battery, options)]
    by_beacons = not options.starts_at_home
    if not await _sure(session, by_beacons):
        variance = session.certainty.variance
        found.append(words.uncertain(variance, MOST) if by_beacons else words.UNSETTLED)
    return [*found, *await _of_decks(session, options)]


def _of_state(state: State) -> Iterator[str]:
    if state.locked:
        yield words.IS_LOCKED
    elif state.crashed:
        yield words.LIES
    elif not (state.can_arm or state.can_fly):
        yield words.cannot_fly(state.said)


def _of_battery(state: State, battery: Battery, options: Options) -> Iterator[str]:
    rest = state.volts if battery.rest is None else battery.rest
    if not state.flies and rest < options.least_voltage:
        yield words.little(rest, options.least_voltage)


async def _sure(session: Session, by_beacons: bool) -> bool:
    """Say whether it knows where it is; just after connecting, that takes a second to find out."""
    end = session.loop.time() + LONG + _SETTLING
    while not session.certainty.sure(time.monotonic(), by_beacons=by_beacons):
        variance = session.certainty.variance
        hopeless = by_beacons and variance is not None and variance > MOST
        if hopeless or session.loop.time() > end:
            return False
        await session.heard(0.1)
        session.now()
    return True


async def _of_decks(session: Session, options: Options) -> list[str]:
    if not options.decks:
        return []
    if not await parameters.complete(session):
        return [words.UNREAD]
    there = decks(session)
    return [words.no_deck(deck, there) for deck in options.decks if deck not in there]


def decks(session: Session) -> list[str]:
    """Return the decks that it has, as its firmware names them."""
    return [
        name.removeprefix(_DECK)
        for name, value in sorted(parameters.known(session).items())
        if name.startswith(_DECK) and value > 0.0
    ]
