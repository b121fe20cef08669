"""The command line as a whole: help, wrong usage, files that cannot be read, how it ends."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from plutoc.source import Source
from tests.compiler.cli.conftest import Call, tree


def test_alone_it_prints_the_help_and_is_wrong_usage(plutoc: Call) -> None:
    """`plutoc` without a command shows the commands."""
    said = plutoc()
    assert said.code == 2
    assert "compile" in said.err
    assert not said.out


@pytest.mark.parametrize(
    "command", ["new", "check", "compile", "watch", "run", "fmt", "graph", "blocks", "explain"]
)
def test_every_command_has_help(plutoc: Call, command: str) -> None:
    """`--help` ends with 0."""
    said = plutoc(command, "--help")
    assert said.code == 0
    assert said.out.startswith(f"usage: plutoc {command}")


def test_version_is_printed(plutoc: Call) -> None:
    """`--version` says who we are."""
    said = plutoc("--version")
    assert said.code == 0
    assert said.out.startswith("plutoc")


@pytest.mark.parametrize(
    "arguments",
    [
        ["fly"],
        ["check"],
        ["compile"],
        ["check", "a.pluto", "--format", "xml"],
        ["graph", "a.pluto", "--format", "png"],
        ["compile", "a.pluto", "--chek"],
        ["run", "a.pluto", "--seed", "many"],
        ["new"],
    ],
)
def test_wrong_usage_ends_with_2(plutoc: Call, arguments: list[str]) -> None:
    """What argparse refuses, and what is not offered yet."""
    said = plutoc(*arguments)
    assert said.code == 2
    assert "usage: plutoc" in said.err


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["chek", "app.pluto"], "invalid choice: 'chek'"),
        (["chek", "app.pluto"], "; did you mean check?\n"),
        (
            ["check", "--fxi"],
            "plutoc check: error: there is no option --fxi; did you mean --fix?\n",
        ),
        (
            ["run", "a", "--mission=m.toml"],
            "there is no option --mission; did you mean --missions?",
        ),
        (["--verison"], "plutoc: error: there is no option --verison; did you mean --version?\n"),
        (["check", "a", "--format", "jsn"], "; did you mean json?\n"),
        (["check", "a", "--nonsense"], "unrecognized arguments: --nonsense\n"),
        (["check", "--", "--fxi"], "plutoc: there is no file --fxi\n"),  # a file of that name
    ],
)
def test_what_is_misspelt_is_told_with_what_was_meant(
    plutoc: Call, arguments: list[str], said: str
) -> None:
    """Even where something else is missing, too."""
    ending = plutoc(*arguments)
    assert ending.code == 2
    assert said in ending.err


@pytest.mark.parametrize("command", ["check", "compile", "run", "graph"])
def test_files_that_cannot_be_read_end_with_2(plutoc: Call, here: Path, command: str) -> None:
    """Each is named, with what is wrong."""
    (here / "folder.pluto").mkdir()
    (here / "latin.pluto").write_bytes(b"pluto 1\n# caf\xe9\n")
    (here / "large.pluto").write_bytes(b"#" * ((1 << 20) + 1))
    (here / "missions.toml").touch()
    for name, why in {
        "none.pluto": "there is no file none.pluto",
        "folder.pluto": "holds no app" if command == "check" else "is a folder, not a file",
        "latin.pluto": "is not UTF-8 text: see line 2",
        "large.pluto": "is larger than 1024 KiB",
        "crop.pluto/a.pluto": "there is no file",
    }.items():
        said = plutoc(command, name)
        assert said.code == 2, name
        assert why in said.err
        assert said.err.startswith("plutoc: ")
        assert not said.out


def test_a_file_name_cannot_command_the_terminal(plutoc: Call, here: Path) -> None:
    """Control characters in it are shown as numbers."""
    said = plutoc("check", "a\x1b[2J.pluto")
    assert said.code == 2
    assert "\x1b" not in said.err


def test_an_internal_error_asks_to_be_reported(
    plutoc: Call, app: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It ends with 70 and shows a traceback only to who asks for it."""

    def broken(source: Source) -> None:
        raise ZeroDivisionError("by accident")

    monkeypatch.setattr("plutoc.cli.check.analyse", broken)
    said = plutoc("check", app)
    assert said.code == 70
    assert "internal error (P9001): ZeroDivisionError: by accident" in said.err
    assert "please report" in said.err
    assert "Traceback" not in said.err
    monkeypatch.setenv("PLUTO_DEBUG", "1")
    assert "Traceback" in plutoc("check", app).err


def test_an_interrupt_ends_with_130(
    plutoc: Call, app: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Ctrl-C is no internal error."""

    def interrupted(source: Source) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("plutoc.cli.check.analyse", interrupted)
    said = plutoc("check", app)
    assert said.code == 130
    assert said.err == "plutoc: interrupted\n"


@pytest.mark.skipif(os.name != "posix", reason="Windows does not send these signals")
@pytest.mark.parametrize("name", ["SIGTERM", "SIGHUP"])
@pytest.mark.parametrize(
    ("command", "moment"),
    [("fmt", "os.replace"), ("compile", "os.rename"), ("compile", "os.mkdir")],
)
def test_who_is_told_to_end_leaves_nothing_half_done(
    app: Path, monkeypatch: pytest.MonkeyPatch, name: str, command: str, moment: str
) -> None:
    """As a CI job is when it is cancelled, and a shell's when its terminal is closed."""
    monkeypatch.setenv("XDG_CACHE_HOME", "/dev/null/nowhere")  # nothing else is to be renamed
    app.write_text(app.read_text().replace(" = ", "  =  "))
    before = tree(Path())
    done = python(
        "import os, signal, sys\n"
        "from plutoc.cli import main\n"
        f"before = {moment}\n"
        "def told(*_, **__):\n"
        f"    {moment} = before\n"  # once: what is put back is put back by the same means
        f"    os.kill(os.getpid(), signal.{name})\n"
        f"{moment} = told\n"
        f"sys.exit(main(['{command}', 'crop.pluto']))\n"
    )
    assert (done.returncode, done.stderr) == (128 + signal.Signals[name], "plutoc: terminated\n")
    assert tree(Path()) == before


@pytest.mark.skipif(os.name != "posix", reason="Windows does not send these signals")
def test_who_ignores_it_goes_on(app: Path) -> None:
    """With `nohup` a closed terminal is nothing to end for."""
    done = python(
        "import os, signal, sys; from plutoc.cli import check, main;"
        "signal.signal(signal.SIGHUP, signal.SIG_IGN);"
        "before = check.analyse;"
        "check.analyse = lambda _: os.kill(os.getpid(), signal.SIGHUP) or before(_);"
        "sys.exit(main(['check', 'crop.pluto']))"
    )
    assert (done.returncode, done.stderr) == (0, "")


@pytest.mark.skipif(os.name != "posix", reason="Windows does not send these signals")
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
    done = python("import sys; from plutoc.cli import main; sys.exit(main(['run', 'crop.pluto']))")
    assert done.returncode == 143
    assert done.stderr.endswith("plutoc: terminated\n")
    assert not Path("late").exists()


def python(code: str, *arguments: str) -> subprocess.CompletedProcess[str]:
    """Run Python with our own path."""
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
    return subprocess.run(
        [sys.executable, "-c", code, *arguments],
        env=environment,
        capture_output=True,
        text=True,
        check=False,
    )


@pytest.mark.parametrize("arguments", [["check", "crop.pluto"], ["--version"], ["blocks"]])
def test_light_commands_import_nothing_heavy(app: Path, arguments: list[str]) -> None:
    """Formatter and templates are loaded only where files are made."""
    Path("hooks.py").write_text("def pollinate(): pass\n")  # even where stubs are shown
    done = python(
        "import sys; from plutoc.cli import main; main(sys.argv[1:]);"
        "print([name for name in ('black', 'jinja2', 'asyncio') if name in sys.modules])",
        *arguments,
    )
    assert done.stdout.splitlines()[-1] == "[]", done.stderr


def test_a_closed_pipe_is_silent(app: Path) -> None:
    """`plutoc graph | head -0` says nothing."""
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
    reading, writing = os.pipe()
    os.close(reading)
    done = subprocess.run(
        [sys.executable, "-m", "plutoc", "graph", "crop.pluto"],
        env=environment,
        stdout=writing,
        stderr=subprocess.PIPE,
        text=True,
        check=False,
    )
    os.close(writing)
    assert done.returncode == 141
    assert not done.stderr


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="only Linux has a disk that is full")
@pytest.mark.parametrize("arguments", [["graph", "crop.pluto"], ["--version"]])
@pytest.mark.parametrize("unbuffered", ["", "1"])
def test_a_full_disk_behind_standard_output_is_said(
    app: Path, arguments: list[str], unbuffered: str
) -> None:
    """What cannot be printed is an error, not a traceback."""
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
    environment["PYTHONUNBUFFERED"] = unbuffered
    with open("/dev/full", "w") as full:
        done = subprocess.run(
            [sys.executable, "-m", "plutoc", *arguments],
            env=environment,
            stdout=full,
            stderr=subprocess.PIPE,
            text=True,
            check=False,
        )
    assert done.returncode == 2
    assert done.stderr == "plutoc: the output cannot be written: No space left on device\n"
