"""The commands and their flags."""

from __future__ import annotations

import sys
from argparse import SUPPRESS, Action, ArgumentParser, ArgumentTypeError
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from plutoc import __version__
from plutoc.cli.endings import USAGE
from plutoc_runtime import output
from plutoc_runtime.command_line import CommandLine

FORMATS = ("text", "json", "github", "sarif")
CHANGES = ("text", "markdown", "json")
PICTURES = ("mermaid", "dot", "svg", "json")


@dataclass(
    repr=False, eq=False
)  # no slots: argparse puts what it does not know into the object's own dictionary
class Options:
    """What was asked for."""

    command: str = ""
    name: str = ""
    example: str | None = None
    file: Path = field(default_factory=Path)
    files: list[Path] = field(default_factory=list)
    format: str = "text"
    picture: str = PICTURES[0]
    folder: Path | None = None
    check: bool = False
    diff: bool = False
    fix: bool = False
    force: bool = False
    add_stubs: bool = False
    carry: str | None = None
    plain: bool = False
    show: str | None = None
    missions: Path | None = None
    fleet: Path | None = None
    seed: int | None = None
    seeds: int | None = None
    runs: str | None = None
    fail: str | None = None
    until: str | None = None
    strike: str | None = None
    weather: str | None = None
    json: bool = False
    old: Path = field(default_factory=Path)
    new: Path = field(default_factory=Path)
    exit_code: bool = False
    host: str = "127.0.0.1"
    port: int = 0
    no_open: bool = False
    kind: str | None = None
    code: str | None = None


def parse(arguments: Sequence[str]) -> Options:
    """Read the command line; raise SystemExit, as argparse does, after help or an error."""
    parser = all_commands()
    if not arguments:
        parser.print_help(sys.stderr)
        raise SystemExit(USAGE)
    return parser.parse_args(arguments, namespace=Options())


def all_commands() -> ArgumentParser:
    """Return what knows every command, and its flags."""
    parser = _plain(
        CommandLine(
            prog="plutoc",
            description="Turns graphs of drone missions into Python packages that fly them.",
            epilog="`plutoc COMMAND --help` says more about a command.",
            allow_abbrev=False,
        )
    )
    parser.add_argument("--version", action=_Version, help="print the version and end")
    commands = parser.add_subparsers(
        dest="command", metavar="COMMAND", title="commands", required=True
    )
    for name, (what, describe) in _COMMANDS.items():
        describe(_plain(commands.add_parser(name, help=what, description=what, allow_abbrev=False)))
    return parser


class _Printing(Action):
    """What is printed in the place of a command. Not argparse's own: that says nothing of a full disk."""

    def __init__(self, option_strings: Sequence[str], dest: str, help: str) -> None:
        super().__init__(option_strings, SUPPRESS, nargs=0, default=SUPPRESS, help=help)

    def __call__(self, parser: ArgumentParser, *_: object) -> None:
        output.line(self.text())
        parser.exit()

    def text(self) -> str:
        raise NotImplementedError


class _Version(_Printing):
    def text(self) -> str:
        return f"plutoc {__version__}"


class _Examples(_Printing):
    def text(self) -> str:
        from plutoc.cli.examples import listing

        return listing()


def _plain(parser: ArgumentParser) -> ArgumentParser:
    vars(parser)["color"] = False  # from Python 3.14 on it would be True
    return parser


def _file(parser: ArgumentParser) -> None:
    parser.add_argument("file", metavar="FILE", type=Path, help="the app, a .pluto file")


def _format(parser: ArgumentParser) -> None:
    parser.add_argument(
        "--format",
        choices=FORMATS,
        default=FORMATS[0],
        help="how to report: text on standard error (default), or for programs on standard output",
    )


def _fleet(parser: ArgumentParser) -> None:
    parser.add_argument(
        "--fleet",
        metavar="F.toml",
        type=Path,
        help="the map and the drones (default: fleet.toml beside the missions or the app)",
    )


def _writes_nothing(parser: ArgumentParser) -> None:
    parser.add_argument(
        "--check", action="store_true", help="write nothing; exit with 1 if something would change"
    )
    parser.add_argument(
        "--diff", action="store_true", help="write nothing; print what would change"
    )


def _new(parser: ArgumentParser) -> None:
    parser.add_argument("name", metavar="NAME", help="the app's name, such as crop_watch")
    parser.add_argument(
        "--from",
        dest="example",
        metavar="EXAMPLE",
        help="begin with one of the examples, its missions, its fleet and its hooks",
    )
    parser.add_argument("--list", action=_Examples, help="print the examples, and end")


def _check(parser: ArgumentParser) -> None:
    parser.add_argument(
        "files",
        metavar="FILE",
        type=Path,
        nargs="+",
        help="apps, .pluto files, or folders of them; - for standard input",
    )
    parser.add_argument(
        "--fix", action="store_true", help="change what can be mended for certain, then check"
    )
    _format(parser)


def _package(parser: ArgumentParser) -> None:
    _file(parser)
    parser.add_argument(
        "-o",
        dest="folder",
        metavar="DIR",
        type=Path,
        help="the package's folder (default: one named after the app, beside the file)",
    )
    parser.add_argument(
        "--carry",
        choices=["fleet"],
        help="put the library that flies into the package, too, where a second distribution may not be"
        " installed; to be given each time",
    )
    parser.add_argument("-O0", dest="plain", action="store_true", help="do not optimise the plan")


def _compile(parser: ArgumentParser) -> None:
    _package(parser)
    _writes_nothing(parser)
    parser.add_argument(
        "--force", action="store_true", help="overwrite files of ours that were edited by hand"
    )
    parser.add_argument(
        "--add-stubs", action="store_true", help="add the hooks that are missing to hooks.py"
    )
    parser.add_argument(
        "--show",
        type=_shown,
        metavar="WHAT",
        help="write nothing; print the checked `graph` or the `plan`; `plan=PASS` is the plan after "
        "that pass, `plan=built` the one before all",
    )
    _format(parser)


def _run(parser: ArgumentParser) -> None:
    _file(parser)
    parser.add_argument(
        "--missions",
        metavar="M.toml",
        type=Path,
        help="the missions file (default: missions.toml beside the app)",
    )
    _fleet(parser)
    parser.add_argument(
        "--seed", metavar="N", type=_whole, help="what chance depends on (default 0)"
    )
    parser.add_argument(
        "--fail",
        metavar="WHAT=SHARE,…",
        type=_mishaps,
        help="let flights go wrong: crash, link, action, battery; such as crash=10%%,link=1%%",
    )
    parser.add_argument(
        "--runs",
        metavar="N",
        type=_count,
        help="simulate N times, with N seeds from --seed on",
    )
    parser.add_argument(
        "--until",
        metavar="TIME",
        type=_time,
        help='stop at this simulated time, such as "2 h"',
    )
    parser.add_argument("--json", action="store_true", help="print one JSON object instead")


def _test(parser: ArgumentParser) -> None:
    _file(parser)
    parser.add_argument(
        "--seeds", metavar="N", type=_whole, help="how many times to draw chance anew (default 100)"
    )
    parser.add_argument(
        "--seed", metavar="N", type=_whole, help="what chance depends on the first time (default 0)"
    )
    parser.add_argument(
        "--missions",
        metavar="M.toml",
        type=Path,
        help="try with these missions (default: small ones at random that fit the app)",
    )
    _fleet(parser)
    parser.add_argument(
        "--strike",
        metavar="WHAT@ROW,…",
        help="one case: what strikes at which row of the journal, such as crash@12,rtl@15",
    )
    parser.add_argument(
        "--weather",
        metavar="WHAT=HOW,…",
        help="one case: what goes wrong by itself, such as link=0.1,slow=0.4",
    )
    parser.add_argument("--json", action="store_true", help="print one JSON object instead")


def _fmt(parser: ArgumentParser) -> None:
    parser.add_argument(
        "files",
        metavar="FILE",
        type=Path,
        nargs="+",
        help="apps, .pluto files, or folders of them; - for standard input, with the result on standard output",
    )
    _writes_nothing(parser)


def _graph(parser: ArgumentParser) -> None:
    _file(parser)
    parser.add_argument(
        "--format",
        dest="picture",
        choices=PICTURES,
        default=PICTURES[0],
        help="how to draw it (default: %(default)s)",
    )


def _edit(parser: ArgumentParser) -> None:
    _file(parser)
    parser.add_argument(
        "--port", metavar="N", type=_whole, default=0, help="the port (default: any that is free)"
    )
    parser.add_argument(
        "--host",
        metavar="H",
        default="127.0.0.1",
        help="the address to listen at (default: this machine alone reaches it)",
    )
    parser.add_argument(
        "--no-open", action="store_true", help="print the address, and open no browser"
    )


def _diff(parser: ArgumentParser) -> None:
    parser.add_argument(
        "old",
        metavar="OLD",
        type=Path,
        help="the app as it was: a .pluto file, the folder of one, - for standard input, or a revision"
        " of NEW that Git knows, such as HEAD~1",
    )
    parser.add_argument(
        "new", metavar="NEW", type=Path, help="the app as it is now: a file, a folder or -"
    )
    parser.add_argument(
        "--format",
        choices=CHANGES,
        default=CHANGES[0],
        help="how to report (default: %(default)s)",
    )
    parser.add_argument(
        "--exit-code", action="store_true", help="end with 1 if something changed in meaning"
    )


def _blocks(parser: ArgumentParser) -> None:
    parser.add_argument("kind", metavar="KIND", nargs="?", help="one block, to read about it")


def _explain(parser: ArgumentParser) -> None:
    parser.add_argument(
        "code", metavar="CODE", nargs="?", help="such as P1003; without one, all are listed"
    )


def _lsp(parser: ArgumentParser) -> None:
    parser.add_argument(
        "--stdio", action="store_true", help="as it does anyway; some editors say so"
    )


def _shown(text: str) -> str:
    if text not in ("graph", "plan") and not text.startswith("plan="):
        raise ArgumentTypeError(f"{text!r} is neither graph nor plan nor plan=PASS")
    return text


def _mishaps(text: str) -> str:
    from plutoc_runtime.alone.world import shares  # only `run` asks

    return _handed_on(shares, text)


def _time(text: str) -> str:
    from plutoc_runtime.domain.quantities import time_from

    return _handed_on(time_from, text)


def _count(text: str) -> str:
    from plutoc_runtime.domain.text import quoted

    if _whole(text) < 1:
        raise ArgumentTypeError(f"{quoted(text)} is less than 1")
    return text


def _handed_on(read: Callable[[str], object], text: str) -> str:
    """Refuse what the app's own `simulate` would refuse; hand on the rest as it was typed."""
    try:
        read(text)
    except ValueError as error:
        raise ArgumentTypeError(str(error)) from None
    return text


def _whole(text: str) -> int:
    from plutoc_runtime.domain.quantities import typed, whole

    return typed(whole)(text)


_COMMANDS: dict[str, tuple[str, Callable[[ArgumentParser], None]]] = {
    "new": ("Make a folder with a small app, or an example, to begin with.", _new),
    "check": ("Say what is wrong with apps; with --fix, mend what is certain.", _check),
    "compile": ("Write the Python package of an app.", _compile),
    "watch": ("Compile an app whenever it is saved; say what changed in meaning.", _package),
    "run": ("Compile an app and simulate its missions at once.", _run),
    "test": ("Try an app under everything that can go wrong.", _test),
    "fmt": ("Write sources in canonical form; comments and meaning are kept.", _fmt),
    "graph": ("Print the picture of an app, with the statuses on every edge.", _graph),
    "edit": ("Edit an app's graph in a browser, beside its text.", _edit),
    "diff": ("Say in words what changed in meaning from one app to another.", _diff),
    "blocks": ("List the blocks that are installed, or explain one.", _blocks),
    "lsp": ("Serve an editor: the language server, on standard input and output.", _lsp),
    "explain": ("Say what the code of an error or a warning means.", _explain),
}
