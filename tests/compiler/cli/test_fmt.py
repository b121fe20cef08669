"""`plutoc fmt`: what becomes of the file, whatever happens meanwhile."""

from __future__ import annotations

import errno
import os
import stat
import sys
from pathlib import Path

import pytest

from plutoc.cli import main
from plutoc.cli.changes import rewrite
from plutoc.cli.endings import UsageError
from plutoc.format import run
from tests.compiler.cli.conftest import APP, tree
from tests.kit.command import plutoc

UNTIDY = APP.replace("  watch ->", "\n\n\twatch->").replace(" = ", "=").replace("50 mg", "50mg")
TIDY = APP.replace("  watch -> ", "\n  watch -> ")


@pytest.fixture
def untidy(app: Path) -> Path:
    """The app, not in canonical form."""
    app.write_text(UNTIDY)
    return app


def test_a_canonical_file_is_not_even_touched(untidy: Path) -> None:
    """Build tools look at its time."""
    assert plutoc("fmt", untidy).code == 0
    assert untidy.read_text() == TIDY
    before = untidy.stat()
    assert plutoc("fmt", untidy).code == 0
    assert (untidy.stat().st_mtime_ns, untidy.stat().st_ino) == (before.st_mtime_ns, before.st_ino)


def test_a_closed_standard_input_is_said(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """A program may be started without one."""
    monkeypatch.setattr(sys, "stdin", None)
    assert main(["fmt", "-"]) == 2
    assert capsys.readouterr().err == "plutoc: standard input is closed\n"


@pytest.mark.skipif(os.name != "posix", reason="Windows has neither such permissions nor links")
def test_permissions_and_links_are_kept(untidy: Path) -> None:
    """A file that other users may not read stays so, and what a link leads to is formatted."""
    untidy.chmod(0o640)
    link = Path("deep/link.pluto")
    link.parent.mkdir()
    link.symlink_to(Path("..") / untidy)
    assert plutoc("fmt", link).code == 0
    assert link.is_symlink()
    assert untidy.read_text() == TIDY
    assert stat.S_IMODE(untidy.stat().st_mode) == 0o640
    assert os.listdir("deep") == ["link.pluto"]


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="this system has no named pipes")
def test_what_is_no_ordinary_file_is_not_replaced(app: Path) -> None:
    """A pipe would be gone afterwards."""
    os.mkfifo("pipe")
    with pytest.raises(UsageError, match="pipe is no ordinary file and was not changed"):
        rewrite(Path("pipe"), "a", "b")
    assert stat.S_ISFIFO(os.stat("pipe").st_mode)


@pytest.mark.parametrize(
    ("failure", "code"),
    [(OSError(errno.ENOSPC, "No space left on device"), 2), (KeyboardInterrupt(), 130)],
)
@pytest.mark.parametrize("at", ["replace", "save"])
def test_any_end_in_between_leaves_the_old_source(
    untidy: Path,
    here: Path,
    monkeypatch: pytest.MonkeyPatch,
    failure: BaseException,
    code: int,
    at: str,
) -> None:
    """A full disk or Ctrl-C, while the new one is written or just before it is there."""

    def fail(*_: object) -> None:
        raise failure

    before = tree(here)
    with monkeypatch.context() as patched:
        patched.setattr(
            *((os, "replace", fail) if at == "replace" else (Path, "write_bytes", fail))
        )
        said = plutoc("fmt", untidy)
    assert said.code == code
    assert tree(here) == before
    assert "crop.pluto was not changed" in said.err or code == 130


def test_the_new_source_comes_into_its_place_at_once(
    untidy: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Until the rename the old one is there, whole: a kill finds one of the two."""
    seen: list[str] = []
    replace = os.replace

    def replacing(source: Path, target: Path) -> None:
        seen.append(untidy.read_text())
        replace(source, target)
        seen.append(untidy.read_text())

    monkeypatch.setattr(os, "replace", replacing)
    rewrite(untidy, UNTIDY, TIDY)
    assert seen == [UNTIDY, TIDY]


def test_a_mistake_of_ours_destroys_nothing(untidy: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """It is an internal error, and the source stays."""
    monkeypatch.setattr(run, "canonical", lambda text: TIDY.replace("retry -> end", "watch -> end"))
    said = plutoc("fmt", untidy)
    assert said.code == 70
    assert "P9001" in said.err
    assert untidy.read_text() == UNTIDY
