"""The command line of a generated package: the door to the library, and what works without it."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from functools import partial
from importlib import import_module
from importlib.util import find_spec
from io import TextIOWrapper
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .domain.app import SEAM, needs_library
from .domain.errors import BadInput
from .domain.status import Status
from .domain.text import counted, duration, printable, quoted

if TYPE_CHECKING:
    from argparse import ArgumentParser
    from types import ModuleType

    from .alone.simulate import Outcome
    from .domain.app import App
    from .domain.fleet_data import FleetData
    from .domain.model import Mission

_LIBRARY = ("size", "fly", "resume", "journal", "tell", "decide", "--runs", "--jobs")
_EXTRAS = {"serve": "[station]", "drones": "[crazyflie]", "--plot": "[plot]"}
"""What needs the library, and what needs one of its extras."""
_OPTIONS = "--start --date --zone --fleet --seed --no-spread --fail --until --trace --json"
_WORDS = [*_LIBRARY, *_EXTRAS, "check", "simulate", "--version", *_OPTIONS.split()]
_WORLD = "each drone alone in the air"


def start(name: str, load: Callable[[], App]) -> int:
    """Run the command that the program was called with, and return its exit code."""
    if library := _library():
        return int(library.start(name, load, brain=__package__, seam=SEAM))
    return alone(name, load, sys.argv[1:])


def main(app: App, argv: Sequence[str] | None = None) -> int:
    """Run one command of an app that is loaded, and return its exit code."""
    if library := _library():
        return int(library.main(app, argv, brain=__package__, seam=SEAM))
    return alone(app.name, lambda: app, sys.argv[1:] if argv is None else argv)


def _library() -> ModuleType | None:
    carried = str(Path(__file__).parents[1] / "_fleet")
    if os.path.isdir(carried) and carried not in sys.path:
        sys.path.insert(0, carried)
    return import_module("pluto_fleet.entry") if find_spec("pluto_fleet") else None


def alone(name: str, load: Callable[[], App], argv: Sequence[str]) -> int:
    """Run a command without the library, and return its exit code."""
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, TextIOWrapper):  # a terminal may not know all letters of a name
            stream.reconfigure(errors="backslashreplace")
    try:
        code = _run(name, load, argv)
        print(end="", flush=True)
        return code
    except BadInput as error:
        return _tell("\n".join(map(printable, str(error).split("\n"))), 2)
    except KeyboardInterrupt:
        return _tell(f"{name}: interrupted", 130)
    except OSError as error:  # what is wrong with a file has been told: this is the output
        with suppress(OSError, ValueError):  # Python would try to write the rest at its end
            os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        if isinstance(error, BrokenPipeError):
            return 141
        return _tell(f"{name}: the output cannot be written: {error.strerror or error}", 2)
    except BaseException as error:  # even a SystemExit: it would pass for a proper end
        if os.environ.get("PLUTO_DEBUG") == "1":
            raise
        what = printable(f"{type(error).__name__}: {error}")
        how = "please report it (PLUTO_DEBUG=1 shows where it happened)"
        return _tell(f"{name}: internal error: {what}; {how}", 70)


def _tell(text: str, code: int = 0) -> int:
    with suppress(OSError, ValueError):
        print(text, file=sys.stderr, flush=True)
    return code


def _run(name: str, load: Callable[[], App], argv: Sequence[str]) -> int:
    from .hooks.loading import loaded

    if argv[:1] == ["--version"]:
        from importlib.metadata import distributions  # slow to import

        found = [one.version for one in distributions(name=name.rstrip("_"))]
        print(f"{name} {[*found, '(not installed)'][0]}, seam {SEAM}, pluto-fleet: not installed")
        return 0
    flags = [word for word in argv if word.startswith("--")] if argv[:1] == ["simulate"] else []
    for what in (word.partition("=")[0] for word in flags or argv[:1]):
        if what in _LIBRARY or what in _EXTRAS:
            raise BadInput(f"{name}: {needs_library(what, _EXTRAS.get(what, ''))}")
    app = loaded(load)
    try:
        options = _parser(app).parse_args(argv)
    except SystemExit as end:  # argparse has printed the help, or what is wrong
        from difflib import get_close_matches  # only for mistakes

        for word in (word.partition("=")[0] for word in argv):
            if word not in _WORDS and (word == argv[0] or word.startswith("--")):
                for meant in get_close_matches(word, _WORDS, 1):
                    _tell(f"{name}: {printable(word)}: did you mean {meant}?")
        return end.code if isinstance(end.code, int) else 2
    return _checked(app, options)


def _checked(app: App, options: Any) -> int:
    from dataclasses import replace

    from .alone.files import load_fleet, load_missions
    from .alone.simulate import default_fleet
    from .domain.app import moving
    from .fleet.reach import problems
    from .time.hours import beginning

    beside = options.missions.parent / "fleet.toml"
    if options.fleet is None and os.path.lexists(beside):
        options.fleet = beside
        _tell(f"fleet: {printable(str(beside))}, beside the missions; or name one: --fleet")
    fleet = load_fleet(options.fleet, app) if options.fleet else default_fleet(app)
    if options.no_spread:
        fleet = replace(fleet, motion=fleet.motion.exact)
    if options.command == "simulate":
        fleet = replace(fleet, **beginning(options.date, options.start, options.zone))
    app = moving(app, fleet.motion)
    missions = load_missions(options.missions, app, fleet.airspace)
    forever = options.command == "check" or options.until is not None
    if found := problems(app, missions, fleet, forever=forever):
        raise BadInput("\n".join(f"{options.missions}: {problem}" for problem in found[:50]))
    if options.command == "check":
        return _check(app, missions, fleet, options)
    return _simulate(app, missions, fleet, options)


def _check(app: App, missions: list[Mission[Any]], fleet: FleetData, options: Any) -> int:
    from .fleet.reach import idle_actions, reckoned

    for idle in idle_actions(app, fleet):
        _tell(f"{printable(str(options.fleet or app.name))}: warning: {idle}")
    for assumed in reckoned(app, missions):
        print(printable(assumed))
    trips = counted(sum(len(mission.trips) for mission in missions), "trip")
    plan = f"{counted(len(missions), 'mission')} with {trips}"
    lasts = ", as long as its batteries last: nothing charges them"
    end = "" if fleet.charges_at_home else lasts
    print(f"{plan}: a fleet of {counted(len(fleet.drones), 'drone')} can fly them{end}")
    return 0


def _simulate(app: App, missions: list[Mission[Any]], fleet: FleetData, options: Any) -> int:
    from .alone.simulate import outcome_data, simulate
    from .alone.world import Faults
    from .domain.trace import dumped
    from .time.hours import Hours

    faults = Faults(**options.fail)
    outcome = simulate(app, missions, fleet, seed=options.seed, faults=faults, until=options.until)
    if options.trace is not None:
        try:
            options.trace.write_text("".join(f"{dumped(one)}\n" for one in outcome.events), "utf-8")
        except (OSError, ValueError) as error:
            raise BadInput(f"{options.trace}: the trace cannot be written: {error}") from None
    start = Hours(fleet.began, fleet.zone).start
    if options.json:
        when = {"start": start} if start else {}
        data = outcome_data(app.name, options.seed, outcome)
        print(dumped({**data, **when, "world": _WORLD}))
    else:
        if start:
            print(f"starts at {start}")
        print("\n".join(map(printable, _report(outcome, fleet.charges_at_home))))
    statuses = {mission["status"] for mission in outcome.standing["missions"].values()}
    return 1 if outcome.given_up or Status.FAILED.value in statuses else 0


def _report(outcome: Outcome, charges: bool) -> Iterator[str]:
    missions = outcome.standing["missions"]
    yield from outcome.log
    for name, mission in missions.items():
        reason = mission["reason"] and f": {mission['reason']}"
        yield f"{name}: {mission['status']}{reason}"
    if outcome.given_up:
        yield f"given up: {outcome.given_up}"
    completed = sum(one["status"] == Status.COMPLETED.value for one in missions.values())
    done = f"{completed} of {counted(len(missions), 'mission')} completed"
    flights = counted(outcome.count("trip.launched"), "flight")
    drones = counted(len(outcome.standing["drones"]), "drone")
    yield f"{done} in {duration(outcome.duration)} ({flights}; {drones}, {outcome.crashed} crashed)"
    at_home = "charged at home" if charges else "charged nowhere"
    yield f"flown with {_WORLD} and {at_home}; with pluto-fleet they keep apart"


def add_beginning(
    add: Callable[..., object], default: str, any_day: str = "one of 24 hours"
) -> None:
    """Add the flags that say when a plan is started, and by the hours of which zone."""
    from .domain.fields import time_of_day
    from .domain.quantities import typed
    from .time.hours import day_of, zone_of

    def quoting(read: Callable[[str], Any]) -> Callable[[str], Any]:
        def reading(text: str) -> Any:
            try:
                return read(text)
            except ValueError as error:
                raise ValueError(f"{quoted(text)} {error}") from None

        return typed(reading)

    def zone_name(text: str) -> str:
        zone_of(text)
        return text

    hour = f"at this time of day; default: {default}"
    add("--start", metavar="HH:MM", type=quoting(time_of_day), help=hour)
    day = f"on this day, which may have 23 or 25 hours; default: {any_day}"
    add("--date", metavar="YYYY-MM-DD", type=quoting(day_of), help=day)
    zone = "by the hours of this zone, such as Europe/Rome; default: with --date, this computer's"
    add("--zone", metavar="ZONE", type=quoting(zone_name), help=zone)


def _parser(app: App) -> ArgumentParser:
    from argparse import ArgumentParser

    from .alone.world import shares
    from .domain.quantities import time_from, typed, whole

    more = "size, fly, resume, tell, decide, journal, drones and serve come with pluto-fleet"
    parser = ArgumentParser(prog=app.name, description=app.title, epilog=more, allow_abbrev=False)
    parser.add_argument("--version", action="store_true", help="say which app and seam this is")
    commands = parser.add_subparsers(dest="command", metavar="COMMAND", required=True)
    new = partial(commands.add_parser, allow_abbrev=False)
    check = new("check", help="say whether the fleet can fly the missions")
    simulate = new("simulate", help=f"fly the missions in virtual time, {_WORLD}")
    check.set_defaults(no_spread=True)
    check.add_argument("missions", metavar="M.toml", type=Path, nargs="?", default="missions.toml")
    simulate.add_argument("missions", metavar="M.toml", type=Path)
    for one in (check, simulate):
        one.add_argument("--fleet", metavar="F.toml", type=Path, help="the map and the drones")
    add = simulate.add_argument
    chance = "what chance depends on (default 0)"
    add("--seed", metavar="N", type=typed(whole), default=0, help=chance)
    add("--no-spread", action="store_true", help="let all take exactly as long as expected")
    add("--fail", metavar="WHAT=SHARE,…", type=typed(shares), default={}, help="such as crash=2%%")
    add_beginning(add, "midnight")
    add("--until", metavar="TIME", type=typed(time_from), help='stop then, such as "2 h"')
    add("--trace", metavar="FILE", type=Path, help="write every event there, as a JSON object")
    add("--json", action="store_true", help="print one JSON object instead")
    return parser
