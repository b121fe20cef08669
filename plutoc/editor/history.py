"""An app being edited: its text, its hooks.py and its layout, in versions, with one history over all three.

Every change goes through `History.change`, also one that comes from outside. So undo is exact: it
leads back through the very same texts, byte for byte.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from enum import Enum
from itertools import islice
from types import MappingProxyType

from plutoc.editor.changes import Edits, Overlap, in_order, inverse, length, made, rebased
from plutoc.editor.wire import NoSuchPlace, Wire, units
from plutoc.report.layout import Point, Positions
from plutoc.source import LARGEST

TOGETHER = 1.0
"""Seconds within which one goes on typing: then it is undone together."""
_REMEMBERED = 1_000
"""Versions over which typed text is rebased."""
_NONE: Edits = ()
_MOST = 50_000_000
"""Characters that the steps to undo may hold; beyond, the oldest are forgotten."""
NO_CLIENT = 0
"""The number of no client: the disk changed it."""


class File(Enum):
    """What a version changes."""

    APP = "app"
    HOOKS = "hooks"
    LAYOUT = "layout"


class TooLarge(Exception):
    """A text would be larger than the compiler reads. The message is a sentence for a person."""


class Stale(Exception):
    """Typed text cannot be put where it was meant: the text there has changed meanwhile."""


@dataclass(frozen=True, slots=True)
class TextChange:
    """Edits of the app's text or of hooks.py, and the way back."""

    file: File
    edits: Edits
    back: Edits
    begins: bool = False
    """There was no such file before."""
    ends: bool = False
    """There is no such file behind."""

    @property
    def reversed(self) -> TextChange:
        """The change that takes this one back."""
        return TextChange(self.file, self.back, self.edits, self.ends, self.begins)


@dataclass(frozen=True, slots=True)
class LayoutChange:
    """All positions before and behind."""

    before: Positions
    after: Positions

    @property
    def reversed(self) -> LayoutChange:
        """The change that takes this one back."""
        return LayoutChange(self.after, self.before)


Change = TextChange | LayoutChange


@dataclass(frozen=True, slots=True, kw_only=True)
class Made:
    """A change that was made: a version."""

    version: int
    by: int
    file: File
    sent: Edits
    """The edits as a browser makes them."""
    is_typed: bool


@dataclass(slots=True)
class _Step:
    """What is undone together."""

    changes: list[Change]
    typed_by: int = NO_CLIENT
    at: float = 0.0
    """When it was typed last."""

    @property
    def size(self) -> int:
        texts = [one for one in self.changes if isinstance(one, TextChange)]
        return sum(length(one.edits) + length(one.back) for one in texts)


@dataclass
class History:
    """The texts as they are, and how they came about."""

    app: str
    hooks: str | None = None
    positions: Positions = field(default_factory=dict)
    version: int = 0
    _done: deque[_Step] = field(default_factory=deque)
    _undone: list[_Step] = field(default_factory=list)
    _log: deque[Made] = field(default_factory=lambda: deque(maxlen=_REMEMBERED))
    _size: int = 0

    def text(self, file: File) -> str:
        """Return a text as it is; that of hooks.py is empty where there is none."""
        return self.app if file is File.APP else self.hooks or ""

    @property
    def depth(self) -> Mapping[str, int]:
        """How many steps can be undone, and done again."""
        return {"undo": len(self._done), "redo": len(self._undone)}

    def edited(self, file: File, edits: Edits) -> TextChange:
        """Return the change that edits make of a text as it is."""
        text = self.text(file)
        if len(made(text, edits).encode()) > LARGEST:
            raise TooLarge(f"a file can have at most {LARGEST // 1024} KiB")
        begins = file is File.HOOKS and self.hooks is None
        return TextChange(file, edits, inverse(text, edits), begins)

    def placed(self, moved: Mapping[str, Point | None]) -> LayoutChange:
        """Return the change that moves blocks, or gives them back to the layout."""
        after = {**self.positions, **{name: at for name, at in moved.items() if at is not None}}
        given_back = {name for name, at in moved.items() if at is None}
        kept = {name: at for name, at in after.items() if name not in given_back}
        return LayoutChange(self.positions, MappingProxyType(kept))

    def change(self, changes: Sequence[Change], by: int) -> list[Made]:
        """Make changes, each of the texts as they are now, as one step."""
        changes = [one for one in changes if _is_change(one)]
        if not changes:
            return []
        self._undone.clear()
        self._remember(_Step(list(changes)))
        return [self._make(one, by) for one in changes]

    def type(self, file: File, edits: Edits, version: int, by: int, now: float) -> Made | None:
        """Put typed text in, as a browser counts; None where it changes nothing.

        It may be meant for an earlier version; `Stale` where that cannot be done.
        """
        wire = Wire(self.text(file))
        try:
            edits = wire.received(in_order(self._since(version, file, by, edits)))
        except (Overlap, NoSuchPlace) as error:
            raise Stale(str(error)) from None
        change = self.edited(file, edits)
        if not _is_change(change):
            return None
        self._undone.clear()
        last = self._done[-1] if self._done else None
        if last is not None and last.typed_by == by and self._goes_on(last, change, now):
            last.changes.append(change)
            last.at = now
            self._size += length(change.edits) + length(change.back)
        else:
            self._remember(_Step([change], by, now))
        return self._make(change, by, is_typed=True)

    def undo(self, by: int) -> list[Made]:
        """Take the last step back; nothing where there is none."""
        if not self._done:
            return []
        step = self._done.pop()
        self._size -= step.size
        self._undone.append(step)
        return [self._make(one.reversed, by) for one in reversed(step.changes)]

    def redo(self, by: int) -> list[Made]:
        """Do again what was taken back last."""
        if not self._undone:
            return []
        step = self._undone.pop()
        self._remember(replace(step, typed_by=NO_CLIENT))
        return [self._make(one, by) for one in step.changes]

    def _since(self, version: int, file: File, by: int, edits: Edits) -> Edits:
        """Return edits of an earlier version as they are now."""
        behind = self.version - version
        if not 0 <= behind <= len(self._log):
            raise Stale("that version is not known any more")
        for made_since in islice(self._log, len(self._log) - behind, None):
            if made_since.file is not file:
                continue
            if made_since.is_typed and made_since.by == by:
                raise Stale("what was typed before had not been answered")
            edits = rebased(edits, made_since.sent, units)
        return edits

    @staticmethod
    def _goes_on(last: _Step, change: TextChange, now: float) -> bool:
        """Return whether someone just goes on typing, or deleting, at the same place."""
        before = last.changes[-1]
        if not isinstance(before, TextChange) or before.file is not change.file:
            return False
        if now - last.at > TOGETHER or not len(before.edits) == len(change.edits) == 1:
            return False
        (left,), (one,) = before.back, change.edits
        return left.start <= one.end and one.start <= left.end

    def _remember(self, step: _Step) -> None:
        self._done.append(step)
        self._size += step.size
        while self._size > _MOST and len(self._done) > 1:
            self._size -= self._done.popleft().size

    def _make(self, change: Change, by: int, *, is_typed: bool = False) -> Made:
        self.version += 1
        file, sent = File.LAYOUT, _NONE
        if isinstance(change, LayoutChange):
            self.positions = change.after
        else:
            file, before = change.file, self.text(change.file)
            after = made(before, change.edits)
            sent = Wire(before).sent(change.edits, Wire(after))
            if file is File.APP:
                self.app = after
            else:
                self.hooks = None if change.ends else after
        done = Made(version=self.version, by=by, file=file, sent=sent, is_typed=is_typed)
        self._log.append(done)
        return done


def _is_change(change: Change) -> bool:
    if isinstance(change, LayoutChange):
        return dict(change.before) != dict(change.after)
    texts = zip(change.edits, change.back, strict=True)
    return change.begins or change.ends or any(one.text != old.text for one, old in texts)
