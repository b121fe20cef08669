"""Two versions of an app, compared without the command line."""

from __future__ import annotations

from plutoc.compile import analyse
from plutoc.diff.model import Difference, Version
from plutoc.diff.run import compare
from plutoc.source import Source
from tests.paths import ROOT

EXAMPLES = {
    path.parent.name: path.read_text(encoding="utf-8")
    for path in sorted((ROOT / "examples").glob("*/app.pluto"))
}


def version(text: str, path: str = "app.pluto") -> Version:
    """Check one; raise `Rejected` where it has errors."""
    checked, warnings = analyse(Source(path=path, text=text))
    return Version(checked=checked, warnings=warnings)


def difference(old: str, new: str) -> Difference:
    """Compare two texts."""
    return compare(version(old, "old.pluto"), version(new, "new.pluto"))


def sentences(old: str, new: str) -> list[str]:
    """Return what is said of two texts."""
    return [change.sentence for change in difference(old, new).changes]


def edited(text: str, *edits: tuple[str, str]) -> str:
    """Replace what is there, and fail where it is not."""
    for old, new in edits:
        assert old in text, old
        text = text.replace(old, new)
    return text
