"""`drones`: which real drones answer, whether each is ready, and which one is which.

All are asked at once: none is armed, none moves, and a silent one delays no other. The connection to a drone in the
air is kept: for some, closing it would switch the motors off.
"""

from __future__ import annotations

import asyncio
import inspect
from collections.abc import AsyncIterator, Coroutine, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import asdict, dataclass, field, replace
from math import isfinite
from pathlib import Path
from typing import TYPE_CHECKING, Protocol, TypeVar, cast

from ..crazyflie.driver import require
from ..drones.loading import load_navigation, make_localization
from ..drones.localization import LocalizationFeed
from ..drones.protocol import (
    Identifiable,
    Locatable,
    NavigationError,
    Readable,
    Scannable,
)
from ..drones.real_fleet import RealDrone, RealFleet, real_fleet
from ..drones.team import make_one
from ..files.addresses import which
from ..files.fleet import (
    CRAZYFLIE,
    MAVLINK,
    OWN,
    load_fleet,
    navigation_by,
    not_real,
)
from ..files.reading import near
from ..gateway.drone_lock import DroneInUse, lock_drones
from ..journal.place import folder_of
from ..mavlink.needs import require as require_mavsdk
from ..process.text import of
from ..report.terminal import table
from ..shared import output
from ..shared.domain.errors import BadInput
from ..shared.domain.text import counted, number, percent, place, printable, quoted
from ..shared.domain.trace import dumped
from .draft_fleet import Answered, write_fleet
from .written import refuse_if_there

if TYPE_CHECKING:
    from ..app import App
    from ..drones.protocol import DroneNavigation, DroneTelemetry
    from ..files.fleet import FleetFile, Options
    from ..geodesy import Degrees, LocalPlane
    from ..shared.domain.model import Point
    from .options import Options as Command


NOT_READY = 1
"""The exit code if a drone does not answer, or may not fly."""


def drones(app: App, options: Command) -> int:
    """Query the status of real drones; nothing is armed, and nothing moves."""
    _refuse_what_does_not_go_together(options)
    fleet = None if options.fleet is None else _fleet(app, options.fleet)
    team = _Team(app, fleet, options.navigation)
    if CRAZYFLIE in team.navigations:
        require()
    if MAVLINK in team.navigations:
        require_mavsdk()
    if options.identify is not None:
        return _identify(app, team.one(options.identify))
    told = asyncio.run(_asked(app, options, team))
    if options.json:
        output.line(dumped(drones_data(app.name, told)))
    else:
        _say(told)
    if options.save is not None:
        there = [
            Answered(one.asked.uri, known.position, one.degrees)
            for one in told
            if (known := heard(one)) is not None
        ]
        write_fleet(app, options.save, there, options.navigation)
    return 0 if told and not any(one.problems for one in told) else NOT_READY


def _refuse_what_does_not_go_together(options: Command) -> None:
    if options.scan and (options.fleet is None or options.who):
        raise BadInput("--scan goes with --fleet, and with no drone: drones alone finds all")
    if options.identify is not None and (options.who or options.scan):
        raise BadInput("--identify names the drone itself: leave the others out")
    if options.save is None:
        return
    if options.fleet is not None:
        raise BadInput(f"--save writes a new fleet file, and {options.fleet} is one: leave one out")
    refuse_if_there(options.save)


def _fleet(app: App, path: Path) -> FleetFile:
    """Return the fleet, if its file has what is needed to reach the drones."""
    fleet = load_fleet(path, app)
    if problem := not_real(fleet):
        raise BadInput(f"{path}: {problem}")
    return fleet


class _Team:
    """The drones of the fleet file, and the navigations for others."""

    def __init__(self, app: App, fleet: FleetFile | None, navigation: str | None) -> None:
        self.fleet, self._is_told = fleet, navigation is not None
        self.others = navigation or (CRAZYFLIE if fleet is None else fleet.navigation)
        self.known = [] if fleet is None else _known(app, fleet)

    @property
    def navigations(self) -> list[str]:
        """The navigations of these drones; without any, that of those to be found."""
        return list(dict.fromkeys(asked.navigation for asked in self.known)) or [self.others]

    def one(self, who: str) -> DroneQuery:
        """Return a drone by its name in the fleet file, or by its uri."""
        for asked in self.known:
            if who == asked.id or (asked.uri is not None and which(who) == which(asked.uri)):
                return asked
        if "://" in who or self._is_told:
            return self._other(who)
        if self.fleet is None:
            raise BadInput(f"which drone is {quoted(who)}? Name its uri, or the --fleet it is of")
        hint = near(who, [asked.id for asked in self.known])
        raise BadInput(f"the fleet has no drone {quoted(who)}{hint}")

    async def all_found(self, addresses: Sequence[str]) -> list[DroneQuery]:
        """Scan with the navigations of this fleet; known drones have their names of the fleet file."""
        where = {"addresses": list(addresses)} if addresses else {}
        uris = await found(self.others, {**self._options(self.others), **where})
        known = {which(asked.uri): asked for asked in self.known if asked.uri is not None}
        return [known.get(which(uri)) or self._other(uri) for uri in uris]

    def _other(self, uri: str) -> DroneQuery:
        by = navigation_by(uri) or self.others
        options = self._options(by)
        plane = None if self.fleet is None else self.fleet.plane
        return DroneQuery(id=uri, uri=uri, navigation=by, options=options, known=False, plane=plane)

    def _options(self, navigation: str) -> Options:
        return {} if self.fleet is None else self.fleet.options.get(navigation, {})


def _known(app: App, fleet: FleetFile) -> list[DroneQuery]:
    """Return the drones of a fleet file."""
    speeds = {category.name: category.speed for category in app.categories}
    real = real_fleet(fleet, ()).drones
    return [
        DroneQuery(**asdict(how), home=drone.home, speed=speeds[drone.category], plane=fleet.plane)
        for how, drone in zip(real, fleet.drones, strict=True)
    ]


def _identify(app: App, asked: DroneQuery) -> int:
    asyncio.run(identified(asked, _folder(app)))
    where = "" if asked.uri in (None, asked.id) else f" ({asked.uri})"
    output.line(f"{asked.id}{where} has shown itself")
    return 0


async def _asked(app: App, options: Command, team: _Team) -> list[DroneAnswer]:
    asked = [team.one(who) for who in options.who]
    if not asked:
        asked = list(team.known)
    if not asked or options.scan:
        output.tell("looking for drones …")
        there = await team.all_found(options.addresses)
        asked += there
    each = list({one.id: one for one in asked}.values())
    if each:
        output.tell(f"asking {counted(len(each), 'drone')} …")
    folder, fleet = _folder(app), team.fleet
    if fleet is None:
        return await answers(each, folder)
    return await answers(each, folder, fleet.localization, fleet.localization_options)


def _say(told: Sequence[DroneAnswer]) -> None:
    if not told:
        output.line("no drone answers: are they switched on, and near?")
        return
    for line in drones_table(told):
        output.line(line)
    output.line()
    ready = sum(not one.problems for one in told)
    output.line(f"{ready} of {counted(len(told), 'drone')} ready to fly")


def _folder(app: App) -> Path:
    """Return the folder in which navigations may cache facts about drones."""
    folder = folder_of(app.name) / "drones"
    try:
        folder.mkdir(mode=0o700, parents=True, exist_ok=True)
    except OSError as error:
        raise BadInput(f"{folder}: cannot be made: {error.strerror}") from None
    return folder


ONLY_IN_JSON = ("protocol",)
"""Facts that are only in the JSON output."""

LONGEST = 120
"""Characters of a cell: a drone's texts may be of any length."""


def drones_table(told: Sequence[DroneAnswer]) -> Iterator[str]:
    """Yield a line for each drone."""
    facts = list(dict.fromkeys(fact for one in told for fact in one.facts))
    shown = [fact for fact in facts if fact not in ONLY_IN_JSON]
    return table(
        ("drone", "uri", *shown, "battery", "position", "ready"),
        [
            [
                cell if len(cell) <= LONGEST else f"{cell[: LONGEST - 1]}…"
                for cell in (
                    one.asked.id if one.asked.known else "—",
                    one.asked.uri or "—",
                    *(one.facts.get(fact, "—") for fact in shown),
                    *_state(one),
                    "; ".join(one.problems) or "ready",
                )
            ]
            for one in told
        ],
        right=(),
    )


def drones_data(app: str, told: Sequence[DroneAnswer]) -> dict[str, object]:
    """Return the object that `drones --json` prints."""
    return {"app": app, "drones": [_data(one) for one in told]}


def _data(one: DroneAnswer) -> dict[str, object]:
    telemetry = heard(one)
    return {
        "drone": one.asked.id if one.asked.known else None,
        "uri": one.asked.uri,
        "navigation": one.asked.navigation,
        "ready": not one.problems,
        "problems": list(one.problems),
        "voltage": None if telemetry is None else telemetry.voltage or None,
        "battery_level": telemetry.battery_level if telemetry and telemetry.battery_told else None,
        "position": None if telemetry is None else list(telemetry.position),
        "flying": None if telemetry is None else telemetry.flying,
        "facts": dict(one.facts),
    }


def _state(one: DroneAnswer) -> tuple[str, str]:
    """Return its battery and where it is: on the Earth, if there is no map."""
    telemetry = heard(one)
    if telemetry is None:
        return "—", "—"
    level = percent(telemetry.battery_level) if telemetry.battery_told else "not told"
    battery = f"{telemetry.voltage:.2f} V, {level}" if telemetry.voltage else level
    if one.asked.plane is None and one.degrees is not None:
        latitude, longitude, _ = one.degrees
        return battery, f"{latitude:.6f}, {longitude:.6f}"
    x, y, z = telemetry.position
    return battery, place((round(x, 2), round(y, 2), z))


# Asking them


CONNECT_WITHIN = 15.0
ANSWER_WITHIN = 12.0
CLOSE_WITHIN = 10.0
SCAN_WITHIN = 90.0
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
    plane: LocalPlane | None = None
    """Where the fleet's map lies on the Earth, if its file says so."""


@dataclass(slots=True, kw_only=True)
class DroneAnswer:
    """The outcome of a query, as far as it has come."""

    asked: DroneQuery
    problems: tuple[str, ...] = ()
    """Why it may not fly now; nothing: it is ready."""
    telemetry: DroneTelemetry | None = None
    """None: it has sent none."""
    facts: Mapping[str, str] = field(default_factory=dict)
    degrees: Degrees | None = None
    """Where it stands on the Earth, if it tells that."""


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
    return make_one(called, asked.home, asked.speed, folder, RealFleet(plane=asked.plane))


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
    answer.degrees = getattr(navigation, "degrees", None)


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
