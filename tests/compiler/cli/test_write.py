"""Writing is all or nothing, though the disk, or Ctrl-C, stops it in the middle."""

from __future__ import annotations

import errno
import os
from collections.abc import Callable
from pathlib import Path

import pytest

from plutoc.emit.errors import Place
from plutoc.emit.lock import lock
from plutoc.emit.package import Package
from plutoc.emit.write import CannotWrite, compare, create, write
from plutoc.source import Source, Span
from tests.compiler.cli.conftest import tree

PLACE = Place(source=Source("a.pluto", "app a {}"), span=Span(4, 5))

OLD = {"flow.py": "old\n", "README.md": "old\n", "_runtime/blocks/gone.py": "gone\n"}
NEW = {"flow.py": "new\n", "README.md": "new\n", "_runtime/deep/more.py": "more\n"}


def package(texts: dict[str, str]) -> Package:
    """Return a package of these files."""
    owned = {**texts, "pluto.lock": lock("a", "a.pluto", [], texts)}
    return Package(name="a", owned=owned, once={"hooks.py": "stubs\n"})


def failing(after: int, error: BaseException) -> Callable[[Path, bytes], object]:
    """Return a way to save that writes half of a file, after so many whole ones, and fails."""
    left = after

    def save(path: Path, data: bytes) -> None:
        nonlocal left
        left -= 1
        path.write_bytes(data if left >= 0 else data[: len(data) // 2])
        if left < 0:
            raise error

    return save


FULL = OSError(errno.ENOSPC, "No space left on device")


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """Where the package of the old files is."""
    folder = tmp_path / "a"
    write(compare(package(OLD), folder, PLACE))
    return folder


@pytest.mark.parametrize("after", [0, 1, 3])
def test_a_full_disk_leaves_no_trace_of_a_new_package(tmp_path: Path, after: int) -> None:
    """Not even of the folders on the way."""
    changes = compare(package(NEW), tmp_path / "deep" / "a", PLACE)
    with pytest.raises(CannotWrite, match="No space left on device"):
        write(changes, save=failing(after, FULL))
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("failure", [OSError(errno.EIO, "Input/output error"), KeyboardInterrupt()])
@pytest.mark.parametrize("after", [0, 1, 2, 3])
def test_a_failure_between_two_renames_puts_all_back(
    folder: Path, monkeypatch: pytest.MonkeyPatch, after: int, failure: BaseException
) -> None:
    """Also what was replaced, removed or new."""
    before, replace, left = tree(folder), os.replace, after

    def replacing(source: Path, target: Path) -> None:
        nonlocal left
        left -= 1
        if left == -1:
            raise failure
        replace(source, target)

    monkeypatch.setattr(os, "replace", replacing)
    with pytest.raises((CannotWrite, KeyboardInterrupt)):
        write(compare(package(NEW), folder, PLACE))
    assert tree(folder) == before


class Killed(BaseException):
    """Ends everything at once, and all that would tidy up after it."""


@pytest.mark.parametrize("after", [0, 1, 2, 3, 4])
def test_what_a_kill_leaves_half_done_the_next_run_finishes(
    folder: Path, monkeypatch: pytest.MonkeyPatch, after: int
) -> None:
    """Nothing of it looks as if it had been edited by hand."""
    changes, left = compare(package(NEW), folder, PLACE), after
    replace, unlink = os.replace, Path.unlink

    def replacing(source: Path, target: Path) -> None:
        live()
        replace(source, target)

    def unlinking(path: Path, missing_ok: bool = False) -> None:
        live()
        unlink(path, missing_ok)

    def live() -> None:
        nonlocal left
        left -= 1
        if left < 0:
            raise Killed

    with monkeypatch.context() as patched, pytest.raises(Killed):
        patched.setattr(os, "replace", replacing)
        patched.setattr(Path, "unlink", unlinking)
        write(changes)
    write(compare(package(NEW), folder, PLACE))
    assert not compare(package(NEW), folder, PLACE).files


def test_writing_replaces_adds_and_removes(folder: Path) -> None:
    """And takes empty folders away."""
    write(compare(package(NEW), folder, PLACE))
    assert tree(folder) == {
        "README.md": b"new\n",
        "_runtime": b"a folder",
        "_runtime/deep": b"a folder",
        "_runtime/deep/more.py": b"more\n",
        "flow.py": b"new\n",
        "hooks.py": b"stubs\n",
        "pluto.lock": package(NEW).owned["pluto.lock"].encode(),
    }
    assert not compare(package(NEW), folder, PLACE).files


def test_a_folder_of_unfinished_work_is_no_obstacle(tmp_path: Path) -> None:
    """One is left where a process was killed."""
    (tmp_path / "a" / ".plutoc-killed").mkdir(parents=True)
    write(compare(package(NEW), tmp_path / "a", PLACE))
    assert (tmp_path / "a" / "flow.py").is_file()


def test_a_stranger_cannot_read_less_than_others(folder: Path) -> None:
    """Folders and files have the permissions that the user's always have."""
    plain = folder.parent / "plain"
    plain.mkdir()
    (plain / "file").touch()
    assert folder.stat().st_mode == plain.stat().st_mode
    assert (folder / "flow.py").stat().st_mode == (plain / "file").stat().st_mode


def test_create_fills_a_new_folder_or_nothing(tmp_path: Path) -> None:
    """It is what `plutoc new` uses."""
    with pytest.raises(CannotWrite):
        create(tmp_path / "a", NEW, save=failing(1, FULL))
    assert not list(tmp_path.iterdir())
    create(tmp_path / "a", NEW)
    assert (tmp_path / "a" / "flow.py").read_text() == "new\n"
