"""The flags of the commands that fly, resume, stop, decide, serve, and query real drones."""

from __future__ import annotations

from argparse import SUPPRESS, ArgumentParser
from collections.abc import Callable
from pathlib import Path

from ..arguments import positive_number, whole_number
from ..jobs.job import MISHAPS
from ..shared.command import add_beginning

ACTIONS = (
    "stop",
    "pause",
    "go-on",
    "skip",
    "cancel",
    "prioritise",
    "change-trips",
    "retire",
    "bring-back",
    "join",
    "mishap",
    "cut-motors",
)
"""The commands of `tell`."""

ANSWERS = ("done", "not-done", "go-on", "cancel")
"""The answers of `decide` for a mission that waits."""

FASTEST = 1000.0

MOST_CRAZYFLIES = 50

Command = Callable[[str, str], ArgumentParser]


def add_flights(command: Command) -> None:
    """Add `resume`, `tell` and `decide`."""
    resume = command("resume", "Go on after a stop or a crash.")
    resume.add_argument(
        "journal", metavar="J", type=Path, nargs="?", help="the journal; default: the newest"
    )
    how_it_flies(resume)

    tell = command("tell", "Tell a running app to stop, or a mission of it to wait, go on or end.")
    tell.add_argument("journal", metavar="J", type=Path, help="the journal that the app keeps")
    tell.add_argument("action", metavar="WHAT", choices=ACTIONS, help=", ".join(ACTIONS))
    tell.add_argument(
        "mission",
        metavar="MISSION",
        nargs="?",
        help="which one; default: all, where that makes sense. For retire, bring-back, join, mishap and"
        " cut-motors: the drone",
    )
    tell.add_argument(
        "trip",
        metavar="TRIP",
        nargs="?",
        help="which one to skip, default: the next; or to give a priority",
    )
    tell.add_argument(
        "--to",
        metavar="N",
        dest="priority",
        type=whole_number(),
        help="prioritise: the trip's new priority",
    )
    tell.add_argument(
        "--from",
        metavar="F.toml",
        dest="given",
        type=Path,
        help="change-trips: a missions file with the trips that the mission shall fly from now on;"
        " join: a fleet file with the drone",
    )
    tell.add_argument(
        "--kind", choices=MISHAPS, help="mishap: what happens to a simulated drone, to rehearse it"
    )
    how = tell.add_mutually_exclusive_group()
    how.add_argument(
        "--land", action="store_true", help="stop: land where the drones are (the default)"
    )
    how.add_argument("--rtl", action="store_true", help="stop: fly home first")
    how.add_argument(
        "--all", action="store_true", dest="everyone", help="cut-motors: those of all drones"
    )

    decide = command("decide", "Say what only a person can know; alone, list what is asked.")
    decide.add_argument("journal", metavar="J", type=Path, help="the journal")
    decide.add_argument("mission", metavar="MISSION", nargs="?", help="which one waits")
    decide.add_argument(
        "answer",
        metavar="ANSWER",
        nargs="?",
        choices=ANSWERS,
        help="done or not-done: whether its action was done; go-on; cancel",
    )


def how_it_flies(parser: ArgumentParser) -> None:
    """Add the flags that `fly` and `resume` share."""
    which = parser.add_mutually_exclusive_group()
    which.add_argument(
        "--sim", action="store_true", help="with simulated drones instead of the real ones"
    )
    which.add_argument(
        "--crtp-sim",
        metavar="N",
        type=whole_number(1, MOST_CRAZYFLIES),
        help="with N simulated Crazyflies, flown as real ones are, through cflib",
    )
    parser.add_argument(
        "--speed",
        metavar="N",
        type=positive_number(FASTEST),
        help="with --sim: let time pass N times as fast",
    )
    parser.add_argument(
        "--supervise", action="store_true", help="start the app again if it crashes"
    )
    parser.add_argument("--supervised", action="store_true", help=SUPPRESS)  # so it is then called


def add_drones(command: Command) -> None:
    """Add `drones`."""
    drones = command("drones", "Say which real drones answer, and whether each is ready to fly.")
    drones.add_argument(
        "who",
        metavar="DRONE",
        nargs="*",
        help="only these: a drone of the fleet file, or a uri; default: the fleet file's, "
        "or all that can be found",
    )
    drones.add_argument(
        "--fleet", metavar="F.toml", type=Path, help="the fleet file whose drones are asked"
    )
    drones.add_argument(
        "--scan", action="store_true", help="with --fleet: find those, too, that it does not have"
    )
    drones.add_argument(
        "--navigation",
        metavar="NAME",
        help="how drones are reached that no fleet file has (default crazyflie)",
    )
    drones.add_argument(
        "--address",
        metavar="A",
        dest="addresses",
        action="append",
        default=[],
        help="find those at this radio address, not at E7E7E7E7E7; may be given several times",
    )
    what = drones.add_mutually_exclusive_group()
    what.add_argument(
        "--identify",
        metavar="DRONE",
        help="let one show which it is, by its lights: a drone of the fleet file, or a uri",
    )
    what.add_argument(
        "--save", metavar="F.toml", type=Path, help="write a fleet file of those that answer"
    )
    what.add_argument("--json", action="store_true", help="print one JSON object instead")


def add_dry_run(fly: ArgumentParser, time: Callable[[str], float]) -> None:
    """Add the flags of `fly --dry-run`."""
    fly.add_argument(
        "--dry-run",
        action="store_true",
        help="print every command that the drones would be given; none is reached, nothing flies",
    )
    only = fly.add_argument_group("with --dry-run")
    only.add_argument(
        "--until",
        metavar="TIME",
        type=time,
        help='no further than to this time, such as "2 h"',
    )
    add_beginning(only.add_argument, "now; midnight of a day that is named", "today")


HOST, PORT = "127.0.0.1", 8765


def add_station(parser: ArgumentParser) -> None:
    """Add the flags of `serve`."""
    parser.add_argument(
        "--missions",
        dest="plan",
        metavar="M.toml",
        type=Path,
        help="the plan that an empty station begins with",
    )
    parser.add_argument(
        "--host",
        metavar="H",
        default=HOST,
        help=f"the address to listen at; default {HOST}: this computer alone. Any other needs the"
        " token that is printed",
    )
    parser.add_argument(
        "--port",
        metavar="N",
        type=whole_number(0, 65_535),
        default=PORT,
        help=f"default {PORT}; 0: any that is free",
    )
    parser.add_argument(
        "--name",
        dest="names",
        metavar="HOST",
        action="append",
        default=[],
        help="another name that browsers may use for it, such as that of a proxy before it",
    )
    parser.add_argument(
        "--folder",
        metavar="D",
        type=Path,
        help="where plan and journals are kept; default: the user's own folder",
    )
    parser.add_argument("--title", metavar="TEXT", help="what it is called; default: as the app")
    parser.add_argument(
        "--logo",
        metavar="FILE",
        type=Path,
        help="a picture for the head of its pages and their tab",
    )
    parser.add_argument("--open", action="store_true", help="open it in a browser")
    parser.add_argument("--going-on", action="store_true", help=SUPPRESS)  # after a crash
