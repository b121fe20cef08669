"""The library's own program, `pluto-fleet`: its version, `calibrate`, `map`, and the processes that apps start.

No app is imported here: drones are commanded, and simulated, by what their files say. So this
process uses the library's own copy of the brain.
"""

from __future__ import annotations

import sys
from argparse import Action, ArgumentParser
from collections.abc import Sequence

from .process.exit_code import BAD_INPUT, exit_code
from .shared import output
from .shared.domain.errors import BadInput
from .shared.domain.text import quoted

_NAME = "pluto-fleet"
_ABOUT = "The library that flies apps compiled by plutoc."
_APPS = "an app is flown by its own program, such as: greenhouse fly missions.toml"
_CALIBRATE, _MAP = "calibrate", "map"
_COMMANDS = {
    _CALIBRATE: "find how drones really move, from the journals of their flights",
    _MAP: "put what another program has drawn into the map of a fleet file",
    "gateway": "command the drones of a flight; an app starts it by itself",
    "crtp": "simulate Crazyflies down to the radio; an app starts it by itself",
    "autopilot": "simulate vehicles that speak MAVLink; an app starts it by itself",
    "mavsdk": "speak MAVLink for a gateway, which starts it by itself",
}


def main(argv: Sequence[str] | None = None) -> int:
    """Run the program and return its exit code; `argv` is without the program."""
    words = list(sys.argv[1:] if argv is None else argv)
    if words[:1] == ["gateway"]:
        from .gateway.process import main as gateway

        return gateway(words[1:])
    if words[:1] == ["crtp"]:
        from .crtp.process import main as crtp

        return crtp(words[1:])
    if words[:1] == ["autopilot"]:
        from .autopilot.process import main as autopilot

        return autopilot(words[1:])
    if words[:1] == ["mavsdk"]:
        from .mavlink.mavsdk_process import main as mavsdk

        return mavsdk(words[1:])
    output.prepare()
    return exit_code(_NAME, lambda: _ran(words))


def _ran(words: Sequence[str]) -> int:
    if words[:1] == [_CALIBRATE]:
        from .cli.calibrate import main as calibrate

        return calibrate(words[1:])
    if words[:1] == [_MAP]:
        from .cli.map import main as put_on_map

        return put_on_map(words[1:])
    return _said(words)


def _said(words: Sequence[str]) -> int:
    """Print what was asked for: the help or the version; or what is wrong with the command line."""
    if words and not words[0].startswith("-"):
        raise BadInput(f"{_NAME}: there is no command {quoted(words[0])}; {_APPS}")
    about = f"{_ABOUT} It knows no app: {_APPS}."
    parser = ArgumentParser(prog=_NAME, description=about, allow_abbrev=False)
    vars(parser)["color"] = False  # from Python 3.14 on it would be True
    what = "say which version this is, which seam it speaks, and which extras are installed"
    parser.add_argument("--version", action=_Version, nargs=0, help=what)
    commands = parser.add_subparsers(dest="command", metavar="COMMAND", required=True)
    for command, does in _COMMANDS.items():
        commands.add_parser(command, help=does, add_help=False)
    try:
        parser.parse_args(words)
    except SystemExit as end:  # argparse has printed the help, or what is wrong
        return end.code if isinstance(end.code, int) else BAD_INPUT
    raise AssertionError("a command is required")


class _Version(Action):
    """Prints the versions, which are slow to look up."""

    def __call__(self, parser: ArgumentParser, *_: object) -> None:
        from . import __version__, extras
        from .shared.domain.app import SEAM

        output.line(f"{_NAME} {__version__}, speaks seam {SEAM}")
        output.line(f"extras: {extras.installed()}")
        parser.exit()


if __name__ == "__main__":
    sys.exit(main())
