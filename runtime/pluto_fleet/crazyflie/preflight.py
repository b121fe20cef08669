"""Why a Crazyflie must not take off now. Nothing of this arms or moves it."""

from __future__ import annotations

import time
from collections.abc import Iterator
from math import ceil
from typing import TYPE_CHECKING

from . import parameters, words
from .battery import FULLEST
from .certainty import LONG
from .pace import USUAL, pace_of

if TYPE_CHECKING:
    from .battery import Battery
    from .options import Options
    from .session import Session
    from .state import State

_DECK = "deck."
_SETTLING = 1.5
"""Seconds that an estimate may take to settle, after it began anew."""
_PATIENCE = 5.0
"""Seconds for which one is waited for that is only not sure where it is: somebody may just pass."""
_BETWEEN = 2.0
"""Seconds in which one that has landed has disarmed itself, and can be armed again."""
_READ = 8.0
"""Seconds until its parameters must have been read."""


async def problems(session: Session, battery: Battery, options: Options, speed: float) -> list[str]:
    """Return all reasons."""
    version = session.cf.platform.get_protocol_version()
    if version < words.PROTOCOL:
        return [words.old_firmware(version)]  # what else it says need not be so
    if session.lacks:
        return [words.lacks_variables(session.lacks)]
    began = session.loop.time()
    lacking = await _of_parameters(session, options, speed)
    state = await session.until(_is_settled, _BETWEEN, well=False) or session.now()
    found = [*_of_state(state), *_of_battery(state, battery, options), *lacking]
    patience = LONG + _SETTLING if found else _PATIENCE
    if not await _sure(session, options, began + patience):
        variance = session.certainty.variance
        by_beacons = not options.starts_at_home
        unsure = words.uncertain(variance, options.sure_within) if by_beacons else words.UNSETTLED
        found.append(unsure)
    return found


def _is_settled(state: State) -> bool:
    """Whether it is not just between its landing and the next arming, when it can do nothing."""
    return state.can_arm or state.can_fly or state.locked or state.crashed or state.deck_failed


def _of_state(state: State) -> Iterator[str]:
    if state.deck_failed:
        yield words.DECK_FAILED
    if state.locked:
        yield words.IS_LOCKED
    elif state.crashed:
        yield words.LIES if state.lies else words.HAS_CRASHED
    elif state.deck_failed:
        return  # that is why
    elif not (state.can_arm or state.can_fly):
        yield words.cannot_fly(state.said)


def _of_battery(state: State, battery: Battery, options: Options) -> Iterator[str]:
    rest = battery.cell(state) if battery.rest is None else battery.rest
    if rest > FULLEST:
        volts = rest * options.cells
        yield words.more_cells(volts, options.cells, ceil(volts / FULLEST))
    elif not state.flies and rest < options.least_voltage:
        yield words.little(rest, options.least_voltage, options.cells)


async def _sure(session: Session, options: Options, end: float) -> bool:
    """Say whether it knows where it is; just after connecting, that takes a second to find out."""
    while not _knows_where(session, options):
        if session.loop.time() > end:
            return False
        await session.heard(0.1)
        session.now()
    return True


def _knows_where(session: Session, options: Options) -> bool:
    now, certainty = time.monotonic(), session.certainty
    if options.starts_at_home:
        return certainty.steady(now)
    return certainty.sure(now, options.sure_within)


async def _of_parameters(session: Session, options: Options, speed: float) -> list[str]:
    asks = bool(options.decks) or speed > USUAL  # else what cannot be read is as it always is
    if not await parameters.complete(session, _READ) and asks:
        return [words.UNREAD]
    there = decks(session)
    lacks = [words.no_deck(deck, there) for deck in options.decks if deck not in there]
    return [*lacks, *pace_of(session).too_slow_for(speed)]


def decks(session: Session) -> list[str]:
    """Return the decks that it has, as its firmware names them."""
    return [
        name.removeprefix(_DECK)
        for name, value in sorted(parameters.known(session).items())
        if name.startswith(_DECK) and value > 0.0
    ]
