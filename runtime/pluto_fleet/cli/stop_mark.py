"""A Stop that went past an app that did not answer: it is kept, for when the app looks again."""

from __future__ import annotations

from contextlib import suppress
from pathlib import Path

from ..jobs.reports import Down
from ..journal.place import gateway_folder


def leave(journal: Path, how: Down) -> None:
    """Say that everything was stopped; `journal` is its real path."""
    file = _file(journal)
    with suppress(OSError):
        file.parent.mkdir(mode=0o700, exist_ok=True)
        file.write_text(how.value, encoding="utf-8")


def found(journal: Path) -> Down | None:
    """Return how everything was stopped; None: it was not."""
    with suppress(OSError, ValueError):
        return Down(_file(journal).read_text(encoding="utf-8"))
    return None


def remove(journal: Path) -> None:
    """Somebody wants it to go on."""
    with suppress(OSError):
        _file(journal).unlink(missing_ok=True)


def _file(journal: Path) -> Path:
    return gateway_folder(journal) / "stopped"
