"""The three files that an editor writes: an app's source, its hooks.py, and its layout."""

from __future__ import annotations

import os
import re
from collections.abc import Iterable, Iterator
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

from plutoc.editor.changes import between
from plutoc.editor.disk import Kept
from plutoc.editor.history import NO_CLIENT, File, History, Made
from plutoc.editor.merge import Conflict, merged
from plutoc.editor.wire import Wire
from plutoc.graph.app_names import taken_app_name
from plutoc.graph.names import is_well_formed, reserved
from plutoc.project.hooks import HOOKS
from plutoc.project.reading import UsageError, shown
from plutoc.report.layout import Positions
from plutoc.service.document import Document
from plutoc.service.picture.positions import positions_file, positions_in
from plutoc.source import Source
from plutoc.syntax.tree import BadStatement, BlockDecl

LAYOUT = ".layout"
_OTHER = re.compile(r"[^a-z0-9]+")


@dataclass(frozen=True, slots=True)
class Theirs:
    """What others have made of a file."""

    text: str | None
    """None where it cannot be edited."""
    why: str = ""


class AppFiles:
    """An app on the disk, with the history of what is made of it here."""

    def __init__(self, path: Path) -> None:
        if path.suffix.lower() != ".pluto":
            raise UsageError(
                f"{shown(path)} is no app: an app is a file whose name ends with .pluto"
            )
        if not path.parent.is_dir():
            raise UsageError(f"there is no folder {shown(path.parent)}")
        self.path = path
        self._document: Document | None = None
        self._hooks_seen: Source | None = None
        self.kept = {
            File.APP: Kept(path),
            File.LAYOUT: Kept(path.with_name(path.name + LAYOUT)),
        }
        app = self.kept[File.APP].read()
        self.history = History(app=_new_app(path) if app is None else app)
        self._first_layout = self._layout()
        self.kept[File.HOOKS] = Kept(self._hooks_path())
        self.history.hooks = self.kept[File.HOOKS].read()
        self._base = {File.APP: self.history.app, File.HOOKS: self.history.hooks}
        """What we and the disk had in common last."""
        self.conflicts: dict[File, Theirs] = {}
        """What others have written, where it is not clear how to put it together with ours."""
        self.unsaved: set[File] = set()
        self.history.positions = self._first_positions = self._still_there(
            _positions(self._first_layout)
        )

    @property
    def document(self) -> Document:
        """The app as it is now."""
        hooks = self.hooks
        now = self._document
        if now is None or now.text != self.history.app or self._hooks_seen != hooks:
            now = self._document = self.document_of(self.history.app, hooks)
            self._hooks_seen = hooks
        return now

    def document_of(self, text: str, hooks: Source | None) -> Document:
        """Return the app as it would be with another text, and other hooks."""
        before = self._document.sound if self._document else None
        return Document(path=shown(self.path), text=text, find_hooks=lambda _: hooks, before=before)

    @property
    def hooks(self) -> Source | None:
        """hooks.py with the line ends that Python sees."""
        text = self.history.hooks
        return None if text is None else Source(shown(self.hooks_path), Wire(text).shown)

    @property
    def hooks_path(self) -> Path:
        """Where hooks.py is, or would be."""
        return self.kept[File.HOOKS].path

    def note(self, made: Iterable[Made]) -> None:
        """Remember what has to be saved."""
        self.unsaved |= {one.file for one in made}

    def save(self, file: File) -> bool:
        """Save one file, and return whether that was needed.

        Raise `CannotSave`, or `ChangedOutside` where it must be looked at first.
        """
        if file in self.conflicts:  # until it is decided
            return False
        text = self._text(file)
        data = self._first_layout if text is None and file is File.LAYOUT else None
        self.kept[file].save(data if text is None else text.encode())
        self.unsaved.discard(file)
        if file is not File.LAYOUT:
            self._base[file] = text
        return True

    def look(self) -> Iterator[tuple[File, str, list[Made]]]:
        """Look at the files, and take in what others have changed: yield what came of it."""
        if self.history.hooks is None and self.kept[File.HOOKS].seen is None:
            with suppress(UsageError):  # a link, which is not followed
                self.kept[File.HOOKS].path = self._hooks_path()
        for file, kept in self.kept.items():
            try:
                if kept.is_changed():
                    yield file, *self._taken(file, kept)
            except UsageError as error:  # it is a text no more
                theirs = Theirs(None, str(error))
                if file is not File.LAYOUT and self.conflicts.get(file) != theirs:
                    self.conflicts[file] = theirs
                    yield file, "conflict", []

    def resolve(self, file: File, *, keep_ours: bool) -> list[Made]:
        """End a conflict; raise `UsageError` where there is no other text to be kept."""
        theirs = self.conflicts[file]
        if theirs.text is None and not keep_ours:
            raise UsageError(theirs.why)
        del self.conflicts[file]
        self._base[file] = theirs.text
        self.unsaved.add(file)
        return [] if keep_ours else self._becomes(file, theirs.text or "")

    def after_compile(self) -> list[Made]:
        """Look where hooks.py is now: a new package has one of its own."""
        path = self._hooks_path()
        if path == self.hooks_path:
            return []
        self.kept[File.HOOKS] = kept = Kept(path)
        text = kept.read()
        self._base[File.HOOKS] = text
        return [] if text is None else self._becomes(File.HOOKS, text)

    def _layout(self) -> bytes | None:
        try:
            return self.kept[File.LAYOUT].read_bytes()
        except UsageError:  # no file: there are no positions, and saving some will be refused
            return None

    def _text(self, file: File) -> str | None:
        if file is File.APP:
            return self.history.app
        if file is File.HOOKS:
            return self.history.hooks
        positions = self.history.positions
        return None if positions == self._first_positions else positions_file(positions)

    def _taken(self, file: File, kept: Kept) -> tuple[str, list[Made]]:
        if file is File.LAYOUT:
            return "merged", self._merged_layout(kept.seen, kept.read_bytes())
        theirs = kept.read()
        if theirs is None:
            return "gone", []
        ours, base = self.history.text(file), self._base[file] or ""
        if ours == theirs:
            text = ours
        elif ours == base:
            text = theirs
        else:
            try:
                text = merged(base, ours, theirs, self._statements(file, base))
            except Conflict:
                self.conflicts[file] = Theirs(theirs)
                return "conflict", []
        self.conflicts.pop(file, None)
        self._base[file] = theirs
        made = self._becomes(file, text)
        if text != theirs:
            self.unsaved.add(file)
        else:
            self.unsaved.discard(file)
        return "merged", made

    def _merged_layout(self, before: bytes | None, theirs: bytes | None) -> list[Made]:
        """Take over what others have moved, but for what was moved here since."""
        old, new = _positions(before), _positions(theirs)
        names = {name for name in {*old, *new} if old.get(name) != new.get(name)}
        ours = self.history.positions
        moved = {name: new.get(name) for name in names if ours.get(name) == old.get(name)}
        return self.history.change([self.history.placed(moved)], NO_CLIENT)

    def _becomes(self, file: File, text: str) -> list[Made]:
        edits = between(self.history.text(file), text)
        return self.history.change([self.history.edited(file, edits)], NO_CLIENT)

    def _statements(self, file: File, base: str) -> list[tuple[int, int]]:
        if file is not File.APP:
            return []
        tree = Document(path="", text=base).file
        position = tree.source.position
        return [
            (position(one.span.start)[0] - 1, position(one.span.end)[0] - 1)
            for one in (*tree.uses, *tree.app.statements)
        ]

    def _hooks_path(self) -> Path:
        """Return where the hooks.py is that counts, or where one would be."""
        name = self.document.graph.name
        beside = self.path.with_name(HOOKS)
        if not is_well_formed(name):
            return beside
        package = self.path.parent / name / "src" / name
        own = package / HOOKS
        if not (os.path.lexists(own) or (package.is_dir() and not os.path.lexists(beside))):
            return beside
        for folder in (package, *package.parents[:2]):
            if folder.is_symlink():
                raise UsageError(
                    f"{shown(folder)} is a symbolic link: hooks.py is not edited there"
                )
        return own

    def _still_there(self, positions: Positions) -> Positions:
        """Return positions without those of blocks that are gone, if all blocks can be read."""
        tree = self.document.file
        if tree.bad or any(isinstance(one, BadStatement) for one in tree.app.statements):
            return positions
        names = {one.name.text for one in tree.app.statements if isinstance(one, BlockDecl)}
        return {name: at for name, at in positions.items() if name in names}


def _positions(data: bytes | None) -> Positions:
    return positions_in((data or b"").decode("utf-8", "replace"))


def _new_app(path: Path) -> str:
    """Return a new app without blocks, named after its file."""
    stem = path.stem if path.stem != "app" else path.absolute().parent.name
    name = _OTHER.sub("_", stem.lower()).strip("_")
    if not is_well_formed(name) or reserved(name) or taken_app_name(name):
        name = "my_app"
    return f"pluto 1\n\napp {name} {{\n}}\n"
