"""*Compile*: what would change in the package, and what that means; then it is written."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from plutoc.check.model import Checked
from plutoc.compile import Compiled, analyse, compile_source
from plutoc.diagnostic import Rejected
from plutoc.diff.model import Version
from plutoc.diff.run import compare as compare_meaning
from plutoc.editor.asked import Refused
from plutoc.emit.write import CannotWrite, Changes, write
from plutoc.project.hooks import default_folder, find_hooks, hooks_path
from plutoc.project.package import changes_of, known_hooks
from plutoc.project.patch import patch_of
from plutoc.project.reading import shown
from plutoc.source import Source
from plutoc_runtime.domain.text import counted, printable

Data = dict[str, object]


@dataclass(frozen=True, slots=True, kw_only=True)
class Snapshot:
    """An app at one moment, for work that takes its time."""

    path: Path
    text: str
    hooks: Source | None
    hooks_path: Path

    def find_hooks(self, checked: Checked) -> Source | None:
        """Return the hooks.py that counts: as it is edited, unless the package has another one."""
        folder = default_folder(self.path, checked.graph)
        own = folder / hooks_path(checked.graph)
        if own.is_file() and own != self.hooks_path:
            return find_hooks(checked.graph, self.path, folder)
        return self.hooks


def compiled(app: Snapshot, *, optimise: bool = True) -> Compiled:
    """Return an app's package; raise `Refused` with what is wrong with it."""
    try:
        return compile_source(
            Source(shown(app.path), app.text),
            source_name=app.path.name,
            find_hooks=app.find_hooks,
            optimise=optimise,
            known_hooks=lambda checked: known_hooks(
                checked, default_folder(app.path, checked.graph)
            ),
        )
    except Rejected as rejected:
        raise refused(rejected) from None
    except CannotWrite as error:
        raise Refused(printable(str(error))) from None


def refused(rejected: Rejected) -> Refused:
    """Say in a sentence what is wrong."""
    first, *others = rejected.diagnostics
    line = first.source.position(first.span.start)[0]
    more = f" (and {counted(len(others), 'more finding')})" if others else ""
    help = f"; {first.help}" if first.help else ""
    return Refused(f"{first.code}, line {line} of {first.source.path}: {first.message}{help}{more}")


def preview(app: Snapshot, former: str | None) -> Data:
    """Return what compiling would change; `former` is the text that the package was made of."""
    made = compiled(app)
    changes = _changes(app, made)
    changed = {change.path: change for change in changes.files}
    paths = sorted({*made.package.owned, *made.package.once, *changed})
    files: list[Data] = []
    for path in paths:
        change = changed.get(path)
        status = "same"
        if change is not None:
            status = "changed"
            if change.before is None or change.after is None:
                status = "new" if change.before is None else "deleted"
        diff = "\n".join(patch_of(change)) if change else ""
        files.append({"path": path, "status": status, "diff": diff})
    return {
        "files": files,
        "meaning": _meaning(former, made) if former is not None else [],
        "known": former is not None,
        "first": changes.first,
        "folder": changes.folder.name,
    }


def written(app: Snapshot) -> Data:
    """Write an app's package, all of it or nothing; raise `Refused` where that cannot be."""
    changes = _changes(app, compiled(app))
    try:
        write(changes)
    except CannotWrite as error:
        raise Refused(f"{printable(str(error))}; nothing was changed") from None
    return {
        "files": [{"path": one.path} for one in changes.files],
        "folder": changes.folder.name,
        "written": len(changes.files),
    }


def is_of(app: Snapshot) -> bool:
    """Return whether the package that is there is what this app would be compiled to."""
    try:
        changes = _changes(app, compiled(app))
    except Refused:
        return False
    return not changes.first and not changes.files


def _changes(app: Snapshot, made: Compiled) -> Changes:
    try:
        return changes_of(made, default_folder(app.path, made.checked.graph))
    except Rejected as rejected:
        raise refused(rejected) from None
    except CannotWrite as error:
        raise Refused(printable(str(error))) from None


def _meaning(former: str, made: Compiled) -> list[str]:
    """Return sentences on what changed in meaning; an app that was broken means nothing."""
    source = made.checked.graph.source
    try:
        before, warnings = analyse(Source(source.path, former))
    except Rejected:
        return []
    found = compare_meaning(
        Version(checked=before, warnings=warnings),
        Version(checked=made.checked, warnings=made.warnings),
    )
    return [change.sentence for change in found.changes]
