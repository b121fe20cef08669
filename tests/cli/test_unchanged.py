"""Where nothing at all has changed, nothing is compiled; whatever has changed is noticed."""

from __future__ import annotations

import os
import shutil
import sys
from collections.abc import Callable
from importlib.abc import MetaPathFinder
from importlib.machinery import ModuleSpec
from importlib.util import spec_from_file_location
from pathlib import Path

import pytest

from plutoc import cli
from plutoc.cli import compiler, unchanged
from plutoc.cli.options import Options
from plutoc.emit import modules
from tests.cli.conftest import APP, FIELD_APP, Call, Said, tree

FLOW, HOOKS = Path("crop/src/crop/flow.py"), Path("crop/src/crop/hooks.py")
WARNED = APP.replace("  retry -> end otherwise\n", "").replace("attempts: 3", "attempts: 0")

BLOCK = """
from plutoc.block import ANY_SAME, Block
from field_step import chime
BLOCKS = [Block(name="Chime", doc="Chimes.", step=chime, transitions=ANY_SAME)]
"""


class Editable(MetaPathFinder):
    """Finds a package that is in no folder on Python's path, as an editable install may do."""

    def __init__(self, package: Path) -> None:
        self.package = package

    def find_spec(
        self, fullname: str, path: object = None, target: object = None
    ) -> ModuleSpec | None:
        """Return where the package is, if it is this one that is asked for."""
        init = self.package / "__init__.py"
        return spec_from_file_location(fullname, init) if fullname == self.package.name else None


@pytest.fixture
def runs(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """The commands that were really run."""
    ran: list[str] = []
    run = cli._run

    def running(options: Options) -> int:
        ran.append(options.command)
        return run(options)

    monkeypatch.setattr(cli, "_run", running)
    return ran


@pytest.fixture(autouse=True)
def shelf(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An empty cache."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    return tmp_path / "cache/pluto" / unchanged.SHELF


def again(plutoc: Call, runs: list[str], *arguments: str | Path) -> tuple[Said, bool]:
    """Call once more; return what is said, and whether anything was compiled."""
    runs.clear()
    said = plutoc("compile", *arguments)
    return said, bool(runs)


def test_a_second_compile_does_nothing(plutoc: Call, app: Path, runs: list[str]) -> None:
    """And says the same as one that compiles again."""
    plutoc("compile", app)
    before = tree(Path("crop"))
    said, compiled = again(plutoc, runs, app)
    assert (said, compiled) == (Said(0, "crop: up to date\n", ""), False)
    assert tree(Path("crop")) == before


@pytest.mark.parametrize("option", ["--check", "--diff", "--force", "--add-stubs", "-O0"])
def test_every_option_is_remembered_by_itself(
    plutoc: Call, app: Path, runs: list[str], option: str
) -> None:
    """What one has left is nothing to the others."""
    plutoc("compile", app)
    _, compiled = again(plutoc, runs, app, option)
    assert compiled
    first, _ = again(plutoc, runs, app, option)
    second, compiled = again(plutoc, runs, app, option)
    assert not compiled
    assert second == first
    assert second.out == ("" if option == "--diff" else "crop: up to date\n")


@pytest.mark.parametrize("colour", ["NO_COLOR", "FORCE_COLOR"])
@pytest.mark.parametrize("format", ["text", "json", "github", "sarif"])
def test_the_words_are_those_of_a_compile(
    plutoc: Call,
    app: Path,
    runs: list[str],
    format: str,
    colour: str,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Warnings are told each time, in every format, and in colour where that is wanted."""
    app.write_text(WARNED)
    monkeypatch.setenv(colour, "1")
    plutoc("compile", app, "--format", format)
    remembered, compiled = again(plutoc, runs, app, "--format", format)
    assert not compiled
    with monkeypatch.context() as patch:
        patch.setattr(unchanged, "_file", lambda arguments: None)
        told, compiled = again(plutoc, runs, app, "--format", format)
    assert compiled
    assert remembered == told
    assert "P20" in told.out + told.err
    assert ("\x1b[" in told.err) == (colour == "FORCE_COLOR" and format == "text")


def edit(path: Path) -> None:
    """Change a letter, and let neither the size nor the time tell."""
    facts = path.stat()
    text = path.read_text()
    path.write_text(text[:-2] + ("x" if text[-2] != "x" else "y") + text[-1:])
    os.utime(path, ns=(facts.st_atime_ns, facts.st_mtime_ns))
    assert (path.stat().st_size, path.stat().st_mtime_ns) == (facts.st_size, facts.st_mtime_ns)


def write(path: Path, text: str, time: int = 1) -> None:
    """Write a file of blocks, long ago."""
    path.write_text(text)
    os.utime(path, (time, time))


def become_link(path: Path) -> None:
    """Put a link in place of a file or folder, to another with the same content."""
    moved = path.with_name(f"moved_{path.name}")
    path.rename(moved)
    path.symlink_to(moved.name)


def become_folder(path: Path) -> None:
    """Put a folder in place of a file."""
    path.unlink()
    path.mkdir()


CHANGES: dict[str, Callable[[], object]] = {
    "a comment in the app": lambda: Path("crop.pluto").write_text(f"{APP}# more\n"),
    "another setting": lambda: Path("crop.pluto").write_text(
        APP.replace("attempts: 3", "attempts: 4")
    ),
    "no app any more": lambda: Path("crop.pluto").unlink(),
    "a comment in hooks.py": lambda: HOOKS.write_text(f"{HOOKS.read_text()}\n# mine\n"),
    "no hooks.py any more": HOOKS.unlink,
    "a hand edit of the same size and time": lambda: edit(FLOW),
    "a hand edit of the runtime": lambda: edit(Path("crop/src/crop/_runtime/__init__.py")),
    "a hand edit of the lock": lambda: edit(Path("crop/pluto.lock")),
    "a file that is gone": Path("crop/README.md").unlink,
    "a file of the user's that is gone": Path("crop/tests/test_hooks.py").unlink,
    "a package that is gone": lambda: shutil.rmtree("crop"),
    "a link in place of a file": lambda: become_link(FLOW),
    "a link in place of a folder": lambda: become_link(FLOW.parent),
    "a link in place of the package": lambda: become_link(Path("crop")),
    "a folder in place of a file": lambda: become_folder(FLOW),
}


@pytest.mark.parametrize("change", CHANGES.values(), ids=CHANGES)
def test_every_change_is_noticed(
    plutoc: Call, app: Path, runs: list[str], change: Callable[[], object]
) -> None:
    """Then it is compiled, and what is to be said of it is said."""
    plutoc("compile", app)
    plutoc("compile", app)
    change()
    _, compiled = again(plutoc, runs, app)
    assert compiled


def test_a_pipe_in_place_of_the_app_is_not_waited_for(
    plutoc: Call, app: Path, runs: list[str]
) -> None:
    """Nobody writes into it."""
    if not hasattr(os, "mkfifo"):
        pytest.skip("there are no pipes with names here")
    plutoc("compile", app)
    app.unlink()
    os.mkfifo(app)
    _, compiled = again(plutoc, runs, app)
    assert compiled


def test_line_ends_as_git_may_have_them_are_no_change(
    plutoc: Call, app: Path, runs: list[str]
) -> None:
    """Nor are they to a compile."""
    plutoc("compile", app)
    for path in (FLOW, HOOKS):
        path.write_bytes(path.read_bytes().replace(b"\n", b"\r\n"))
    said, compiled = again(plutoc, runs, app)
    assert (said.out, compiled) == ("crop: up to date\n", False)


def test_another_folder_is_another_package(plutoc: Call, app: Path, runs: list[str]) -> None:
    """Wherever the command is given."""
    plutoc("compile", app)
    _, compiled = again(plutoc, runs, app, "-o", "other")
    assert compiled
    Path("elsewhere").mkdir()
    shutil.copy(app, "elsewhere")
    os.chdir("elsewhere")
    said, compiled = again(plutoc, runs, app)
    assert compiled
    assert "a new package" in said.out


@pytest.mark.parametrize("which", ["OURS", "TOOLS"])
def test_an_upgraded_compiler_compiles(
    plutoc: Call,
    app: Path,
    runs: list[str],
    which: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """A package of its own, or one that it works with, in another release or edited in place."""
    package = tmp_path / "path/part"
    package.mkdir(parents=True)
    (package / "__init__.py").write_text("x = 1\n")
    monkeypatch.syspath_prepend(package.parent)
    monkeypatch.setattr(compiler, which, (*getattr(compiler, which), "part"))
    plutoc("compile", app)
    assert not again(plutoc, runs, app)[1]
    (package / "__init__.py").write_text("x = 10\n")
    assert again(plutoc, runs, app)[1]
    assert not again(plutoc, runs, app)[1]
    if which == "TOOLS":
        (package.parent / "part-2.0.dist-info").mkdir()
        assert again(plutoc, runs, app)[1]


def test_another_python_compiles(
    plutoc: Call, app: Path, runs: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """It may read sources otherwise."""
    plutoc("compile", app)
    monkeypatch.setattr("sys.version", "4.0")
    assert again(plutoc, runs, app)[1]


def test_other_peoples_blocks_count(
    plutoc: Call, app: Path, runs: list[str], installed: Path
) -> None:
    """Their declarations, their steps, and what else is installed."""
    (installed / "field_kit").mkdir()
    write(installed / "field_kit/__init__.py", BLOCK.replace("field_step", ".step"))
    step = installed / "field_kit/step.py"
    write(step, "def chime(run, status):\n    return status\n")
    app.write_text(FIELD_APP)
    assert plutoc("compile", app).code == 0
    assert not again(plutoc, runs, app)[1]
    write(step, "def chime(run, status):\n    return status  # the same\n", time=2)
    modules.load.cache_clear()
    said, compiled = again(plutoc, runs, app)
    assert compiled
    assert "_runtime/blocks/field_kit" in said.out
    assert not again(plutoc, runs, app)[1]
    (installed / "another-1.dist-info").mkdir()
    os.utime(installed, (1, 1))
    assert again(plutoc, runs, app)[1]


def test_another_path_of_pythons_compiles(
    plutoc: Call, app: Path, runs: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Another release of somebody's blocks may stand there, and come first."""
    plutoc("compile", app)
    assert not again(plutoc, runs, app)[1]
    monkeypatch.syspath_prepend(tmp_path / "elsewhere")
    assert again(plutoc, runs, app)[1]


def test_blocks_that_somebody_works_on_count(
    plutoc: Call,
    app: Path,
    runs: list[str],
    installed: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Of an editable install, which some tools make by a finder of their own, each edit is noticed."""
    package = tmp_path / "checkout/field_kit"
    package.mkdir(parents=True)
    write(package / "__init__.py", BLOCK.replace("field_step", ".step"))
    step = package / "step.py"
    write(step, "def chime(run, status):\n    return status\n")
    app.write_text(FIELD_APP)
    monkeypatch.setattr("sys.meta_path", [*sys.meta_path, Editable(package)])
    assert plutoc("compile", app).code == 0
    assert not again(plutoc, runs, app)[1]
    write(step, "def chime(run, status):\n    return status  # the same\n", time=2)
    modules.load.cache_clear()
    assert "_runtime/blocks/field_kit/step.py" in again(plutoc, runs, app)[0].out


def test_blocks_that_were_written_meanwhile_are_compiled_once_more(
    plutoc: Call, app: Path, runs: list[str], installed: Path
) -> None:
    """It may be the text before that was carried along."""
    (installed / "field_kit").mkdir()
    write(installed / "field_kit/__init__.py", BLOCK.replace("field_step", ".step"))
    step = installed / "field_kit/step.py"
    write(step, "def chime(run, status):\n    return status\n")
    app.write_text(FIELD_APP)
    os.utime(step, (9e9, 9e9))
    plutoc("compile", app)
    assert again(plutoc, runs, app)[1]
    os.utime(step, (1, 1))
    assert again(plutoc, runs, app)[1]
    assert not again(plutoc, runs, app)[1]


@pytest.mark.parametrize(
    "damage",
    [
        lambda data: b"",
        lambda data: data[:-1],
        lambda data: data + b"x",
        lambda data: data[:80] + bytes([data[80] ^ 1]) + data[81:],
        lambda data: data.replace(b"up to date", b"all is well"),
        lambda data: b"0" * 64 + data[64:],
    ],
)
def test_a_record_that_is_not_as_it_was_kept_is_not_believed(
    plutoc: Call, app: Path, runs: list[str], shelf: Path, damage: Callable[[bytes], bytes]
) -> None:
    """It is compiled, and kept anew."""
    plutoc("compile", app)
    (record,) = shelf.iterdir()
    record.write_bytes(damage(record.read_bytes()))
    said, compiled = again(plutoc, runs, app)
    assert (said.out, compiled) == ("crop: up to date\n", True)
    assert not again(plutoc, runs, app)[1]


def test_what_is_refused_is_refused_each_time(
    plutoc: Call, app: Path, runs: list[str], shelf: Path
) -> None:
    """Nothing is remembered of errors, of drift, nor of pictures."""
    plutoc("compile", app, "--check")
    plutoc("compile", app, "--diff")
    plutoc("compile", app, "--show", "graph")
    app.write_text(APP.replace("-> judge", "-> juge"))
    assert plutoc("compile", app).code == 1
    assert not shelf.exists() or not list(shelf.iterdir())


def test_no_cache_is_no_error(
    plutoc: Call, app: Path, runs: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """It is compiled each time."""
    monkeypatch.setenv("XDG_CACHE_HOME", "/dev/null/nowhere")
    plutoc("compile", app)
    said, compiled = again(plutoc, runs, app)
    assert (said.out, compiled) == ("crop: up to date\n", True)
