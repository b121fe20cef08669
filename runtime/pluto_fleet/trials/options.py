"""The options of `plutoc test`, passed to the compiled app."""

from __future__ import annotations

from argparse import ArgumentParser
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path

from ..arguments import whole_number
from ..shared.domain.quantities import typed
from .case import Strike, Weather, strikes_of, weather_of

SEEDS = 100


@dataclass
class Options:
    """The parsed options. No slots: argparse sets further attributes."""

    file: Path = field(default_factory=Path)
    """The app's file, as given."""
    missions: Path | None = None
    fleet: Path | None = None
    seeds: int = SEEDS
    seed: int = 0
    strike: tuple[Strike, ...] | None = None
    weather: Weather | None = None
    json: bool = False

    @property
    def single(self) -> bool:
        """Whether a single case is to be repeated."""
        return self.strike is not None or self.weather is not None


_USAGE = """plutoc test [-h] [--seeds N] [--seed N] [--missions M.toml]
                   [--fleet F.toml] [--strike WHAT@ROW,…]
                   [--weather WHAT=HOW,…] [--json]
                   FILE"""
"""The usage of `plutoc test`, which is what the user has typed."""


def parse(argv: Sequence[str]) -> Options:
    """Read the command line; raise SystemExit, as argparse does, after an error."""
    parser = ArgumentParser(prog="plutoc test", usage=_USAGE, allow_abbrev=False)
    parser.add_argument("--file", type=Path)
    parser.add_argument("--seeds", type=whole_number(1))
    parser.add_argument("--seed", type=whole_number())
    parser.add_argument("--missions", type=Path)
    parser.add_argument("--fleet", type=Path)
    parser.add_argument("--strike", type=typed(strikes_of))
    parser.add_argument("--weather", type=typed(weather_of))
    parser.add_argument("--json", action="store_true")
    return parser.parse_args(argv, namespace=Options())
