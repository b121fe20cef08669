"""The flags of `drones`, and what `fly` has for a flight of which nothing flies."""

from __future__ import annotations

from argparse import ArgumentParser
from collections.abc import Callable
from pathlib import Path

Command = Callable[[str, str], ArgumentParser]


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
    """Add the flags of `fly` that let it print what every drone would be told."""
    fly.add_argument(
        "--dry-run",
        action="store_true",
        help="print every command that the drones would be given; none is reached, nothing flies",
    )
    fly.add_argument(
        "--until",
        metavar="TIME",
        type=time,
        help='with --dry-run: no further than to this time, such as "2 h"',
    )
