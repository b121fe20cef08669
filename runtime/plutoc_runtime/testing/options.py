"""What `plutoc test` hands on to the app that it has compiled."""

from __future__ import annotations

from argparse import ArgumentParser, ArgumentTypeError
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TypeVar

from ..cli.options import count, whole
from .blows import Blow, blows_of
from .case import Weather, weather_of

SEEDS = 100

T = TypeVar("T")


@dataclass
class Options:
    """What was asked for. No slots: argparse keeps what it does not know here, too."""

    missions: Path | None = None
    fleet: Path | None = None
    seeds: int = SEEDS
    seed: int = 0
    strike: tuple[Blow, ...] | None = None
    weather: Weather | None = None
    json: bool = False

    @property
    def single(self) -> bool:
        """Whether one case is to be seen again."""
        return self.strike is not None or self.weather is not None


def add_arguments(parser: ArgumentParser) -> None:
    """Say which arguments there are: `plutoc test` takes the same, and the app's file."""
    parser.add_argument(
        "--seeds", metavar="N", type=count, default=SEEDS, help=f"so many seeds (default {SEEDS})"
    )
    parser.add_argument(
        "--seed", metavar="N", type=whole, default=0, help="the first of them (default 0)"
    )
    parser.add_argument(
        "--missions",
        metavar="M.toml",
        type=Path,
        help="try with these missions; default: small ones at random, which fit the app",
    )
    parser.add_argument(
        "--fleet",
        metavar="F.toml",
        type=Path,
        help="the map and the drones (default: fleet.toml beside the app, if it is there)",
    )
    parser.add_argument(
        "--strike",
        metavar="WHAT@ROW,…",
        type=_read(blows_of),
        help="one case: what strikes at which row of the journal, such as crash@12,rtl@15",
    )
    parser.add_argument(
        "--weather",
        metavar="WHAT=HOW,…",
        type=_read(weather_of),
        help="one case: what goes wrong by itself, such as link=0.1,slow=0.4",
    )
    parser.add_argument("--json", action="store_true", help="print one JSON object instead")


def parse(argv: Sequence[str]) -> Options:
    """Read the command line; raise SystemExit, as argparse does, after an error."""
    parser = ArgumentParser(prog="plutoc test", allow_abbrev=False)
    add_arguments(parser)
    return parser.parse_args(argv, namespace=Options())


def _read(reader: Callable[[str], T]) -> Callable[[str], T]:
    """Let argparse say what is wrong."""

    def read(text: str) -> T:
        try:
            return reader(text)
        except ValueError as error:
            raise ArgumentTypeError(str(error)) from None

    return read
