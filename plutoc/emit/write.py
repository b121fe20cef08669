"""Writing a package: the one place of the compiler that changes what is on the disk.

First `compare` says what would change, and refuses what is not ours to change; then `write` does
it, all of it or nothing. New texts are written aside and renamed, so no file is ever half-written.
"""

from __future__ import annotations

import errno
import os
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType

from plutoc import __version__
from plutoc.diagnostic import Diagnostic, Rejected
from plutoc.emit import errors
from plutoc.emit.errors import Place
from plutoc.emit.held import InTheWay, facts_of, held
from plutoc.emit.lock import NAME as LOCK
from plutoc.emit.merged import sides, was_merged, was_written
from plutoc.emit.package import Package
from plutoc.emit.recorded import DamagedLock, Lock, is_newer, read_lock

_ASIDE = ".plutoc-"
"""What the names of folders for unfinished work begin with; one is left only if we are killed."""

_NOTHING: Mapping[str, str] = MappingProxyType({})

_TO_WRITE = os.O_WRONLY | os.O_CREAT | os.O_TRUNC | getattr(os, "O_BINARY", 0)

Save = Callable[[str, bytes], object]


class Refused(Rejected):
    """Something is in the way that is not ours to overwrite."""


class CannotWrite(Exception):
    """The disk says no. Nothing was changed."""

    def __init__(self, error: OSError, folder: Path) -> None:
        name = error.filename
        told = isinstance(name, str) and _ASIDE not in name  # our own names mean nothing to a user
        super().__init__(f"{name if told else folder}: {error.strerror or error}")


@dataclass(frozen=True, slots=True, kw_only=True)
class Change:
    """One file: its text before and after; None where there is none."""

    path: str
    before: str | None
    after: str | None


@dataclass(frozen=True, slots=True, kw_only=True)
class Changes:
    """What writing would change in a folder, in the package's order."""

    folder: Path
    first: bool
    """No package was there before."""
    files: tuple[Change, ...]
    settles_merge: bool = False
    """What was there is of two branches, which a merge has put together."""


def compare(
    package: Package,
    folder: Path,
    place: Place,
    *,
    asked: Mapping[str, str] = _NOTHING,
    force: bool = False,
) -> Changes:
    """Return what writing a package would change; raise `Refused` where that is not ours to do.

    `place` is where the app is declared. `asked` are files of the user's that the user wants to
    have changed. With `force`, what was edited by hand is no obstacle.
    """
    lock = record_of(package.name, folder, place, force=force)
    try:
        recorded = lock.files if lock else {}
        of_two = lock is not None and lock.is_merged
        found: list[Diagnostic] = []
        files: list[Change] = []
        for path, (before, after) in _texts(package, folder, asked, recorded, place, found).items():
            new = None if after is None else after.encode()
            if before == new:
                continue
            old = None if before is None else before.replace(b"\r\n", b"\n")  # as Git may have it
            if old == new:
                continue
            digests = recorded.get(path, frozenset())
            merged = old is not None and was_merged(old, digests)
            of_two |= merged
            written = old is None or merged or was_written(old, digests)
            if written or path == LOCK or path in asked or force:
                text = None if old is None else old.decode("utf-8", "replace")
                files.append(Change(path=path, before=text, after=after))
            elif path in package.owned and path not in recorded:
                found.append(errors.somebody_elses_file(place, str(folder / path)))
            else:
                text = (old or b"").decode("utf-8", "replace")
                if sides(old or b"") is None:
                    found.append(errors.edited(place, str(folder / path), text, after))
                else:
                    found.append(errors.merged_with_an_edit(place, folder, path, text))
    except OSError as error:
        raise CannotWrite(error, folder) from error
    if found:
        raise Refused(found)
    return Changes(
        folder=folder, first=lock is None, files=tuple(files), settles_merge=of_two and bool(files)
    )


def record_of(app: str, folder: Path, place: Place, *, force: bool = False) -> Lock | None:
    """Return what was recorded about a folder, or None where nothing is there yet.

    Raise `Refused` where the folder is not one that this compiler may write into. With `force` it
    may be a newer compiler's, or have a record that cannot be read.
    """
    try:
        return _record_of(app, folder, place, force=force)
    except OSError as error:
        raise CannotWrite(error, folder) from error


def _record_of(app: str, folder: Path, place: Place, *, force: bool) -> Lock | None:
    if folder.is_symlink() or (folder.exists() and not folder.is_dir()):
        raise Refused([errors.in_the_way(place, str(folder), _kind(folder), "a folder")])
    if not folder.exists() or _is_free(folder):
        return None
    path = folder / LOCK
    if not path.is_file() or path.is_symlink():
        raise Refused([errors.not_ours(place, str(folder))])
    try:
        lock = read_lock(path.read_bytes())
    except DamagedLock as error:
        if force:
            return Lock(app=app, files={})
        _refuse_newer(folder, place, error.made_by)
        raise Refused([errors.damaged_lock(place, str(path), str(error))]) from None
    if lock.app != app:
        raise Refused([errors.another_app(place, str(folder), lock.app)])
    if not force:
        _refuse_newer(folder, place, lock.made_by)
    return lock


def _refuse_newer(folder: Path, place: Place, made_by: str | None) -> None:
    """Refuse what a newer compiler made, also where only that one can read how it did so."""
    if made_by is not None and is_newer(made_by, __version__):
        raise Refused([errors.newer(place, str(folder), made_by, __version__)])


def _is_free(folder: Path) -> bool:
    """Say whether a folder is empty, work aside that a kill left there."""
    return all(name.startswith(_ASIDE) for name in os.listdir(folder))


def _texts(
    package: Package,
    folder: Path,
    asked: Mapping[str, str],
    recorded: Iterable[str],
    place: Place,
    found: list[Diagnostic],
) -> dict[str, tuple[bytes | None, str | None]]:
    """Return every file that is to be looked at, as it is on the disk and as it shall be."""
    wanted: dict[str, str | None] = {**package.owned}
    wanted |= {path: text for path, text in package.once.items() if not (folder / path).is_file()}
    wanted |= asked
    ours = {*package.owned, *package.once}
    wanted |= {path: None for path in recorded if path not in ours}
    texts: dict[str, tuple[bytes | None, str | None]] = {}
    top, passed = os.fspath(folder), set[str]()
    for path, text in wanted.items():
        try:
            facts = facts_of(top, path, passed)
            texts[path] = held(os.path.join(top, path), facts), text
        except InTheWay as error:
            what = "a folder" if error.is_on_the_way else "a file"
            found.append(errors.in_the_way(place, str(error.place), _kind(error.place), what))
    return texts


def _kind(path: Path) -> str:
    if path.is_symlink():
        return "a symbolic link"
    return "a folder" if path.is_dir() else "a file" if path.is_file() else "no ordinary file"


def _save(path: str, data: bytes) -> None:
    handle = os.open(path, _TO_WRITE, 0o666)
    try:
        while data := data[os.write(handle, data) :]:
            pass
    finally:
        os.close(handle)


def write(changes: Changes, *, save: Save = _save) -> None:
    """Make the changes, all or none; raise `CannotWrite` where the disk refuses."""
    if not changes.files:
        return
    folder = changes.folder
    made: list[Path] = []
    try:
        with _undone_unless_finished(made):
            if not folder.exists():
                _make_folders(folder.parent, made)
            if changes.first and folder.exists() and not _is_free(folder):
                # It came since, or `new/../there` leads to it once there is a `new`.
                raise FileExistsError(errno.EEXIST, "it is not empty any more", str(folder))
            with _aside(folder if folder.exists() else folder.parent) as aside:
                _prepare(changes, aside, save)
                if folder.exists():
                    _replace(changes, aside)
                else:
                    os.rename(aside / "new", folder)
    except OSError as error:
        raise CannotWrite(error, folder) from error


def create(folder: Path, texts: Mapping[str, str], *, save: Save = _save) -> None:
    """Write files into a new or empty folder, all or none."""
    files = [Change(path=path, before=None, after=text) for path, text in texts.items()]
    write(Changes(folder=folder, first=True, files=tuple(files)), save=save)


@contextmanager
def _aside(parent: Path) -> Iterator[Path]:
    """Give a folder for unfinished work, on the same disk as its place, and take it away again."""
    # not by tempfile, nor with shutil before it is needed: they take longer to import than this does
    aside = parent / f"{_ASIDE}{os.urandom(8).hex()}"
    aside.mkdir(mode=0o700)
    try:
        yield aside
    finally:
        try:
            aside.rmdir()  # all of it is in its place, as a rule
        except OSError:
            from shutil import rmtree

            rmtree(aside, ignore_errors=True)


@contextmanager
def _undone_unless_finished(made: list[Path]) -> Iterator[None]:
    """Remove the folders that were made for it when it fails, a Ctrl-C included."""
    try:
        yield
    except BaseException:
        for folder in reversed(made):
            with suppress(OSError):
                folder.rmdir()
        raise


def _make_folders(folder: Path, made: list[Path]) -> None:
    """Make a folder and those above it, and note the new ones, from the top."""
    missing = [path for path in (folder, *folder.parents) if not path.exists()]
    for path in reversed(missing):
        path.mkdir(exist_ok=True)
        made.append(path)


def _prepare(changes: Changes, aside: Path, save: Save) -> None:
    """Write the new texts aside, and keep the old ones there. Most of what can fail fails here."""
    top, parents = os.path.join(aside, "new"), set[str]()
    for change in changes.files:
        if change.after is not None:
            new = os.path.join(top, change.path)
            parent = os.path.dirname(new)
            if parent not in parents:
                os.makedirs(parent, exist_ok=True)
                parents.add(parent)
            save(new, change.after.encode())
        if change.before is not None:
            from shutil import copy2

            old = aside / "old" / change.path
            old.parent.mkdir(parents=True, exist_ok=True)
            copy2(changes.folder / change.path, old, follow_symlinks=False)


def _replace(changes: Changes, aside: Path) -> None:
    """Rename the new files into their places; where one cannot be, put all back."""
    folder, begun, made = changes.folder, list[Change](), list[Path]()
    with _undone_unless_finished(made):
        try:
            # The lock last: until then, what is half done is still known as ours.
            for change in sorted(changes.files, key=lambda change: change.path == LOCK):
                _refuse_what_came_since(folder, change.path)
                begun.append(change)
                if change.after is None:
                    (folder / change.path).unlink()
                else:
                    _make_folders((folder / change.path).parent, made)
                    os.replace(aside / "new" / change.path, folder / change.path)
        except BaseException:
            for change in begun:
                with suppress(OSError):
                    if change.before is None:
                        (folder / change.path).unlink()
                    else:
                        os.replace(aside / "old" / change.path, folder / change.path)
            raise
    for change in changes.files:
        if change.after is None:
            _remove_empty_folders((folder / change.path).parent, folder)


def _refuse_what_came_since(folder: Path, path: str) -> None:
    """What was no link when we compared may be one now, and lead anywhere."""
    try:
        if folder.is_symlink():
            raise InTheWay(os.fspath(folder), is_on_the_way=True)
        facts_of(os.fspath(folder), path, set())
    except InTheWay as error:
        reason = f"{_kind(error.place)} was put there meanwhile"
        raise FileExistsError(errno.EEXIST, reason, str(error.place)) from None


def _remove_empty_folders(path: Path, top: Path) -> None:
    with suppress(OSError):  # the first one that is not empty ends it
        while path != top:
            path.rmdir()
            path = path.parent
