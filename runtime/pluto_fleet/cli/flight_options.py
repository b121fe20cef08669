"""The flags of the commands that fly, go on, stop and decide."""

from __future__ import annotations

from argparse import SUPPRESS, ArgumentParser
from collections.abc import Callable
from pathlib import Path

from ..arguments import positive_number, whole_number

ACTIONS = (
    "stop",
    "pause",
    "go-on",
    "skip",
    "cancel",
    "prioritise",
    "retire",
    "bring-back",
    "cut-motors",
)
"""What a running app can be told."""

ANSWERS = ("done", "not-done", "go-on", "cancel")
"""What a person can decide for a mission that waits."""

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
        help="which one; default: all, where that makes sense. For retire, bring-back and cut-motors:"
        " the drone",
    )
    tell.add_argument(
        "trip",
        metavar="TRIP",
        nargs="?",
        help="which one to skip, default: the next; or to give a priority",
    )
    tell.add_argument(
        "--to", metavar="N", dest="priority", type=int, help="prioritise: the trip's new priority"
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
    """Add what `fly` and `resume` share."""
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
