"""The commands and their flags."""

from __future__ import annotations

from argparse import Action, ArgumentParser
from collections.abc import Sequence
from dataclasses import dataclass, field
from datetime import date
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..arguments import whole_number
from ..shared import output
from ..shared.alone.faults import FAULTS, shares
from ..shared.command import add_beginning
from ..shared.command_line import CommandLine
from ..shared.domain.errors import BadInput
from ..shared.domain.quantities import time_from, typed
from .flags import add_drones, add_dry_run, add_flights, add_station, how_it_flies
from .size_flags import Deadline, add_size

if TYPE_CHECKING:
    from ..app import App

MOST_JOBS = 256


@dataclass
class Options:
    """The parsed command line. No slots: argparse sets further attributes."""

    command: str = ""
    missions: Path = field(default_factory=Path)
    fleet: Path | None = None
    seed: int = 0
    no_spread: bool = False
    runs: int | None = None
    jobs: int | None = None
    by: Deadline | None = None
    confidence: float = 0.99
    most: int | None = None
    swap: float | None = None
    write: Path | None = None
    until: float | None = None
    start: float | None = None
    date: date | None = None
    zone: str | None = None
    fail: dict[str, float] = field(default_factory=dict)
    trace: Path | None = None
    plot: Path | None = None
    json: bool = False
    follow: bool = False
    mend: bool = False
    sim: bool = False
    crtp_sim: int | None = None
    speed: float | None = None
    supervise: bool = False
    supervised: bool = False
    journal: Path | None = None
    action: str = ""
    mission: str | None = None
    trip: str | None = None
    priority: int | None = None
    given: Path | None = None
    kind: str | None = None
    land: bool = False
    rtl: bool = False
    everyone: bool = False
    answer: str | None = None
    plan: Path | None = None
    host: str = ""
    port: int = 0
    names: list[str] = field(default_factory=list)
    title: str | None = None
    logo: Path | None = None
    folder: Path | None = None
    open: bool = False
    going_on: bool = False
    who: list[str] = field(default_factory=list)
    scan: bool = False
    addresses: list[str] = field(default_factory=list)
    navigation: str | None = None
    identify: str | None = None
    save: Path | None = None
    dry_run: bool = False

    @property
    def the_journal(self) -> Path:
        """The journal, for a command that requires one."""
        if self.journal is None:
            raise BadInput("name the journal")
        return self.journal

    @property
    def says_when(self) -> bool:
        """Whether it is said when the plan is started, or by the hours of which zone."""
        return (self.start, self.date, self.zone) != (None, None, None)

    @property
    def is_real(self) -> bool:
        """Whether real drones are meant, or Crazyflies that are simulated down to the radio."""
        return self.command in ("fly", "serve") and not self.sim

    @property
    def drone_flags(self) -> list[str]:
        """The flags that select the drones, for another process's command line."""
        if self.crtp_sim is not None:
            return ["--crtp-sim", str(self.crtp_sim)]
        return ["--sim"] if self.sim else []

    def refuse_what_is_simulated(self) -> None:
        """Raise `BadInput` if flags for simulated drones are combined with real ones."""
        given = {"--speed": self.speed, "--fail": self.fail, "--seed": self.seed}
        for flag, value in given.items():
            if value and self.crtp_sim is not None:
                raise BadInput(
                    f"{flag} does not go with --crtp-sim, whose drones fly as real ones do: it goes"
                    " with --sim"
                )
            if value and not self.sim:
                raise BadInput(f"{flag} is for simulated drones: it goes with --sim")


def parse(app: App, argv: Sequence[str] | None) -> Options:
    """Read the command line; raise SystemExit, as argparse does, after help or an error."""
    parser = _plain(CommandLine(prog=app.name, description=app.title, allow_abbrev=False))
    what = "say which app this is, which seam it speaks, and by which library it flies"
    parser.add_argument("--version", action=_Version, app=app, nargs=0, help=what)
    commands = parser.add_subparsers(dest="command", metavar="COMMAND", required=True)

    def command(name: str, what: str) -> ArgumentParser:
        return _plain(commands.add_parser(name, help=what, description=what, allow_abbrev=False))

    simulate = command("simulate", "Fly the missions in virtual time, with simulated drones.")
    _files(simulate)
    _simulation(simulate)
    size = command("size", "Say how many drones the missions need, to be sure of them.")
    _files(size)
    _chance(size)
    _jobs(size)
    add_size(size, typed(time_from))
    add_beginning(size.add_argument, "midnight")
    check = command("check", "Say whether the fleet can fly the missions; nothing flies.")
    _files(check)
    add_beginning(check.add_argument, "what is promised by a time of day is not checked")
    check.add_argument(
        "--write",
        metavar="P.toml",
        type=Path,
        help="write the missions into a new file, with plain trips instead of areas and lists",
    )
    fly = command("fly", "Fly the missions in real time.")
    _files(fly)
    how_it_flies(fly)
    _chance(fly, "with --sim: ")
    fly.add_argument(
        "--journal",
        metavar="J",
        type=Path,
        help="where to write down what happens; default: a new file in the user's own folder",
    )
    add_dry_run(fly, typed(time_from))
    serve = command("serve", "Open the ground station: draw, fly and watch missions in a browser.")
    _fleet(serve)
    how_it_flies(serve)
    _chance(serve, "with --sim: ")
    add_station(serve)
    add_flights(command)
    add_drones(command)
    _journal(command("journal", "Print what happened, as it was written down."))
    options = parser.parse_args(argv, namespace=Options())
    if options.trace is not None and options.runs is not None:
        simulate.error("--trace writes down one run: it does not go with --runs")
    if options.command == "fly" and options.until is not None and not options.dry_run:
        fly.error("--until goes with --dry-run: to end a flight, stop it")
    if options.command == "fly" and options.says_when and not options.dry_run:
        fly.error("--start, --date and --zone go with --dry-run: a flight begins now")
    if options.jobs is not None and options.runs is None and options.command == "simulate":
        simulate.error("--jobs is for many runs: it goes with --runs")
    if options.command == "simulate" and options.plot is not None and options.runs is None:
        simulate.error("--plot draws many runs: it goes with --runs")
    return options


class _Version(Action):
    """Prints the versions, which are slow to look up."""

    def __init__(self, *, app: App, **given: Any) -> None:
        super().__init__(**given)
        self._app = app

    def __call__(self, parser: ArgumentParser, *_: object) -> None:
        from ..seam import versions

        output.line(versions(self._app.name, self._app.seam))
        parser.exit()


def _plain(parser: ArgumentParser) -> ArgumentParser:
    vars(parser)["color"] = False  # from Python 3.14 on it would be True
    return parser


def _files(parser: ArgumentParser) -> None:
    parser.add_argument("missions", metavar="M.toml", type=Path, help="the missions file")
    _fleet(parser)


def _fleet(parser: ArgumentParser) -> None:
    parser.add_argument(
        "--fleet",
        metavar="F.toml",
        type=Path,
        help="the map and the drones; default: the fleet.toml beside the missions, or else five drones"
        " on a plain of 20 × 20 m; real drones need it",
    )


def _journal(parser: ArgumentParser) -> None:
    parser.add_argument(
        "journal", metavar="J", type=Path, nargs="?", help="the journal; default: the newest"
    )
    how = parser.add_mutually_exclusive_group()
    how.add_argument("--follow", action="store_true", help="go on with what comes, as it comes")
    how.add_argument(
        "--mend",
        action="store_true",
        help="make a whole journal of what can be read of a damaged one",
    )
    parser.add_argument("--json", action="store_true", help="print a JSON object for each event")


def _chance(parser: ArgumentParser, only: str = "") -> None:
    parser.add_argument(
        "--seed",
        metavar="N",
        type=whole_number(),
        default=0,
        help=f"{only}what chance depends on (default 0)",
    )
    parser.add_argument(
        "--fail",
        metavar="WHAT=SHARE,…",
        type=typed(shares),
        default={},
        help=f"{only}let flights go wrong: {', '.join(FAULTS)}; such as crash=2%%,link=1%%",
    )


def _jobs(parser: ArgumentParser) -> None:
    parser.add_argument(
        "--jobs",
        metavar="N",
        type=whole_number(1, MOST_JOBS),
        help="how many runs at once, each in a process of its own; default: one for each core",
    )


def _simulation(parser: ArgumentParser) -> None:
    _chance(parser)
    parser.add_argument(
        "--no-spread",
        action="store_true",
        help="let every leg and action take exactly as long as expected, as --dry-run does",
    )
    parser.add_argument(
        "--runs",
        metavar="N",
        type=whole_number(1),
        help="simulate N times, with N seeds from --seed on",
    )
    _jobs(parser)
    parser.add_argument(
        "--plot",
        metavar="FILE",
        type=Path,
        help="draw how the runs lie, into an .svg or a .png; needs matplotlib",
    )
    parser.add_argument(
        "--until",
        metavar="TIME",
        type=typed(time_from),
        help='stop at this simulated time, such as "2 h"',
    )
    add_beginning(parser.add_argument, "midnight")
    parser.add_argument(
        "--trace", metavar="FILE", type=Path, help="write every event there, a JSON object a line"
    )
    parser.add_argument("--json", action="store_true", help="print one JSON object instead")
