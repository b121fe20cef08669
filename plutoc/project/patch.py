"""What changes in files, as a patch that `git apply` and `patch` understand."""

from __future__ import annotations

from collections.abc import Iterator
from difflib import unified_diff
from io import StringIO

from plutoc.emit.write import Change, Changes

_NO_END = "\n\\ No newline at end of file"


def patch(changes: Changes) -> Iterator[str]:
    """Yield the lines of a patch that could be applied in the package's folder."""
    for change in changes.files:
        yield from patch_of(change)


def patch_of(change: Change) -> Iterator[str]:
    """Yield the lines that are about one file."""
    before, after = _lines(change.before), _lines(change.after)
    old = "/dev/null" if change.before is None else f"a/{change.path}"
    new = "/dev/null" if change.after is None else f"b/{change.path}"
    yield f"diff --git a/{change.path} b/{change.path}"
    if change.before is None:
        yield "new file mode 100644"
    if change.after is None:
        yield "deleted file mode 100644"
    for line in unified_diff(before, after, old, new):
        yield line[:-1] if line.endswith("\n") else line + _NO_END


def _lines(text: str | None) -> list[str]:
    """Return the lines with their ends."""
    return list(StringIO(text or "", newline="\n"))  # unlike splitlines: only line feeds count
