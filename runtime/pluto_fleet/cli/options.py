"""The commands, and one table of all their options, from which the command line is read."""

from __future__ import annotations

import sys
from argparse import SUPPRESS, Action, ArgumentParser
from collections.abc import Sequence
from dataclasses import dataclass, field
from datetime import date
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..arguments import Deadline, confidence, deadline, positive_number, whole_number
from ..files.stand_ins import CRTP, MAVLINK_SIM, StandIns
from ..jobs.link import MISHAPS
from ..shared import output
from ..shared.alone.world import FAULTS, shares
from ..shared.command import add_beginning
from ..shared.command_line import CommandLine
from ..shared.domain.errors import BadInput
from ..shared.domain.quantities import time_from, typed

if TYPE_CHECKING:
    from ..app import App

COMMANDS = {
    "simulate": "Fly the missions in virtual time, with simulated drones.",
    "size": "Say how many drones the missions need, to be sure of them.",
    "check": "Say whether the fleet can fly the missions; nothing flies.",
    "fly": "Fly the missions in real time.",
    "serve": "Open the ground station: draw, fly and watch missions in a browser.",
    "resume": "Go on after a stop or a crash.",
    "tell": "Tell a running app to stop, or a mission of it to wait, go on or end.",
    "decide": "Say what only a person can know; alone, list what is asked.",
    "drones": "Say which real drones answer, and whether each is ready to fly.",
    "journal": "Print what happened, as it was written down.",
}

ACTIONS = (
    *("stop", "pause", "go-on", "skip", "cancel", "prioritise", "change-trips"),
    *("retire", "bring-back", "join", "mishap", "event", "cut-motors"),
)
"""The commands of `tell`."""

ANSWERS = ("done", "not-done", "go-on", "cancel")
"""The answers of `decide` for a mission that waits."""

HOST = "127.0.0.1"
PORT = 8765


@dataclass
class Options:
    """The parsed command line, with what is not said in it. No slots: argparse sets further attributes."""

    words: Sequence[str] = ()
    """The command line itself."""
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
    drawing: Path = field(default_factory=Path)
    no_fly: bool = False
    until: float | None = None
    start: float | None = None
    date: date | None = None
    zone: str | None = None
    fail: dict[str, float] = field(default_factory=dict)
    trace: Path | None = None
    plot: Path | None = None
    json: bool = False
    follow: bool = False
    sim: bool = False
    crtp_sim: int | None = None
    mavlink_sim: int | None = None
    speed: float | None = None
    supervise: bool = False
    supervised: bool = False
    journal: Path | None = None
    journals: list[Path] = field(default_factory=list)
    action: str = ""
    mission: str | None = None
    trip: str | None = None
    more: Sequence[str] = ()
    priority: int | None = None
    given: Path | None = None
    kind: str | None = None
    keep: float | None = None
    land: bool = False
    rtl: bool = False
    everyone: bool = False
    answer: str | None = None
    plan: Path | None = None
    host: str = HOST
    port: int = PORT
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
    def stand_ins(self) -> StandIns | None:
        """The drones that are simulated down to their protocol, if they are meant."""
        for kind, number in ((CRTP, self.crtp_sim), (MAVLINK_SIM, self.mavlink_sim)):
            if number is not None:
                return StandIns(kind, number)
        return None

    @property
    def is_real(self) -> bool:
        """Whether real drones are meant, or such that are simulated down to their protocol."""
        return self.command in ("fly", "serve") and not self.sim

    def supervised_words(self, *first: str) -> list[str]:
        """Return the same command line for the process that is supervised, with more options."""
        command, *others = (word for word in self.words if word != "--supervise")
        return [command, "--supervised", *first, *others]

    def refuse_what_is_simulated(self) -> None:
        """Raise `BadInput` if flags for simulated drones are combined with real ones."""
        given = {"--speed": self.speed, "--fail": self.fail, "--seed": self.seed}
        for flag, value in given.items():
            if value and self.stand_ins is not None:
                raise BadInput(
                    f"{flag} does not go with --{self.stand_ins.kind}-sim, whose drones fly as real ones"
                    " do: it goes with --sim"
                )
            if value and not self.sim:
                raise BadInput(f"{flag} is for simulated drones: it goes with --sim")


@dataclass(frozen=True, slots=True)
class Option:
    """A row of the table: an option or an argument, as it is typed, and which commands take it."""

    commands: str
    typed: str
    help: str
    how: dict[str, Any]
    """What argparse must know beside."""
    only_with: str = ""
    """The option beside which it makes sense, where its command has that one."""
    apart: str = ""
    """Of all that a command has with the same word here, one may be given."""


_READ: dict[str, Any] = {
    **dict.fromkeys(("J", "M.toml", "F.toml", "P.toml", "FILE", "D"), Path),
    "TIME": typed(time_from),
}
"""What reads a value that is called so, if the row does not say it."""


def row(
    commands: str, typed: str, help: str, only_with: str = "", apart: str = "", **how: Any
) -> Option:
    """Return a row; an option without a value is a switch."""
    name, _, metavar = typed.partition(" ")
    if how.get("nargs") == "?":
        how["default"] = None  # argparse would read the one of the parser as if it were typed
    if metavar:
        how = {"metavar": metavar, "type": _READ.get(metavar), **how}
    elif name.startswith("-") and "choices" not in how:
        how["action"] = "store_true"
    return Option(commands, name, help, how, only_with, apart)


TABLE = (
    row("simulate size check fly", "missions M.toml", "the missions file"),
    row("resume journal", "journal J", "the journal; default: the newest", nargs="?", default=None),
    row("tell", "journal J", "the journal that the app keeps"),
    row("decide", "journal J", "the journal"),
    row("tell", "action WHAT", ", ".join(ACTIONS), choices=ACTIONS),
    row(
        "tell",
        "mission MISSION",
        "which one; default: all, where that makes sense. For retire, bring-back, join, mishap and"
        " cut-motors: the drone. For event: its name",
        nargs="?",
    ),
    row("decide", "mission MISSION", "which one waits", nargs="?"),
    row(
        "tell",
        "trip TRIP",
        "which one to skip, default: the next; or to give a priority. For event: FIELD=VALUE, as id=,"
        " at=X,Y, track=, or one of its own",
        nargs="?",
    ),
    row("tell", "more FIELD=VALUE", "event: more of its fields", nargs="*"),
    row(
        "decide",
        "answer ANSWER",
        "done or not-done: whether its action was done; go-on; cancel",
        nargs="?",
        choices=ANSWERS,
    ),
    row(
        "drones",
        "who DRONE",
        "only these: a drone of the fleet file, or a uri; default: the fleet file's, or all that can"
        " be found",
        nargs="*",
    ),
    row(
        "simulate size check fly serve",
        "--fleet F.toml",
        "the map and the drones; default: the fleet.toml beside the missions, or else five drones on"
        " a plain of 20 × 20 m; real drones need it",
    ),
    row("map", "fleet F.toml", "the fleet file; it is made if there is none"),
    row("map", "drawing FILE", "what is drawn"),
    row("map", "--no-fly", "nothing may fly over any of its areas", dest="no_fly"),
    row("calibrate", "journals JOURNAL", "flown journals", nargs="+", type=Path),
    row(
        "calibrate",
        "--fleet F.toml",
        "whose [motion] says how legs are flown; default: that of the first journal",
    ),
    row("calibrate", "--write F.toml", "put what was found into the [motion] of this fleet file"),
    row("calibrate", "--json", "print it for programs"),
    row("drones", "--fleet F.toml", "the fleet file whose drones are asked"),
    row(
        "fly serve resume",
        "--sim",
        "with simulated drones instead of the real ones",
        apart="drones",
    ),
    row(
        "fly serve resume",
        "--crtp-sim N",
        "with N simulated Crazyflies, flown as real ones are, through cflib",
        apart="drones",
        type=whole_number(1, 50),
    ),
    row(
        "fly serve resume",
        "--mavlink-sim N",
        "with N simulated vehicles that speak MAVLink, flown as real ones are, through MAVSDK",
        apart="drones",
        type=whole_number(1, 50),
    ),
    row(
        "fly serve resume",
        "--speed N",
        "let time pass N times as fast",
        only_with="--sim",
        type=positive_number(1000.0),
    ),
    row("fly serve resume", "--supervise", "start the app again if it crashes"),
    row("fly serve resume", "--supervised", SUPPRESS),  # so it is then called
    row(
        "simulate size fly serve",
        "--seed N",
        "what chance depends on (default 0)",
        only_with="--sim",
        type=whole_number(),
    ),
    row(
        "simulate size fly serve",
        "--fail WHAT=SHARE,…",
        f"let flights go wrong: {', '.join(FAULTS)}; such as crash=2%%,link=1%%",
        only_with="--sim",
        type=typed(shares),
    ),
    row(
        "simulate",
        "--no-spread",
        "let every leg and action take exactly as long as expected, as --dry-run does",
    ),
    row(
        "simulate",
        "--runs N",
        "simulate N times, with N seeds from --seed on",
        type=whole_number(1),
    ),
    row(
        "simulate size",
        "--jobs N",
        "how many runs at once, each in a process of its own; default: one for each core",
        type=whole_number(1, 256),
    ),
    row(
        "simulate", "--plot FILE", "draw how the runs lie, into an .svg or a .png; needs matplotlib"
    ),
    row("simulate", "--until TIME", 'stop at this simulated time, such as "2 h"'),
    row("simulate", "--trace FILE", "write every event there, a JSON object a line"),
    row(
        "size",
        "--by TIME",
        'by when all missions must be completed: how long after the first begins, such as "20 min",'
        " or a time of day, such as 08:30; default: no matter when",
        type=typed(deadline),
    ),
    row(
        "size",
        "--confidence SHARE",
        "how probable that shall be (default 99%%)",
        type=typed(confidence),
    ),
    row(
        "size",
        "--runs N",
        "how often a fleet is simulated at most; default: as often as the confidence takes",
        type=whole_number(1, 1_000_000),
    ),
    row(
        "size",
        "--max N",
        "how many drones at most; default: four for each mission, and four more",
        dest="most",
        type=whole_number(1, 1000),
    ),
    row("size", "--swap TIME", "batteries are swapped in this time instead of charged in the dock"),
    row("size", "--write F.toml", "write the fleet into a new fleet file"),
    row(
        "size",
        "--plot FILE",
        "draw how sure fleets of each size are, into an .svg or a .png; needs matplotlib",
    ),
    row(
        "check",
        "--write P.toml",
        "write the missions into a new file, with plain trips instead of areas and lists; or, on a map with an"
        " origin, their places into a .geojson, .kml, .plan or .csv",
    ),
    row(
        "fly",
        "--journal J",
        "where to write down what happens; default: a new file in the user's own folder",
    ),
    row(
        "fly",
        "--dry-run",
        "print every command that the drones would be given; none is reached, nothing flies",
    ),
    row(
        "fly", "--until TIME", 'no further than to this time, such as "2 h"', only_with="--dry-run"
    ),
    row("serve", "--missions M.toml", "the plan that an empty station begins with", dest="plan"),
    row(
        "serve",
        "--host H",
        f"the address to listen at; default {HOST}: this computer alone. Any other needs the token"
        " that is printed",
    ),
    row("serve", "--port N", f"default {PORT}; 0: any that is free", type=whole_number(0, 65_535)),
    row(
        "serve",
        "--name HOST",
        "another name that browsers may use for it, such as that of a proxy before it",
        dest="names",
        action="append",
    ),
    row("serve", "--folder D", "where plan and journals are kept; default: the user's own folder"),
    row("serve", "--title TEXT", "what it is called; default: as the app"),
    row("serve", "--logo FILE", "a picture for the head of its pages and their tab"),
    row("serve", "--open", "open it in a browser"),
    row("serve", "--going-on", SUPPRESS),  # after a crash
    row(
        "tell",
        "--to N",
        "prioritise: the trip's new priority",
        dest="priority",
        type=whole_number(),
    ),
    row(
        "tell",
        "--from F.toml",
        "change-trips: a missions file with the trips that the mission shall fly from now on; join: a"
        " fleet file with the drone",
        dest="given",
    ),
    row(
        "tell",
        "--kind",
        "mishap: what happens to a simulated drone, to rehearse it",
        choices=MISHAPS,
    ),
    row(
        "tell",
        "--keep TIME",
        "event: how long it is kept while everything is stopped (default 60 s); resumed later, it is dropped",
    ),
    row("tell", "--land", "stop: land where the drones are (the default)", apart="how"),
    row("tell", "--rtl", "stop: fly home first", apart="how"),
    row("tell", "--all", "cut-motors: those of all drones", apart="how", dest="everyone"),
    row("drones", "--scan", "with --fleet: find those, too, that it does not have"),
    row(
        "drones",
        "--navigation NAME",
        "how drones are reached that no fleet file has (default crazyflie)",
    ),
    row(
        "drones",
        "--address A",
        "find those at this address, not at the usual ones: E7E7E7E7E7 of a radio, or"
        " mavlink+udp://:14550; may be given several times",
        dest="addresses",
        action="append",
    ),
    row(
        "drones",
        "--identify DRONE",
        "let one show which it is, by its lights: a drone of the fleet file, or a uri",
        apart="what",
    ),
    row("drones", "--save F.toml", "write a fleet file of those that answer", apart="what"),
    row("simulate size", "--json", "print one JSON object instead"),
    row("drones", "--json", "print one JSON object instead", apart="what"),
    row("journal", "--follow", "go on with what comes, as it comes"),
    row("journal", "--json", "print a JSON object for each event"),
)

BEGINNINGS = {
    "simulate": ("midnight",),
    "size": ("midnight",),
    "check": ("what is promised by a time of day is not checked",),
    "fly": ("now; midnight of a day that is named", "today"),
}
"""The defaults of --start and --date, of the commands that take these and --zone."""

_NEEDS = {
    ("simulate", "jobs"): ("runs", "--jobs is for many runs: it goes with --runs"),
    ("simulate", "plot"): ("runs", "--plot draws many runs: it goes with --runs"),
    ("fly", "until"): ("dry_run", "--until goes with --dry-run: to end a flight, stop it"),
    **dict.fromkeys(
        [("fly", "start"), ("fly", "date"), ("fly", "zone")],
        ("dry_run", "--start, --date and --zone go with --dry-run: a flight begins now"),
    ),
}
"""By command and option: which other one it needs, and what is said without that."""


def parse(app: App, argv: Sequence[str] | None) -> Options:
    """Read the command line; raise SystemExit, as argparse does, after help or an error."""
    words = list(sys.argv[1:] if argv is None else argv)
    parser, commands = all_commands(app)
    options = parser.parse_args(words, namespace=Options(words=words))
    refuse = commands[options.command].error
    if options.trace is not None and options.runs is not None:
        refuse("--trace writes down one run: it does not go with --runs")
    for (command, name), (other, sentence) in _NEEDS.items():
        given = getattr(options, name) is not None
        if command == options.command and given and not getattr(options, other):
            refuse(sentence)
    return options


def reader_of(command: str, prog: str, description: str) -> ArgumentParser:
    """Return what reads the command line of a program with one command."""
    parser = _plain(
        CommandLine(
            prog=prog, description=description, allow_abbrev=False, argument_default=SUPPRESS
        )
    )
    _describe(command, parser)
    return parser


def all_commands(app: App) -> tuple[ArgumentParser, dict[str, ArgumentParser]]:
    """Return what reads command lines, and what reads those of each command."""
    parser = _plain(CommandLine(prog=app.name, description=app.title, allow_abbrev=False))
    what = "say which app this is, which seam it speaks, and by which library it flies"
    parser.add_argument("--version", action=_Version, app=app, nargs=0, help=what)
    adding = parser.add_subparsers(dest="command", metavar="COMMAND", required=True)
    commands = {
        name: _plain(
            adding.add_parser(
                name,
                help=what,
                description=what,
                allow_abbrev=False,
                argument_default=SUPPRESS,  # `Options` has the defaults
            )
        )
        for name, what in COMMANDS.items()
    }
    for name, command in commands.items():
        _describe(name, command)
    return parser, commands


def _describe(name: str, parser: ArgumentParser) -> None:
    """Add what the table has of a command."""
    rows = [one for one in TABLE if name in one.commands.split()]
    known = {one.typed for one in rows}
    groups: dict[str, Any] = {"": parser}
    for one in rows:
        title = f"with {one.only_with}" if one.only_with in known else ""
        if title not in groups:
            groups[title] = parser.add_argument_group(title)
        if one.apart and one.apart not in groups:
            groups[one.apart] = parser.add_mutually_exclusive_group()
        groups[one.apart or title].add_argument(one.typed, help=one.help, **one.how)
    if name in BEGINNINGS:
        add_beginning(groups.get("with --dry-run", parser).add_argument, *BEGINNINGS[name])


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
