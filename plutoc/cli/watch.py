"""`watch`: an app is compiled whenever it is saved, and what changed in meaning is said."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterable, Sequence
from contextlib import closing, suppress
from dataclasses import dataclass, replace
from importlib.util import find_spec
from pathlib import Path

from plutoc.cli.compile import compile_
from plutoc.cli.endings import CLEAN, INTERRUPTED, UsageError, end_if_told
from plutoc.cli.files import read_app
from plutoc.cli.options import Options
from plutoc.cli.say import in_colour, say
from plutoc.compile import analyse
from plutoc.diagnostic import Rejected
from plutoc.diff.model import Version
from plutoc.diff.run import compare
from plutoc.project.hooks import HOOKS, default_folder, hooks_path
from plutoc.project.reading import shown
from plutoc.report.change_reports import text
from plutoc.source import Source
from plutoc_runtime import output

_STEP, _LOOK = 100, 1000
"""Milliseconds: saves that follow within the one count as one; after the other it is looked anyway."""

_Stamps = dict[Path, tuple[int, int, int]]
"""What shows that a file was saved, also by a rename. A file that is not there has none."""


def watch(options: Options) -> int:
    """Compile at once and after each save, until Ctrl-C."""
    if find_spec("watchfiles") is None:
        raise UsageError('watch needs the extra `editor`: pip install "plutoc[editor]"')
    read_app(options.file)  # what is no app now will be none later
    app = _App(options)
    try:
        before = app.compile({})
        output.line(f"\nwatching {shown(options.file)} and its {HOOKS}; Ctrl-C ends")
        while True:
            output.flush()
            now = _saved(app.files, before)
            output.line()
            before = app.compile(now)
    except KeyboardInterrupt:
        end_if_told()  # what waits for saves makes an interrupt of every signal
        return INTERRUPTED


@dataclass(slots=True, eq=False)
class _App:
    """The app that is watched, and what is known of it."""

    options: Options
    good: Version | None = None
    """As it was compiled last without an error."""
    own_hooks: Path | None = None
    """The hooks.py of its package, once it is known how the app is called."""

    @property
    def files(self) -> list[Path]:
        """What is read by a compile, and saved by a person."""
        beside = self.options.file.parent / HOOKS
        return [self.options.file, beside, *([self.own_hooks] if self.own_hooks else [])]

    def compile(self, seen: _Stamps) -> _Stamps:
        """Compile, say what there is to say, and return the stamps of what was read.

        Those are from before it was read, so that what is saved meanwhile is compiled again.
        """
        seen = _stamps(self.files) | seen
        try:
            self._compile(seen)
        except Rejected as rejected:
            say(rejected.diagnostics)
        except UsageError as error:
            output.tell(f"plutoc: {error}")
        return seen

    def _compile(self, seen: _Stamps) -> None:
        checked, warnings = analyse(read_app(self.options.file))
        now = Version(checked=checked, warnings=warnings)
        folder = self.options.folder or default_folder(self.options.file, checked.graph)
        self.own_hooks = folder / hooks_path(checked.graph)

        def note_hooks() -> None:
            seen.update(_stamps(self.files) | seen)

        note_hooks()
        if self.good is not None and self.good.checked.graph.source != checked.graph.source:
            output.line(_changes(self.good, now))
        # the package's first hooks.py is made by this very compile: no person has saved it
        if compile_(self.options, written=note_hooks) == CLEAN:
            self.good = now


def _changes(old: Version, new: Version) -> str:
    found = compare(old, new)
    before = Source("before", found.old.text)  # by its path it could not be told from the new one
    return text(replace(found, old=before), colour=in_colour(sys.stdout)).rstrip("\n")


def _saved(files: Sequence[Path], before: _Stamps) -> _Stamps:
    """Wait until one of the files was saved, and return their stamps.

    Folders are watched, for editors save by a rename. A file that is gone is waited for: it may be
    between the two halves of a save.
    """
    from watchfiles import watch

    folders = {_nearest(file.parent) for file in files}
    told = False
    try:
        looks = watch(
            *folders,
            watch_filter=None,
            recursive=False,
            step=_STEP,
            rust_timeout=_LOOK,
            yield_on_timeout=True,
        )
        with closing(looks):
            for changes in looks:
                now = _stamps(files)
                if any(now[file] != before.get(file) for file in now):
                    return now
                if files[0] not in now and not changes and not told:
                    output.tell(f"{shown(files[0])} is gone: waiting for it")
                    told = True
    except OSError as error:
        raise UsageError(f"the files cannot be watched: {error.strerror or error}") from None
    raise AssertionError("it ends by an interrupt only")


def _nearest(folder: Path) -> Path:
    """Return a folder, or the nearest above it that is there."""
    folder = folder.absolute()
    return next(path for path in (folder, *folder.parents) if path.is_dir())


def _stamps(files: Iterable[Path]) -> _Stamps:
    found: _Stamps = {}
    for file in files:
        with suppress(OSError):  # it is not there, or not now
            seen = os.stat(file)
            found[file] = seen.st_mtime_ns, seen.st_size, seen.st_ino
    return found
