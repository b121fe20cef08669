"""Errors of writing a package's files (P4)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from shlex import quote

from plutoc.diagnostic import Diagnostic, Related, error
from plutoc.graph.model import Graph
from plutoc.source import Source, Span


@dataclass(frozen=True, slots=True, kw_only=True)
class Place:
    """Where the app that the files are made of is declared."""

    source: Source
    span: Span

    def error(
        self, code: str, message: str, *, label: str = "its package", help: str
    ) -> Diagnostic:
        """Return an error that is told here."""
        return error(code, message, self.source, self.span, label=label, help=help)


def place_of(graph: Graph) -> Place:
    """Return where an app is declared."""
    return Place(source=graph.source, span=graph.name_span)


def edited(place: Place, path: str, text: str, wanted: str | None) -> Diagnostic:
    """A file that is made of the app, and was changed by hand."""
    gone = "" if wanted is not None else ", and the app does not need this file any more"
    return error(
        "P4001",
        f"`{path}` was edited by hand{gone}",
        Source(path, text),
        _first_difference(text, wanted),
        label="differs from what was written here" if wanted is not None else "",
        related=(_made_of(place),),
        help=f"make this change in `{place.source.path}`, {_said_there(path)}, and undo it here;"
        " `--force` throws it away",
    )


def merged_with_an_edit(place: Place, folder: Path, path: str, text: str) -> Diagnostic:
    """A file with the marks of a merge, of which a side was never written."""
    start = text.index("<<<<<<<")
    return error(
        "P4001",
        f"`{folder / path}` has the marks of a merge in it, and not both sides are in `pluto.lock`",
        Source(str(folder / path), text),
        Span(start, start + len(text[start:].partition("\n")[0])),
        label="the merge begins here",
        related=(_made_of(place),),
        help=f"{_both_sides_again(folder / 'pluto.lock')}, and `compile` settles the rest; where a"
        f" side was edited by hand, make that change in `{place.source.path}`, {_said_there(path)},"
        " and take the other side here; `--force` throws both away",
    )


def _both_sides_again(lock: Path) -> str:
    return f"`git checkout --merge {quote(str(lock))}` brings both sides of the lock back"


def _said_there(path: str) -> str:
    """Return how what is wanted of a file is said in its source, or where else."""
    if Path(path).name == "pyproject.toml":
        return "where `version` and `requires` say what goes into this file"
    return "or in `hooks.py` if it is code of your own"


def foreign_file(place: Place, path: str) -> Diagnostic:
    """A file that we never wrote, where one of ours would go."""
    return place.error(
        "P4002",
        f"`{path}` was not written by plutoc, and the package needs a file of this name",
        help="give your file another name; `--force` overwrites it",
    )


def not_ours(place: Place, folder: str) -> Diagnostic:
    """A folder with other things in it."""
    return place.error(
        "P4003",
        f"`{folder}` is not empty, and it is not a package that plutoc wrote",
        label="its package would go there",
        help="name a new or empty folder with `-o`",
    )


def another_app(place: Place, folder: str, other: str) -> Diagnostic:
    """A folder with another app's package."""
    return place.error(
        "P4004",
        f"`{folder}` is the package of another app, `{other}`",
        label="its package would go there",
        help="name another folder with `-o`; if the app was renamed, remove the old package or"
        " move it away, and bring its `hooks.py` along",
    )


def damaged_lock(place: Place, path: str, why: str) -> Diagnostic:
    """A record of what was written that cannot be read."""
    return place.error(
        "P4005",
        f"`{path}` is damaged: {why}",
        help="by it one knows which files were edited by hand. Take it from your version control"
        f" again (in a merge, {_both_sides_again(Path(path))}); `--force` writes the whole package"
        " anew",
    )


def in_the_way(place: Place, path: str, what: str, wanted: str) -> Diagnostic:
    """A link, a folder or a file where something else must be."""
    return place.error(
        "P4006",
        f"`{path}` is {what}, and {wanted} must be there",
        help="move it away, or name another folder with `-o`",
    )


def never_written(place: Place, folder: str) -> Diagnostic:
    """`--check` of a package that does not exist."""
    return place.error(
        "P4007",
        f"there is no package in `{folder}` yet",
        label="nothing was generated of this app",
        help=f"run {_compiling(place, folder)}",
    )


def outdated(
    place: Place,
    folder: str,
    paths: Sequence[str],
    *,
    settles_merge: bool = False,
) -> Diagnostic:
    """`--check` of a package that is not what its source says."""
    since, settles = "", ""
    if settles_merge:
        since, settles = " since a merge", ", which settles the generated files by itself"
    files = "1 file" if len(paths) == 1 else f"{len(paths)} files"
    shown = "\n".join(f"  {path}" for path in paths[:_SHOWN])
    more = f"\n  … and {len(paths) - _SHOWN} more" if len(paths) > _SHOWN else ""
    return place.error(
        "P4008",
        f"`{folder}` is out of date{since}: {files} would change",
        help=f"run {_compiling(place, folder)}{settles}; `--diff` shows what would change in\n"
        f"{shown}{more}",
    )


_SHOWN = 8


def _compiling(place: Place, folder: str) -> str:
    """Return the command that writes the package, into this very folder."""
    source = place.source
    usual = Path(source.path).parent / source.text[place.span.start : place.span.end]
    where = "" if folder == str(usual) else f" -o {quote(folder)}"
    return f"`plutoc compile {quote(source.path)}{where}`"


def not_embeddable(place: Place, sentence: str) -> Diagnostic:
    """A block whose code cannot be carried along."""
    return place.error(
        "P4009",
        f"the package cannot carry this app's blocks along: {sentence}",
        help="tell the people who made that block, or use another one",
    )


def newer(place: Place, folder: str, made_by: str, ours: str) -> Diagnostic:
    """A package that a newer compiler wrote."""
    return place.error(
        "P4010",
        f"`{folder}` was made by plutoc {made_by}, which is newer than this plutoc {ours}: upgrade"
        f" plutoc, or go back to {ours} on purpose with `--force`",
        help="`pip install --upgrade plutoc` brings the newest one; by an older one, what has been"
        " mended since would be undone",
    )


def _first_difference(text: str, wanted: str | None) -> Span:
    """Return the first line that is not as it should be."""
    if wanted is None:
        return Span(0, 0)
    start = 0
    for line, other in zip(
        text.splitlines(keepends=True), wanted.splitlines(keepends=True), strict=False
    ):
        if line != other:
            return Span(start, start + len(line.rstrip()))
        start += len(line)
    return Span(start, start)


def _made_of(place: Place) -> Related:
    return Related(source=place.source, span=place.span, label="made of this app")
