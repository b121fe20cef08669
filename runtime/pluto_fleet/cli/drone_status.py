"""Queries the status of real drones, concurrently: none is armed, none moves, and a silent one delays no other.

The connection to a drone in the air is kept: for some, closing it would switch the motors off.
"""

from __future__ import annotations

import asyncio
import inspect
from collections.abc import AsyncIterator, Coroutine, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from math import isfinite
from pathlib import Path
from typing import TYPE_CHECKING, Protocol, TypeVar, cast

from ..drones.loading import load_navigation, make_localization
from ..drones.localization import LocalizationFeed
from ..drones.protocol import (
    Identifiable,
    Locatable,
    NavigationError,
    Readable,
    Scannable,
)
from ..drones.real_fleet import RealDrone
from ..drones.team import make_one
from ..files.fleet import OWN
from ..gateway.drone_lock import DroneInUse, lock_drones
from ..process.text import of
from ..shared.domain.errors import BadInput
from ..shared.domain.text import number, printable, quoted

if TYPE_CHECKING:
    from ..drones.protocol import DroneNavigation, DroneTelemetry
    from ..files.fleet import Options
    from ..shared.domain.model import Point

CONNECT_WITHIN, ANSWER_WITHIN, CLOSE_WITHIN, SCAN_WITHIN = 15.0, 12.0, 10.0, 90.0
"""Time-outs in seconds."""

LOST = "it does not tell where it is"
IN_THE_AIR = "it is in the air: nothing more was asked of it"

T = TypeVar("T")


class Tells(Protocol):
    """A navigation that offers more facts about its drone than the protocol requires."""

    async def facts(self) -> Mapping[str, str]:
        """Return further facts, such as its firmware."""
        ...


@dataclass(frozen=True, slots=True, kw_only=True)
class DroneQuery(RealDrone):
    """A drone to query; one that is not in the fleet file has its uri as its name."""

    home: Point = (0.0, 0.0, 0.0)
    speed: float = 0.5
    known: bool = True
    """Whether it is in the fleet file."""


@dataclass(slots=True, kw_only=True)
class DroneAnswer:
    """The outcome of a query, as far as it has come."""

    asked: DroneQuery
    problems: tuple[str, ...] = ()
    """Why it may not fly now; nothing: it is ready."""
    telemetry: DroneTelemetry | None = None
    """None: it has sent none."""
    facts: Mapping[str, str] = field(default_factory=dict)


class _Silent(Exception):
    """A step has timed out."""


async def found(navigation: str, options: Mapping[str, object]) -> list[str]:
    """Return the addresses at which drones answer; raise `BadInput` if a scan is not possible."""
    by = load_navigation(navigation)
    if not isinstance(by, Scannable):
        raise BadInput(
            f"the navigation {quoted(navigation)} cannot look for drones: name them, or their fleet"
            " file with --fleet"
        )
    try:
        return list(dict.fromkeys(await _within(SCAN_WITHIN, by.scan(options))))
    except BadInput:
        raise
    except _Silent:
        raise BadInput(f"looking for drones took longer than {number(SCAN_WITHIN)} s") from None
    except Exception as error:
        raise BadInput(f"cannot look for drones: {_why(error)}") from error


async def answers(
    asked: Sequence[DroneQuery],
    folder: Path,
    localization: str = OWN,
    options: Options | None = None,
) -> list[DroneAnswer]:
    """Query the drones; meanwhile each is sent its position if the fleet has a localization."""
    navigations = {one.id: _made(one, folder) for one in asked}
    feeding: LocalizationFeed | None = None
    if localization != OWN:
        source = make_localization(localization, options or {})
        told = {id: one for id, one in navigations.items() if isinstance(one, Locatable)}
        feeding = LocalizationFeed(localization, source, told, lambda _: None)
        feeding.start()
    try:
        return await asyncio.gather(*(_answer(one, navigations[one.id], feeding) for one in asked))
    finally:
        if feeding is not None:
            await feeding.close()


async def identified(asked: DroneQuery, folder: Path) -> None:
    """Make a drone identify itself, by light or sound; raise `BadInput` if it cannot."""
    navigation = _made(asked, folder)
    if not isinstance(navigation, Identifiable):
        raise BadInput(f"{asked.id} has nothing by which it could show itself")
    with lock_drones({asked.id: asked.uri or asked.id}):
        try:
            await _within(CONNECT_WITHIN, navigation.connect())
            await _within(CONNECT_WITHIN, navigation.identify())
        except _Silent:
            raise BadInput(of(asked.id, no_answer(CONNECT_WITHIN))) from None
        except Exception as error:
            raise BadInput(of(asked.id, _why(error))) from error
        finally:
            await _let_go(navigation)


def _made(asked: DroneQuery, folder: Path) -> DroneNavigation:
    called = asked if asked.known else replace(asked, id="it")  # in messages about it
    return make_one(called, asked.home, asked.speed, folder)


def no_answer(seconds: float) -> str:
    """Return the message for a drone that did not answer in time."""
    return f"no answer in {number(seconds)} s"


async def _answer(
    asked: DroneQuery, navigation: DroneNavigation, feeding: LocalizationFeed | None
) -> DroneAnswer:
    answer = DroneAnswer(asked=asked)
    try:
        with lock_drones({asked.id: asked.uri or asked.id}):
            try:
                await _ask(answer, navigation)
            finally:
                await _let_go(navigation)
    except DroneInUse as held:  # an app flies it, and has exclusive access
        answer.problems = (str(held),)
    except _Silent:
        limit = CONNECT_WITHIN if answer.telemetry is None else ANSWER_WITHIN
        answer.problems = (no_answer(limit),)
    except BadInput:  # something that all drones need is missing
        raise
    except Exception as error:  # noqa: BLE001 - a navigation may raise anything
        answer.problems = (_why(error),)
    else:
        assert answer.telemetry is not None
        if not isfinite(sum(answer.telemetry.position)):
            answer.problems = (*answer.problems, LOST)
        lost = None if feeding is None else feeding.silent(asked.id)
        if lost is not None:
            answer.problems = (*answer.problems, lost)
    return answer


async def _ask(answer: DroneAnswer, navigation: DroneNavigation) -> None:
    await _within(CONNECT_WITHIN, navigation.connect())
    answer.telemetry = navigation.telemetry
    if answer.telemetry.flying:
        answer.problems = (IN_THE_AIR,)
        return
    unset = [one async for one in _set(answer.asked, navigation)]
    told = await _within(ANSWER_WITHIN, navigation.preflight())
    answer.problems = (*unset, *map(str, told))
    if inspect.iscoroutinefunction(getattr(navigation, "facts", None)):
        facts = await _within(ANSWER_WITHIN, cast(Tells, navigation).facts())
        answer.facts = {str(name): str(fact) for name, fact in facts.items()}
    answer.telemetry = navigation.telemetry


async def _set(asked: DroneQuery, navigation: DroneNavigation) -> AsyncIterator[str]:
    """Set its parameters, as for a flight; yield why one cannot be set."""
    for name, value in asked.parameters.items():
        if isinstance(navigation, Readable):
            try:
                await _within(ANSWER_WITHIN, navigation.write(name, value))
            except NavigationError as error:
                yield printable(str(error))


async def _let_go(navigation: DroneNavigation) -> None:
    """Close the link to a drone on the ground, or one that has never answered."""
    flying = False
    with suppress(Exception):  # everything has been queried by now
        flying = navigation.telemetry.flying
    if not flying:
        with suppress(Exception):
            await _within(CLOSE_WITHIN, navigation.close())


async def _within(seconds: float, coroutine: Coroutine[object, object, T]) -> T:
    """Await with a time-out, or raise `_Silent`; a call that ignores its cancellation is abandoned."""
    task = asyncio.ensure_future(coroutine)
    try:
        done, _ = await asyncio.wait({task}, timeout=seconds)
    except asyncio.CancelledError:
        task.cancel()
        raise
    if not done:
        task.cancel()
        raise _Silent
    return task.result()


def _why(error: Exception) -> str:
    """Return the message for an error, of the drone or of the navigation itself."""
    said = printable(str(error))
    if hasattr(error, "failure"):
        return said
    return f"its navigation made a mistake: {type(error).__name__}: {said}"


def heard(answer: DroneAnswer) -> DroneTelemetry | None:
    """Return a drone's telemetry, if it has sent any."""
    telemetry = answer.telemetry
    if telemetry is None or not all(map(isfinite, (telemetry.time, *telemetry.position))):
        return None
    return telemetry
