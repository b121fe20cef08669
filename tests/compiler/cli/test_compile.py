"""`plutoc compile`: what becomes of the files; what is said of it is in sessions."""

from __future__ import annotations

from pathlib import Path

import pytest

from plutoc.emit import lock, write
from tests.compiler.cli.conftest import APP, tree
from tests.kit.command import command, plutoc

FLOW, HOOKS, LOCK = Path("crop/src/crop/flow.py"), Path("crop/src/crop/hooks.py"), "crop/pluto.lock"
CHANGED = APP.replace("max_attempts: 3", "max_attempts: 5")


def test_compiling_again_changes_nothing(app: Path, here: Path) -> None:
    """Not even a file's time."""
    plutoc("compile", app)
    before, times = tree(here), FLOW.stat().st_mtime_ns
    assert plutoc("compile", app).code == 0
    assert tree(here) == before
    assert FLOW.stat().st_mtime_ns == times


def test_looking_writes_nothing(app: Path, here: Path) -> None:
    """Neither `--check`, nor `--diff`, nor `--show`, whether there is something to write or not."""
    for text in (APP, CHANGED):
        app.write_text(text)
        before = tree(here)
        for flags in (["--check"], ["--diff"], ["--show", "graph"], ["--show", "plan"]):
            plutoc("compile", app, *flags)
            assert tree(here) == before
        app.write_text(APP)
        plutoc("compile", app)


@pytest.mark.long
@pytest.mark.process
def test_the_patch_of_diff_makes_the_package(app: Path, here: Path) -> None:
    """Git understands it."""
    plutoc("compile", app, "-o", "wanted")
    Path("patch").write_text(plutoc("compile", app, "--diff").out)
    Path("crop").mkdir()
    assert command("git", "apply", "../patch", cwd=Path("crop")).code == 0
    assert tree(here / "crop") == tree(here / "wanted")


def test_line_ends_that_git_changed_are_no_hand_edit(app: Path) -> None:
    """A checkout on Windows may have carriage returns; so may hooks.py, and a mark, beside the app."""
    plutoc("compile", app)
    FLOW.write_bytes(FLOW.read_bytes().replace(b"\n", b"\r\n"))
    Path("hooks.py").write_bytes(b"\xef\xbb\xbf" + HOOKS.read_bytes().replace(b"\n", b"\r\n"))
    assert plutoc("compile", app, "--check") == (0, "crop: up to date\n", "")


@pytest.mark.parametrize(
    ("made_by", "code"),
    [
        ('plutoc = "0.1.1.dev3"', 3),
        ('plutoc = "0.1.0.post1"', 3),
        ('plutoc = "0.1.10"\nsurvey = "survey 2.0"', 3),
        ('plutoc = "0.1.0rc1"\nsurvey = "survey 2.0"', 0),
        ('plutoc = "0.0.99"', 0),
        ("", 0),
    ],
)
def test_what_a_newer_plutoc_made_is_not_overwritten(
    app: Path, monkeypatch: pytest.MonkeyPatch, made_by: str, code: int
) -> None:
    """The order of versions is that of PEP 440; a lock that says none stops no compile."""
    for module in (lock, write):
        monkeypatch.setattr(module, "__version__", "0.1.0")
    plutoc("compile", app)
    text = Path(LOCK).read_text().replace('plutoc = "0.1.0"\n', f"{made_by}\n")
    Path(LOCK).write_text(text)
    assert plutoc("compile", app).code == code
    assert (Path(LOCK).read_text() == text) is (code == 3)


@pytest.mark.parametrize("name", ["a" * 300, "/".join(["a" * 300] * 20), "in/" + "b" * 300])
def test_a_place_that_cannot_be_is_told_in_a_sentence(name: str, app: Path) -> None:
    """And no folder is left on the way to it."""
    said = plutoc("compile", app, "-o", name)
    assert said.code == 2
    assert "File name too long" in said.err
    assert not Path("in").exists()


def test_the_plan_after_each_pass_can_be_shown(app: Path) -> None:
    """`built` is the plan before all, which `-O0` keeps."""
    built = plutoc("compile", app, "--show", "plan=built").out
    assert built.startswith("plan crop\n")
    assert plutoc("compile", app, "-O0", "--show", "plan").out == built
    assert plutoc("compile", app, "--show", "plan=decided").out != built


def test_the_plain_plan_can_be_asked_for(app: Path) -> None:
    """With `-O0` every fork is tasks; without, a wait for the trip's end is a single one."""
    assert plutoc("compile", app, "-O0").code == 0
    plain = FLOW.read_text()
    assert plutoc("compile", app).code == 0
    assert ("watch_trip(" in plain, "watch_trip(" in FLOW.read_text()) == (True, False)
