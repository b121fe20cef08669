"""How every command ends, what it loads, and what it does where its output cannot be written."""

from __future__ import annotations

import os
import shutil
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from plutoc.source import Source
from tests.compiler.cli.conftest import tree
from tests.kit.command import environment, plutoc, python

POSIX = pytest.mark.skipif(os.name != "posix", reason="Windows does not send these signals")


def test_an_internal_error_asks_to_be_reported(app: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """It ends with 70 and shows a traceback only to who asks for it."""

    def broken(source: Source) -> None:
        raise ZeroDivisionError("by accident")

    monkeypatch.setattr("plutoc.cli.check.analyse", broken)
    said = plutoc("check", app)
    assert said.code == 70
    assert "internal error (P9001): ZeroDivisionError: by accident" in said.err
    assert "please report" in said.err
    assert "Traceback" not in said.err
    assert "Traceback" in plutoc("check", app, env={"PLUTO_DEBUG": "1"}).err


def test_an_interrupt_ends_with_130(app: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Ctrl-C is no internal error."""

    def interrupted(source: Source) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("plutoc.cli.check.analyse", interrupted)
    assert plutoc("check", app) == (130, "", "plutoc: interrupted\n")


@POSIX
def test_a_folder_that_cannot_be_read_is_told(app: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The others are looked into."""
    Path("b/deep").mkdir(parents=True)
    shutil.move(app, "b/one.pluto")
    scandir = os.scandir

    def refusing(path: str | os.PathLike[str]) -> object:
        if os.fspath(path).endswith("deep"):
            raise PermissionError(13, "Permission denied", os.fspath(path))
        return scandir(path)

    monkeypatch.setattr(os, "scandir", refusing)  # root may read everything
    why = "plutoc: the folder b/deep cannot be read: Permission denied\n"
    said = plutoc("check", "b")
    assert (said.code, said.err) == (2, why)
    assert said.out.startswith("b/one.pluto: no errors")
    assert plutoc("check", "b/deep") == (2, "", why)


LOADED = """
import sys
from plutoc.cli import main
for words in (["check", "crop.pluto"], ["--version"], ["blocks"], ["explain", "P1003"]):
    assert main(words) == 0
heavy = {"black", "jinja2", "asyncio", "argcomplete", "plutoc.cli.completion", "plutoc.diff"}
print("diff" if "plutoc.diff" in sys.modules else "", file=sys.stderr)
print(sorted(heavy & {*sys.modules}), file=sys.stderr)
assert main(["diff", "crop.pluto", "crop.pluto"]) == 0
print("plutoc.cli.revisions" in sys.modules, file=sys.stderr)
"""


@pytest.mark.process
def test_commands_load_only_what_they_need(app: Path) -> None:
    """Formatter and templates where files are made, completion for a shell, Git for a revision."""
    Path("hooks.py").write_text("from x import find_blooms, pollinate\n")
    done = python("-c", LOADED)
    assert (done.code, done.err.splitlines()) == (0, ["", "[]", "False"])


@POSIX
@pytest.mark.process
@pytest.mark.parametrize(
    ("command", "moment", "name"),
    [
        ("compile", "os.rename", "SIGTERM"),
        pytest.param("compile", "os.mkdir", "SIGHUP", marks=pytest.mark.long),
        pytest.param("fmt", "os.replace", "SIGTERM", marks=pytest.mark.long),
    ],
)
def test_who_is_told_to_end_leaves_nothing_half_done(
    app: Path, name: str, command: str, moment: str
) -> None:
    """As a CI job is when it is cancelled, and a shell's when its terminal is closed."""
    app.write_text(app.read_text().replace(" = ", "  =  "))
    before = tree(Path())
    done = python(
        "-c",
        "import os, signal, sys\n"
        "from plutoc.cli import main\n"
        f"before = {moment}\n"
        "def told(*_, **__):\n"
        f"    {moment} = before\n"  # once: what is put back is put back by the same means
        f"    os.kill(os.getpid(), signal.{name})\n"
        f"{moment} = told\n"
        f"sys.exit(main(['{command}', 'crop.pluto']))\n",
        XDG_CACHE_HOME="/dev/null/nowhere",  # nothing else is to be renamed
    )
    assert (done.code, done.err) == (128 + signal.Signals[name], "plutoc: terminated\n")
    assert tree(Path()) == before


@POSIX
@pytest.mark.long
@pytest.mark.process
def test_who_ignores_it_goes_on(app: Path) -> None:
    """With `nohup` a closed terminal is nothing to end for."""
    done = python(
        "-c",
        "import os, signal, sys; from plutoc.cli import check, main;"
        "signal.signal(signal.SIGHUP, signal.SIG_IGN);"
        "before = check.analyse;"
        "check.analyse = lambda _: os.kill(os.getpid(), signal.SIGHUP) or before(_);"
        "sys.exit(main(['check', 'crop.pluto']))",
    )
    assert (done.code, done.err) == (0, "")


@POSIX
@pytest.mark.long
@pytest.mark.process
def test_a_simulation_ends_with_the_command_that_began_it(app: Path) -> None:
    """No process is left behind to go on simulating."""
    Path("hooks.py").write_text(
        "import os, signal\n"
        "async def pollinate(drone, trip, context, *, dose): ...\n"
        "def find_blooms(mission, results):\n"
        "    signal.signal(signal.SIGALRM, lambda *_: open('late', 'w').close())\n"
        "    signal.alarm(30)\n"
        "    os.kill(os.getppid(), signal.SIGTERM)\n"
        "    signal.pause()\n"
    )
    done = python("-m", "plutoc", "run", "crop.pluto")
    assert done.code == 143
    assert done.err.endswith("plutoc: terminated\n")
    assert not Path("late").exists()


def printing_to(target: int, *words: str) -> tuple[int, str]:
    """Call `plutoc` as a process whose standard output goes there: its exit code, its standard error."""
    done = subprocess.run(
        [sys.executable, "-m", "plutoc", *words],
        env=environment(),
        stdout=target,
        stderr=subprocess.PIPE,
        text=True,
        check=False,
    )
    return done.returncode, done.stderr


LONG = pytest.mark.long
SHOWN = [
    ["graph", "crop.pluto"],
    pytest.param(["--version"], marks=LONG),
    pytest.param(["check", "bad.pluto", "--format", "json"], marks=LONG),
    pytest.param(["check", "bad.pluto", "--format", "sarif"], marks=LONG),
]
"""What is printed line by line, by argparse, and as a report."""


@pytest.mark.long
@pytest.mark.process
@pytest.mark.parametrize("words", SHOWN)
def test_a_closed_pipe_is_silent(app: Path, words: list[str]) -> None:
    """`plutoc graph | head -0` says nothing."""
    Path("bad.pluto").write_text(app.read_text().replace("find_blooms)", "find_bloom)"))
    reading, writing = os.pipe()
    os.close(reading)
    with os.fdopen(writing, "w"):
        assert printing_to(writing, *words) == (141, "")


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="only Linux has a disk that is full")
@pytest.mark.process
@pytest.mark.parametrize("words", SHOWN)
def test_a_full_disk_behind_standard_output_is_said(app: Path, words: list[str]) -> None:
    """What cannot be printed is an error, not a traceback."""
    Path("bad.pluto").write_text(app.read_text().replace("find_blooms)", "find_bloom)"))
    with open("/dev/full", "w") as full:
        said = "plutoc: the output cannot be written: No space left on device\n"
        assert printing_to(full.fileno(), *words) == (2, said)
