"""The command line of a package without the library, and its door to it."""

from __future__ import annotations

import json
import sys
from collections.abc import Callable
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
from tests.kit.session import check_session, sessions
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


@pytest.mark.parametrize("path", sessions(Path(__file__).parent / "sessions"))
def test_a_command_prints_what_it_should(path: Path, update: bool, tmp_path: Path) -> None:
    given: Any = APP.given
    check_session(
        path,
        {"alfalfa": lambda words: command.alone("alfalfa", lambda: given, words)},
        update,
        tmp_path,
    )


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


@pytest.mark.parametrize("alone", [True, False])
@pytest.mark.parametrize(
    ("when", "start", "seconds"),
    [
        ([], "", 3_660.0 + 30.0),
        (
            ["--date", "2027-03-28", "--zone", "Europe/Rome"],
            "2027-03-28 01:59:30+01:00",
            90.0,
        ),
    ],
)
def test_a_simulation_begins_on_a_date_in_a_zone(
    alone: bool,
    when: list[str],
    start: str,
    seconds: float,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    """It sets out at 03:01, with the library and without it."""
    tested = apps.app(apps.flow(clock=True))
    given: Any = tested.given
    plan = tmp_path / "m.toml"
    trace = tmp_path / "trace.jsonl"
    trip = 'action = "take_photo"\ntarget = [3.0, 1.5]\n'
    plan.write_text(f'[[mission]]\nat = "03:01"\n[[mission.trip]]\n{trip}')
    words = ["simulate", str(plan), "--start", "01:59:30", "--trace", str(trace), *when]
    for further in ([], ["--json"]):
        if alone:
            assert command.alone("tested", lambda: given, [*words, *further]) == 0
        else:
            assert with_library(tested, [*words, *further]) == 0
    out = capsys.readouterr().out
    assert json.loads(out.splitlines()[-1]).get("start", "") == start
    assert (f"starts at {start}" == out.splitlines()[0]) == bool(start)
    events = map(json.loads, trace.read_text().splitlines())
    assert [one["t"] for one in events if one["event"] == "trip.launched"] == [seconds]
