"""`plutoc check`, as a person calls it."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.compiler.cli.conftest import APP, Call, tree

MISTAKE = APP.replace("find_blooms)", "find_bloom)")
ENDLESS = APP.replace("  retry -> end otherwise\n", "")


def test_a_sound_app_ends_with_0_and_writes_nothing(plutoc: Call, app: Path, here: Path) -> None:
    """It says so on standard output."""
    before = tree(here)
    said = plutoc("check", app)
    assert (said.code, said.out, said.err) == (
        0,
        "crop.pluto: no errors, in all 15 states of a mission\n",
        "",
    )
    assert tree(here) == before


def test_errors_end_with_1_and_stand_on_standard_error(plutoc: Call, app: Path) -> None:
    """With file, line and column."""
    app.write_text(MISTAKE)
    said = plutoc("check", app)
    assert said.code == 1
    assert "--> crop.pluto:14:34" in said.err
    assert not said.out


@pytest.mark.parametrize("name", ["missions.toml", "hooks.py"])
def test_what_lies_beside_an_app_is_no_app(plutoc: Call, here: Path, name: str) -> None:
    """It is not parsed: what that would say is of no help."""
    Path(name).touch()
    said = plutoc("check", name)
    assert said.code == 2
    assert f"plutoc: {name} is no app: an app is a file whose name ends with .pluto" in said.err


def test_warnings_end_with_0(plutoc: Call, app: Path) -> None:
    """They are said, and are no errors."""
    app.write_text(ENDLESS)
    said = plutoc("check", app)
    assert said.code == 0
    assert "warning[P20" in said.err


def test_several_files_are_all_checked(plutoc: Call, app: Path) -> None:
    """One report, and the worst of their exit codes."""
    Path("one.pluto").write_text(MISTAKE)
    Path("two.pluto").write_text("pluto 1\napp two {\n")
    said = plutoc("check", "one.pluto", app, "two.pluto")
    assert said.code == 1
    assert said.out == "crop.pluto: no errors, in all 15 states of a mission\n"
    assert "one.pluto:14" in said.err
    assert "two.pluto:2" in said.err
    assert plutoc("check", "one.pluto", "none.pluto", app).code == 2


def test_json_is_one_object_a_line_and_nothing_else(plutoc: Call, app: Path) -> None:
    """On standard output; the format never changes the exit code."""
    app.write_text(MISTAKE)
    said = plutoc("check", app, "--format", "json")
    assert said.code == 1
    assert not said.err
    objects = [json.loads(line) for line in said.out.splitlines()]
    assert {one["code"][:2] for one in objects} == {"P1"}
    app.write_text(APP)
    assert plutoc("check", app, "--format", "json").out == ""


@pytest.mark.parametrize(
    ("variables", "colour"),
    [
        ({}, False),
        ({"FORCE_COLOR": "1"}, True),
        ({"NO_COLOR": "1"}, False),
        ({"NO_COLOR": "1", "FORCE_COLOR": "1"}, False),
        ({"NO_COLOR": "", "FORCE_COLOR": "1"}, True),
    ],
)
def test_colour_is_for_terminals_and_for_who_asks(
    plutoc: Call,
    app: Path,
    monkeypatch: pytest.MonkeyPatch,
    variables: dict[str, str],
    colour: bool,
) -> None:
    """NO_COLOR wins."""
    app.write_text(MISTAKE)
    for name, value in variables.items():
        monkeypatch.setenv(name, value)
    assert ("\x1b[" in plutoc("check", app).err) is colour


def test_without_hooks_there_is_nothing_to_say_about_them(plutoc: Call, app: Path) -> None:
    """The first hooks.py will have all stubs."""
    assert plutoc("check", app).code == 0


def test_hooks_beside_the_app_are_checked(plutoc: Call, app: Path) -> None:
    """They will be the package's."""
    Path("hooks.py").write_text("def pollinate(drone, trip, context, *, dose): ...\n")
    said = plutoc("check", app)
    assert said.code == 1
    assert "`hooks.py` has no `find_blooms`" in said.err
    assert "def find_blooms(mission: Mission, results: Results) -> Verdict:" in said.err


def test_hooks_of_the_package_come_before_those_beside_the_app(plutoc: Call, app: Path) -> None:
    """Once there is a package, its own count."""
    assert plutoc("compile", app).code == 0
    Path("hooks.py").write_text("nothing = 1\n")
    assert plutoc("check", app).code == 0
    own = Path("crop/src/crop/hooks.py")
    own.write_text(own.read_text().replace("def find_blooms", "def find_flowers"))
    said = plutoc("check", app)
    assert said.code == 1
    assert "there is a `find_flowers`" in said.err


def test_hooks_are_never_run(plutoc: Call, app: Path) -> None:
    """Only their syntax tree is read."""
    Path("hooks.py").write_text(
        "open('ran', 'w')\nfrom .mine import find_blooms, pollinate\nraise SystemExit(9)\n"
    )
    assert plutoc("check", app).code == 0
    assert not Path("ran").exists()


def test_hooks_that_are_no_text_end_with_2(plutoc: Call, app: Path) -> None:
    """As any file that cannot be read."""
    Path("hooks.py").write_bytes(b"\xff")
    said = plutoc("check", app)
    assert said.code == 2
    assert "hooks.py is not UTF-8 text" in said.err
