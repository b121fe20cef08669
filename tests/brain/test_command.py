"""The command line of a package without the library, and its door to it."""

from __future__ import annotations

import json
import sys
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

from pluto_fleet.app import App
from pluto_fleet.cli import main as with_library
from pluto_fleet.shared import command
from pluto_fleet.shared.domain import app
from pluto_fleet.shared.domain.trace import dumped
from tests.kit import apps
from tests.kit.apps import EXAMPLES
from tests.kit.command import Ran, python
from tests.kit.command import run as within
from tests.library.cli.conftest import MISSIONS
from tests.library.files.an_app import APP

Run = Callable[..., tuple[int, str, str]]


@pytest.fixture
def missions(tmp_path: Path) -> Path:
    """A file of two missions that the default fleet completes."""
    path = tmp_path / "m.toml"
    path.write_text(MISSIONS)
    return path


@pytest.fixture
def run(capsys: pytest.CaptureFixture[str]) -> Run:
    """Runs a command line without the library."""

    def run(*argv: object, app: App = APP) -> tuple[int, str, str]:
        given: Any = app.given
        code = command.alone(app.name, lambda: given, [str(word) for word in argv])
        out, err = capsys.readouterr()
        return code, out, err

    return run


EXTRAS = {"serve": "[station]", "drones": "[crazyflie]", "--plot": "[plot]"}


@pytest.mark.parametrize(
    "what",
    ["size", "fly", "resume", "serve", "drones", "journal", "tell", "decide"],
)
def test_what_needs_the_library_says_so_and_how_to_get_it(run: Run, what: str) -> None:
    """In one sentence, with any other arguments, and without the app's own code."""
    extra = EXTRAS.get(what, "")
    said = (
        f"alfalfa: {what} needs pluto-fleet, the library that flies: "
        f'pip install "pluto-fleet{extra}==0.{app.SEAM}.*" '
        f'(without an index, from Pluto\'s sources: pip install "PLUTO/runtime{extra}")\n'
    )
    assert run(what, "x.toml", "--help") == (2, "", said)

    def load() -> App:
        raise AssertionError

    assert command.alone("alfalfa", load, [what]) == 2


@pytest.mark.parametrize("flag", ["--runs", "--jobs", "--plot"])
def test_flags_that_need_the_library_say_so(run: Run, missions: Path, flag: str) -> None:
    """However they are written."""
    for words in ((flag, "3"), (f"{flag}=3",)):
        code, out, err = run("simulate", missions, *words)
        assert (code, out) == (2, "")
        assert err.startswith(f"alfalfa: {flag} needs pluto-fleet, the library that flies: pip ")


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["fry"], "invalid choice: 'fry'"),
        (["simlate"], "alfalfa: simlate: did you mean simulate?\n"),
        (["reusme"], "alfalfa: reusme: did you mean resume?\n"),
        (["simulate", "m.toml", "--flet=f.toml"], "alfalfa: --flet: did you mean --fleet?\n"),
        ([], "the following arguments are required: COMMAND"),
        (["simulate"], "the following arguments are required: M.toml"),
        (["simulate", "m.toml", "--sed", "1"], "unrecognized arguments: --sed 1"),
        (["simulate", "m.toml", "--seed", "x"], "argument --seed"),
        (["simulate", "m.toml", "--until", "0"], 'argument --until: "0" is not more than 0'),
        (["simulate", "m.toml", "--until", "3 m"], "is a length, not a time"),
        (["simulate", "m.toml", "--fail", "crash"], "is not written like crash=10%"),
        (["simulate", "m.toml", "--fail", "fire=1%"], '"fire" cannot go wrong'),
        (["simulate", "m.toml", "--fail", "crash=200%"], "is not between 0% and 100%"),
        (["simulate", "m.toml", "--fail", "crash=1%,crash=1%"], "crash is given twice"),
    ],
)
def test_wrong_words_are_told_and_exit_2(run: Run, words: Sequence[str], said: str) -> None:
    """As argparse does."""
    code, out, err = run(*words)
    assert (code, out) == (2, "")
    assert said in err


def test_help_and_version(run: Run) -> None:
    """Help names what there is; the version is one line."""
    code, out, err = run("--help")
    assert (code, err) == (0, "")
    assert "check" in out and "simulate" in out
    assert run("--version") == (
        0,
        f"alfalfa (not installed), seam {app.SEAM}, pluto-fleet: not installed\n",
        "",
    )


def test_check_says_that_the_fleet_can_fly_the_missions(
    run: Run, missions: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Just as with the library; without a file it is the missions.toml here."""
    assert run("check", missions) == (
        0,
        "2 missions with 3 trips: a fleet of 5 drones can fly them\n",
        "",
    )
    monkeypatch.chdir(missions.parent)
    assert run("check")[0] == 2
    missions.rename("missions.toml")
    assert run("check")[0] == 0


def test_check_says_what_no_drone_can_fly(
    run: Run, missions: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Where the library does; of the reasons it gives the one that is nearest to being none."""
    missions.write_text(MISSIONS + MORE)
    why = "carrier carries at most 5 g, the item weighs 1 kg"
    who = f'{missions}: mission "heavy", trip 1: no drone of the fleet can do it'
    assert run("check", missions) == (2, "", f"{who}: {why}\n")
    assert with_library(APP, ["check", str(missions)]) == 2
    assert why in capsys.readouterr().err


def test_check_warns_of_what_no_drone_of_the_fleet_can_do(
    run: Run, missions: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Only an evaluator may add such a trip later; with the library it says the same."""
    fleet = missions.with_name("scouts.toml")
    fleet.write_text('[[drone]]\nid = "one"\ncategory = "scout"\nhome = [1, 1]\n')
    missions.write_text('[[mission]]\n[[mission.trip]]\naction = "measure"\ntarget = [6, 3]\n')
    words = ["check", str(missions), "--fleet", str(fleet)]
    code, out, err = run(*words)
    assert (code, out) == (0, "1 mission with 1 trip: a fleet of 1 drone can fly them\n")
    assert f"{fleet}: warning: no drone of the fleet can pollinate: it has no carrier\n" in err
    assert with_library(APP, words) == 0
    assert capsys.readouterr() == (out, err)
    assert "warning" not in run("simulate", *words[1:])[2]


MORE = """
[[mission]]
name = "heavy"
trip = [
  { action = "pick_item", target = [2, 3], item = { name = "stone", mass = 1 } },
  { action = "release_item", target = [2, 3], item = { name = "stone", mass = 1 } },
]
"""


def test_what_repeats_until_stopped_needs_until(run: Run, missions: Path) -> None:
    """It would never end."""
    missions.write_text(missions.read_text().replace('"North"', '"North"\nrepeat = true'))
    code, out, err = run("simulate", missions)
    assert (code, out) == (2, "")
    assert err.startswith(f'{missions}: mission "North" repeats until it is stopped')
    assert run("simulate", missions, "--until", "10 min")[0] == 0
    assert run("check", missions)[0] == 0


def test_the_fleet_beside_the_missions_is_taken_and_that_is_said(run: Run, missions: Path) -> None:
    """Unless another one is named."""
    fleet = missions.with_name("fleet.toml")
    fleet.write_text('[[drone]]\nid = "one"\ncategory = "scout"\nhome = [1, 1]\n')
    code, _, err = run("check", missions)
    assert code == 2  # one scout does not pollinate
    assert err.startswith(f"fleet: {fleet}, beside the missions; or name one: --fleet\n")
    other = fleet.rename(missions.with_name("other.toml"))
    assert "or name one" not in run("check", missions, "--fleet", other)[2]


def test_the_report_says_in_which_world_it_was_flown(run: Run, missions: Path) -> None:
    """The missions, the whole in one line, and the world."""
    assert run("simulate", missions)[1].splitlines()[:-2] == [
        "North: COMPLETED",
        "South: COMPLETED",
    ]
    last, world = run("simulate", missions)[1].splitlines()[-2:]
    assert last.startswith("2 of 2 missions completed in ")
    assert last.endswith(" s (3 flights; 5 drones, 0 crashed)")
    assert world == "flown with each drone alone in the air; with pluto-fleet they keep apart"
    code, out, _ = run("simulate", missions, "--fail", "action=100%", "--no-spread")
    assert code == 1
    assert "\nSouth: FAILED: measure failed: cf5 could not do it at (6, 3)\n" in out


def test_json_is_that_of_the_library_and_says_in_which_world(
    run: Run, missions: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """The same keys, numbers of three decimals, and one key more; for one drone the same numbers."""
    fleet = missions.with_name("one.toml")
    fleet.write_text('[[drone]]\nid = "one"\ncategory = "all"\nhome = [1, 1]\n')
    one = replace(APP.categories[0], name="all", actions=None)
    app = apps.changed(APP, categories=(one,))
    trace = missions.with_name("trace.jsonl")
    for flags in ([], ["--fail", "link=50%,battery=20%"], ["--until", "20 s"]):
        words = ["simulate", str(missions), "--fleet", str(fleet), "--json", "--seed", "4"]
        words += ["--trace", str(trace), *flags]
        code, out, err = run(*words, app=app)
        lines = trace.read_text()
        assert err == ""
        assert with_library(app, words) == code
        data = json.loads(out)
        assert data.pop("world") == "each drone alone in the air"
        assert dumped(data) + "\n" == capsys.readouterr().out
        assert lines == trace.read_text()


# The door


def test_the_library_is_called_where_there_is_one(monkeypatch: pytest.MonkeyPatch) -> None:
    """With the brain's name and the seam that it speaks."""
    told: list[Any] = []

    def called(*given: object, **named: object) -> int:
        told.append((given, named))
        return 2 + len(told)

    library = ModuleType("pluto_fleet.entry")
    vars(library).update(main=called, start=called)
    monkeypatch.setitem(sys.modules, "pluto_fleet.entry", library)
    assert command.main(APP, ["check"]) == 3
    assert command.start("alfalfa", lambda: APP) == 4
    named = {"brain": "plutoc_runtime", "seam": app.SEAM}
    assert told[0] == ((APP, ["check"]), named)
    assert [told[1][0][0], told[1][1]] == ["alfalfa", named]


PROGRAM = """
import sys
sys.path.insert(0, {src!r})
{before}
from {name}.__main__ import main
sys.exit(main())
"""
FLIES = ("simulate", "missions.toml", "--fleet", "fleet.toml")


@pytest.fixture
def package(tmp_path: Path) -> Path:
    """An example, compiled, for a process that finds no library."""
    return apps.compiled("pm10", tmp_path)


def words(package: Path, *given: str, before: str = "") -> list[str]:
    """Return the command line of an example's program: nothing of Pluto's is on its path."""
    source = PROGRAM.format(src=str(package / "src"), name=package.name, before=before)
    return ["-BIS", "-c", source, *given]


def program(package: Path, *given: str) -> Ran:
    """Run it to its end."""
    return python(*words(package, *given), cwd=EXAMPLES / "pm10")


@pytest.mark.process
def test_a_package_alone_checks_and_simulates(package: Path) -> None:
    """Its own program, in a process of its own."""
    assert program(package, "check", *FLIES[1:])[::2] == (0, "")
    flown = program(package, *FLIES, "--json")
    assert (flown.code, flown.err) == (0, "")
    assert json.loads(flown.out)["world"] == "each drone alone in the air"
    assert "fly needs pluto-fleet" in program(package, "fly").err
    assert "pluto-fleet: not installed" in program(package, "--version").out


@pytest.mark.long
@pytest.mark.process
def test_a_library_that_the_package_carries_is_found(package: Path) -> None:
    """It lies beside the brain; one that is broken shows itself."""
    carried = package / "src" / package.name / "_fleet" / "pluto_fleet"
    carried.mkdir(parents=True)
    (carried / "__init__.py").touch()
    start = "def start(name, load, brain, seam):\n    print(name, brain, seam)\n    return 7\n"
    (carried / "entry.py").write_text(start)
    found = program(package, "fly")
    assert (found.code, found.out) == (7, f"pm10 pm10._runtime {app.SEAM}\n")
    (carried / "entry.py").write_text("import no_such_module\n")
    broken = program(package, "fly")
    assert broken.code == 1
    assert "No module named 'no_such_module'" in broken.err


@pytest.mark.parametrize(
    ("error", "code", "said"),
    [
        (KeyboardInterrupt(), 130, "tried: interrupted\n"),
        (OSError(28, "no space"), 2, "tried: the output cannot be written: no space\n"),
        (BrokenPipeError(), 141, ""),
    ],
)
def test_what_ends_a_command_is_told(error: BaseException, code: int, said: str) -> None:
    """However long it would have gone on."""

    def load() -> App:
        raise error

    ran = within(lambda words: command.alone("tried", load, words), "check")
    assert (ran.code, ran.err) == (code, said)


def test_an_error_of_ours_is_no_traceback(capsys: pytest.CaptureFixture[str]) -> None:
    """It says what to do."""

    def load() -> App:
        raise KeyError("ours")

    assert command.alone("tried", load, ["check"]) == 70
    assert capsys.readouterr().err == (
        "tried: internal error: KeyError: 'ours'; please report it"
        " (PLUTO_DEBUG=1 shows where it happened)\n"
    )
