"""`lsp`: the language server, for editors, on standard input and output."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from pathlib import Path

from plutoc.check.model import Checked
from plutoc.cli.endings import CLEAN, UsageError
from plutoc.cli.files import HOOKS, default_folder, find_hooks, hooks_path, read_app, shown
from plutoc.cli.options import Options
from plutoc.source import Source

MISSING = 'the language server is not installed: pip install "plutoc[editor]"'
_MOST_APPS = 20
"""Of a folder: to find the app that a hooks.py belongs to, no more are read."""


def lsp(_: Options) -> int:
    """Serve the editor that started this program."""
    try:
        from plutoc.lsp.server import serve
    except ModuleNotFoundError as error:
        if error.name and error.name.partition(".")[0] in ("pygls", "lsprotocol", "cattrs"):
            raise UsageError(MISSING) from None
        raise
    if sys.stdin is None or sys.stdout is None:
        raise UsageError("an editor starts this, and speaks to it by standard input and output")
    reads, writes = sys.stdin.buffer, os.fdopen(os.dup(sys.stdout.fileno()), "wb")
    os.dup2(2, sys.stdout.fileno())  # what a block of another package prints is no message
    serve(_Disk(), reads, writes)
    return CLEAN


class _Disk:
    """The files beside those that an editor has open."""

    def read_app(self, path: Path) -> str | None:
        """Return the text of an app's file; None where it cannot be read."""
        try:
            return read_app(path).text
        except UsageError:
            return None

    def hooks_places(self, checked: Checked, app: Path) -> tuple[Path, ...]:
        """Return where the hooks.py of an app can be: the first that is there counts."""
        return default_folder(app, checked) / hooks_path(checked), app.parent / HOOKS

    def read_hooks(self, checked: Checked, app: Path) -> tuple[Path, Source] | None:
        """Return the hooks.py that counts, if there is one."""
        try:
            found = find_hooks(checked, app, default_folder(app, checked))
        except UsageError:  # no text: there is nothing in it to show a mistake at
            return None
        if found is None:
            return None
        places = self.hooks_places(checked, app)
        return next((place, found) for place in places if shown(place) == found.path)

    def apps_beside(self, hooks: Path) -> Iterator[Path]:
        """Give the files of apps whose hooks.py this may be: beside it, or beside its package."""
        folders = dict.fromkeys((hooks.parent, *hooks.parents[3:4]))
        for folder in folders:
            yield from sorted(folder.glob("*.pluto"))[:_MOST_APPS]
