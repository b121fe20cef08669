"""Preflight checks and facts of a Crazyflie. Nothing of this arms or moves it."""

from __future__ import annotations

import asyncio
from collections.abc import Iterator, Mapping

from ..drones.battery_gauge import BatteryGauge
from ..shared.domain.text import number, quoted
from . import messages, parameters
from .flying import DEFAULT_LIMIT, speed_limits_of
from .options import CrazyflieOptions
from .session import CrazyflieSession
from .state import SETTLED_FOR, State

_DECK = "deck."
_SETTLING = 1.5
"""Seconds that an estimate may take to settle after a reset."""
_PATIENCE = 5.0
"""Seconds to wait for a drone that is only unsure of its position: someone may be passing by."""
_BETWEEN = 2.0
"""Seconds after a landing until a drone has disarmed itself, and can be armed again."""
_CAMERA = 2.0
"""The time-out of reaching its camera, in seconds."""
_READ = 8.0
"""The time-out of reading its parameters, in seconds."""


async def problems(
    session: CrazyflieSession, battery: BatteryGauge, options: CrazyflieOptions, speed: float
) -> list[str]:
    version = session.cf.platform.get_protocol_version()
    if version < messages.PROTOCOL:
        release = messages.release(version)
        has = "too old to say which" if version < 0 else f"{version} (release {release})"
        why = (
            f"its firmware speaks protocol {has}, {messages.PROTOCOL} or later is needed:"
            " flash the newest release with cfclient (Connect, Bootloader)"
        )
        return [why]  # its other reports are unreliable
    if session.lacks:
        return [
            f"its firmware has no log variable {', '.join(session.lacks)}: flash the newest release"
        ]
    began = session.loop.time()
    lacking = await _of_parameters(session, options, speed)
    if options.camera is not None:
        lacking += await _of_camera(options.camera)
    state = await session.until(_is_settled, _BETWEEN, well=False) or session.now()
    found = [*_of_state(state), *_of_battery(state, battery, options), *lacking]
    if state.locked or state.crashed:
        return found  # where it is will be known once it has been looked after
    patience = SETTLED_FOR + _SETTLING if found else _PATIENCE
    if not await _sure(session, options, began + patience):
        if options.starts_at_home:
            found.append(
                "its estimate of where it is has not settled: let it stand still on the ground"
            )
        else:
            found.append(_uncertain(session.confidence.variance, options.sure_within))
    return found


def _is_settled(state: State) -> bool:
    """Whether it is not in the moment between its landing and the next arming, when it can do nothing."""
    return state.can_arm or state.can_fly or state.locked or state.crashed or state.deck_failed


def _of_state(state: State) -> Iterator[str]:
    if state.deck_failed:
        yield "one of its decks reports a fault: see that all sit well, and switch it off and on"
    if state.locked:
        yield messages.IS_LOCKED
    elif state.crashed:
        yield (
            messages.LIES
            if state.lies
            else (
                "it has crashed: once it stands upright and is whole, bring it back, or switch it off and on"
            )
        )
    elif state.deck_failed:
        return  # that is why
    elif not (state.can_arm or state.can_fly):
        yield f"its supervisor does not let it fly ({state.said})"


def _of_battery(state: State, battery: BatteryGauge, options: CrazyflieOptions) -> Iterator[str]:
    rest = state.volts / battery.cells if battery.rest is None else battery.rest
    if battery.problem is not None:
        yield battery.problem
    elif not state.flies and rest < options.least_voltage:
        each = "" if options.cells == 1 else " in each cell"
        least = options.least_voltage
        yield f"its battery has {rest:.2f} V{each} at rest, {least:.2f} V are needed: charge it"


def _uncertain(variance: float | None, within: float) -> str:
    if variance is None:
        return "it does not say how sure it is of its position"
    if variance <= within**2:
        return "it has not said for a second that it is sure where it is: let it stand still"
    return (
        f"it is not sure where it is: to {messages.deviation(variance)} (a variance of"
        f" {variance:.4f} m²), and {number(within)} m for a second are needed, its option sure_within"
    )


async def _sure(session: CrazyflieSession, options: CrazyflieOptions, end: float) -> bool:
    """Return whether it is sure of its position; just after connecting, that takes a second."""
    while not _knows_where(session, options):
        if session.loop.time() > end:
            return False
        await session.heard(0.1)
        session.now()
    return True


def _knows_where(session: CrazyflieSession, options: CrazyflieOptions) -> bool:
    now, confidence = session.loop.time(), session.confidence
    if options.starts_at_home:
        return confidence.steady(now)
    return confidence.sure(now, options.sure_within)


async def _of_parameters(
    session: CrazyflieSession, options: CrazyflieOptions, speed: float
) -> list[str]:
    # else an unreadable value is as usual
    asks = bool(options.decks) or speed > DEFAULT_LIMIT
    if not await parameters.complete(session, _READ) and asks:
        return [messages.UNREAD]
    there = decks(session)
    has = f"it has {', '.join(there) or 'none'}"
    lacks = [f"it has no deck {quoted(deck)}: {has}" for deck in options.decks if deck not in there]
    return [*lacks, *speed_limits_of(session).too_slow_for(speed)]


async def _of_camera(where: tuple[str, int]) -> list[str]:
    """Return why its camera does not answer: that is known here, and not at what it is to look at."""
    try:
        async with asyncio.timeout(_CAMERA):
            _, writer = await asyncio.open_connection(*where)
    except OSError as error:  # a time-out is one, too
        why = error.strerror or "nothing came in time"
        problem = (
            f"its camera does not answer at {where[0]}:{where[1]} ({why}): is its AI-deck on, and this"
            " computer in its WiFi? For a plan without photos, leave camera out of the fleet file"
        )
        return [problem]
    writer.transport.abort()
    return []


def decks(session: CrazyflieSession) -> list[str]:
    return [
        name.removeprefix(_DECK)
        for name, value in sorted(parameters.known(session).items())
        if name.startswith(_DECK) and value > 0.0
    ]


async def firmware_facts(session: CrazyflieSession) -> Mapping[str, str]:
    """Return its firmware and its decks, as far as known."""
    version = session.cf.platform.get_protocol_version()
    found = {"protocol": f"{version}", "firmware": messages.release(version)}
    if await parameters.complete(session):
        known = parameters.known(session)
        revision = _revision(known)
        if revision:
            found["firmware"] += f" ({revision})"
        found["decks"] = ", ".join(decks(session)) or "none"
    return found


def _revision(known: Mapping[str, float]) -> str:
    high, low = known.get("firmware.revision0"), known.get("firmware.revision1", 0.0)
    if high is None:
        return ""
    changed = ", changed by hand" if known.get("firmware.modified") else ""
    return f"{int(high):08x}{int(low):04x}{changed}"
