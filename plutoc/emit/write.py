"""Writing a package: no other module does.

First `compare` says what would change, and refuses what is not ours to change; then `write` does
it, all of it or nothing. New texts are written aside and renamed, so no file is ever half-written.
"""

from __future__ import annotations

import errno
import os
import stat
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from shutil import copy2
from tempfile import TemporaryDirectory
from types import MappingProxyType
from typing import TYPE_CHECKING

from plutoc import __version__
from plutoc.diagnostic import Diagnostic, Rejected
from plutoc.emit import errors
from plutoc.emit.errors import Place
from plutoc.emit.lock import NAME as LOCK
from plutoc.emit.lock import DamagedLock, Lock, is_newer, read_lock
from plutoc.emit.merge_conflicts import sides, was_merged, was_written

if TYPE_CHECKING:
    from plutoc.emit.package import Package

_ASIDE = ".plutoc-"
"""What the names of folders for unfinished work begin with; one is left only if we are killed."""

_NOTHING: Mapping[str, str] = MappingProxyType({})

Save = Callable[[Path, bytes], object]


class Refused(Rejected):
    """A file must not be overwritten."""


class CannotWrite(Exception):
    """The files cannot be written. Nothing was changed."""

    def __init__(self, error: OSError, folder: Path) -> None:
        name = error.filename
        told = isinstance(name, str) and _ASIDE not in name  # our own names mean nothing to a user
        super().__init__(f"{name if told else folder}: {error.strerror or error}")


class InTheWay(Exception):
    """A file cannot be written through what is there: a link, or what is no folder."""

    def __init__(self, place: Path, wanted: str) -> None:
        self.place = place
        self.wanted = wanted


@dataclass(frozen=True, slots=True, kw_only=True)
class Change:
    """One file: its text before and after; None if there is none."""

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
                found.append(errors.foreign_file(place, str(folder / path)))
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
    """Return whether a folder is empty, work aside that a kill left there."""
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
    for path, text in wanted.items():
        try:
            texts[path] = _read(folder, path), text
        except InTheWay as error:
            kind = _kind(error.place)
            found.append(errors.in_the_way(place, str(error.place), kind, error.wanted))
    return texts


def _read(folder: Path, path: str) -> bytes | None:
    """Return what a file holds, None where there is none; raise `InTheWay` where none can be."""
    _refuse_what_is_in_the_way(folder, path)
    try:
        with open(folder / path, "rb", opener=_through_no_link) as file:
            return file.read()
    except FileNotFoundError:
        return None


def _through_no_link(path: str, flags: int) -> int:
    """Open a file, but no link that came in its place just now; and wait for no pipe."""
    return os.open(path, flags | getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_NONBLOCK", 0))


def _refuse_what_is_in_the_way(folder: Path, path: str) -> None:
    """Raise `InTheWay` for what is no folder on the way to a file, and for what is no file there."""
    file = folder / path
    ways = [
        (one, stat.S_ISDIR, "a folder") for one in reversed(file.parents) if folder in one.parents
    ]
    for place, is_right, wanted in (*ways, (file, stat.S_ISREG, "a file")):
        try:
            mode = place.lstat().st_mode
        except (FileNotFoundError, NotADirectoryError):
            return
        if not is_right(mode):
            raise InTheWay(place, wanted)


def _kind(path: Path) -> str:
    if path.is_symlink():
        return "a symbolic link"
    return "a folder" if path.is_dir() else "a file" if path.is_file() else "no ordinary file"


def write(changes: Changes, *, save: Save = Path.write_bytes) -> None:
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
            parent = folder if folder.exists() else folder.parent  # on the same disk
            with TemporaryDirectory(
                prefix=_ASIDE, dir=parent, ignore_cleanup_errors=True
            ) as unfinished:
                aside = Path(unfinished)
                _prepare(changes, aside, save)
                if folder.exists():
                    _replace(changes, aside)
                else:
                    os.rename(aside / "new", folder)
    except OSError as error:
        raise CannotWrite(error, folder) from error


def create(folder: Path, texts: Mapping[str, str], *, save: Save = Path.write_bytes) -> None:
    """Write files into a new or empty folder, all or none."""
    files = [Change(path=path, before=None, after=text) for path, text in texts.items()]
    write(Changes(folder=folder, first=True, files=tuple(files)), save=save)


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
    for change in changes.files:
        if change.after is not None:
            new = aside / "new" / change.path
            new.parent.mkdir(parents=True, exist_ok=True)
            save(new, change.after.encode())
        if change.before is not None:
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
            raise InTheWay(folder, "a folder")
        _refuse_what_is_in_the_way(folder, path)
    except InTheWay as error:
        reason = f"{_kind(error.place)} was put there meanwhile"
        raise FileExistsError(errno.EEXIST, reason, str(error.place)) from None


def _remove_empty_folders(path: Path, top: Path) -> None:
    with suppress(OSError):  # the first one that is not empty ends it
        while path != top:
            path.rmdir()
            path = path.parent
