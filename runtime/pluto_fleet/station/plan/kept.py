"""Plans in the station's folder: the one that is drawn, and those that are kept under names."""

from __future__ import annotations

import asyncio
import json
import os
import re
import time
import unicodedata
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

import msgspec

from ...files.reading import LARGEST, decoded, listed
from ...process.whole_file import write_whole
from ...shared.domain import values
from ...shared.domain.errors import BadInput
from ...shared.domain.text import cut_off, printable, quoted
from ...shared.domain.values import shown
from .shape import Shape, missions_from, without_unknown

if TYPE_CHECKING:
    from ...app import App
    from ..wire import SavedPlan, SavedPlans, TrashedPlan

_NOT_JSON = "it is damaged, or is something else"


@dataclass(frozen=True, slots=True, kw_only=True)
class KeptPlan:
    """A stored plan."""

    missions: Sequence[Shape] = ()
    revision: int = 0
    said: str = ""


class _Head(msgspec.Struct):
    version: Literal[1]
    app: str


class _File(_Head):
    revision: Annotated[int, msgspec.Meta(ge=0)]
    missions: list[dict[str, Any]]


class _Unreadable(Exception):
    """The file is not a plan of this app."""


def write(path: Path, app: App, revision: int, missions: Sequence[Shape]) -> None:
    """Store a plan atomically; raise `OSError` if that fails."""
    data = {"version": 1, "app": app.name, "revision": revision, "missions": missions}
    text = json.dumps(data, ensure_ascii=False, separators=(",", ":"))
    write_whole(path, text, durable=True)


def read(path: Path, app: App) -> KeptPlan:
    """Return the stored plan; an unreadable one is renamed, with a message."""
    if not os.path.lexists(path):
        return KeptPlan()
    try:
        content = _content(path)
        kept, gone = _kept(content, app)
    except _Unreadable as error:
        aside = _put_aside(path, str(error), lambda aside: os.replace(path, aside))
        return KeptPlan(
            said=f"The plan that was kept cannot be read: {error}. It lies in {aside}, "
            f"and {printable(str(path))} begins anew."
        )
    if not gone:
        return kept
    aside = _put_aside(path, "it is of another app", lambda aside: aside.write_bytes(content))
    said = (
        f"The plan that was kept has {listed(gone)}, which this app does not have any more. The "
        f"rest is here; as it was, it lies in {aside}."
    )
    return KeptPlan(missions=kept.missions, revision=kept.revision, said=said)


def _content(path: Path) -> bytes:
    try:
        if path.is_file():  # a pipe is not waited for
            return path.read_bytes()
    except OSError as error:
        raise _Unreadable((error.strerror or str(error)).lower()) from None
    raise _Unreadable(_NOT_JSON)


def _kept(content: bytes, app: App) -> tuple[KeptPlan, list[str]]:
    """Return a plan, and the fields in it that only an earlier graph of the app had."""
    try:
        head = msgspec.json.decode(content, type=_Head)
        if head.app != app.name:
            raise _Unreadable(f"it is of {shown(head.app)}, and this is {app.name}")
        data = msgspec.json.decode(content, type=_File)
        missions, gone = without_unknown(data.missions, app)
    except (msgspec.DecodeError, RecursionError):
        raise _Unreadable(_NOT_JSON) from None
    try:
        shapes = missions_from(missions, app)
    except BadInput as error:
        raise _Unreadable(str(error)) from None
    for shape, was in zip(shapes, missions, strict=True):
        shape["launched"] = was.get("launched") is True
        shape["ended"] = was.get("ended")
        if was.get("done"):
            shape["done"] = was["done"]
    return KeptPlan(missions=shapes, revision=data.revision), gone


def _put_aside(path: Path, why: str, put: Callable[[Path], object]) -> str:
    """Put a plan under an unused name beside its own, and return that for people."""
    aside = path.with_name(f"{path.name}.bad")
    number = 1
    while os.path.lexists(aside):
        number += 1
        aside = path.with_name(f"{path.name}.bad-{number}")
    try:
        put(aside)
    except OSError as error:
        raise BadInput(
            f"{path}: the plan that was kept cannot be read ({why}), and cannot be put aside either: "
            f"{error.strerror or error}"
        ) from None
    return printable(str(aside))


SUFFIX = ".toml"
TRASH = "trash"
MOST = 500
MOST_IN_TRASH = 100
"""The most plans that are kept; of those in the trash the newest."""

_LONGEST = 80
_LONGEST_BYTES = 200
_FORBIDDEN = re.compile(r'[/\\:*?"<>|]')
_ABOUT = "# station: "
"""How the first line begins, which tells about the plan in JSON; a plan without it may be one, too."""

_IN_TRASH = re.compile(r"([0-9a-f]{12})~(.+)")

Read = Callable[[str, str], tuple[Sequence[object], str]]
"""Returns the missions of a text with a name, and what is still wrong; raises `BadInput` if it is no plan."""


class PlanLibrary:
    """The plans of one folder, each in a file of its name."""

    def __init__(self, folder: Path, read: Read, now: Callable[[], float] = time.time) -> None:
        self._folder = folder
        self._trash = folder / TRASH
        self._read = read
        self._now = now
        self.one_at_a_time = asyncio.Lock()
        """To be held while a thread does any of this."""
        self._known: dict[Path, tuple[object, SavedPlan]] = {}
        """What was found in files that have not changed since."""

    def everything(self) -> SavedPlans:
        """Return all plans, and what is in the trash."""
        return {"plans": self.plans(), "trash": self.trash()}

    def plans(self) -> list[SavedPlan]:
        """Return all plans, also those that cannot be read, with what is wrong; the newest first."""
        known = {file: self._about(file) for file in _files(self._folder)}
        self._known = known
        return sorted((plan for _, plan in known.values()), key=lambda one: -one["saved_at"])

    def trash(self) -> list[TrashedPlan]:
        """Return what was deleted, the newest first."""
        found: list[TrashedPlan] = []
        for file in _files(self._trash):
            if (parts := _IN_TRASH.fullmatch(file.stem)) is not None:
                found.append({"id": file.stem, "name": parts[2], "deleted_at": int(parts[1], 16)})
        return sorted(found, key=lambda one: -one["deleted_at"])

    def save(self, name: str, text: str, by: str, *, template: bool, replace: bool) -> None:
        """Keep a plan under a name; one that has it goes to the trash, if it may be replaced."""
        file = self._file(name)
        if not text:
            raise BadInput("the plan is empty: there is nothing to keep yet")
        about = json.dumps({"by": cut_off(printable(by), _LONGEST), "template": template})
        content = f"{_ABOUT}{about}\n{text}".encode()
        if len(content) > LARGEST:
            raise BadInput("the plan is too large to be kept under a name: export it instead")
        others = [one for one in _files(self._folder) if one != file]
        if len(others) >= MOST:
            raise BadInput(f"{MOST} plans are kept already: delete one first")
        if file.exists() and not replace:
            raise BadInput(
                f"there is a plan {quoted(file.stem)} already: replace it, or take another name"
            )
        try:
            self._folder.mkdir(mode=0o700, exist_ok=True)
            if file.exists():
                self._throw_away(file)
            write_whole(file, content, durable=True)
        except OSError as error:
            raise BadInput(f"the plan cannot be kept: {error.strerror or error}") from None

    def text(self, name: str) -> str:
        """Return a plan as a missions file."""
        return _text(self._found(name))

    def delete(self, name: str) -> None:
        """Put a plan into the trash."""
        file = self._found(name)
        try:
            self._throw_away(file)
        except OSError as error:
            raise BadInput(f"the plan cannot be deleted: {error.strerror or error}") from None

    def restore(self, id: str) -> None:
        """Take a plan out of the trash, under its name."""
        for file in _files(self._trash):
            parts = _IN_TRASH.fullmatch(file.stem)
            if file.stem != id or parts is None:
                continue
            place = self._file(parts[2])
            if place.exists():
                raise BadInput(f"there is a plan {quoted(parts[2])} again: delete that one first")
            try:
                file.rename(place)
            except OSError as error:
                raise BadInput(f"the plan cannot be restored: {error.strerror or error}") from None
            return
        raise BadInput("this plan is not in the trash any more")

    def _file(self, name: str) -> Path:
        """Return the file of a name; raise `BadInput` if it can be none."""
        proper = unicodedata.normalize("NFC", name)
        try:
            values.name(proper)
        except ValueError as error:
            raise BadInput(f"the plan's name {quoted(name)} {error}") from None
        if _FORBIDDEN.search(proper) or proper.startswith("."):
            raise BadInput(
                f"the plan's name {quoted(name)} cannot be that of a file: it may not begin with a point,"
                ' nor hold / \\ : * ? " < > |'
            )
        if len(proper) > _LONGEST or len(proper.encode()) > _LONGEST_BYTES:
            raise BadInput(f"the plan's name {quoted(name)} is too long: write a shorter one")
        return self._folder / f"{proper}{SUFFIX}"

    def _found(self, name: str) -> Path:
        file = self._file(name)
        if file not in _files(self._folder):
            raise BadInput(f"there is no plan {quoted(name)}")
        return file

    def _throw_away(self, file: Path) -> None:
        """Move a file to the trash, of which the oldest go for good."""
        self._trash.mkdir(mode=0o700, exist_ok=True)
        stamp = round(self._now() * 1000)
        while (place := self._trash / f"{stamp:012x}~{file.name}").exists():
            stamp += 1
        file.rename(place)
        for old in sorted(_files(self._trash))[:-MOST_IN_TRASH]:
            old.unlink()

    def _about(self, file: Path) -> tuple[object, SavedPlan]:
        """Return what is to be told of a plan, and when its file was like this."""
        found = file.stat()
        state = found.st_mtime_ns, found.st_size
        known = self._known.get(file)
        if known is not None and known[0] == state:
            return known
        plan: SavedPlan = {
            "name": file.stem,
            "saved_at": found.st_mtime_ns // 1_000_000,
            "by": "",
            "missions": None,
            "template": False,
            "said": "",
        }
        try:
            text = _text(file)
            about = _about_in(text)
            plan["by"], plan["template"] = str(about.get("by", "")), about.get("template") is True
            missions, plan["said"] = self._read(text, file.name)
            plan["missions"] = len(missions)
        except BadInput as error:
            plan["said"] = str(error)
        return state, plan


def _files(folder: Path) -> Iterator[Path]:
    """Yield the files of plans in a folder, links and folders left out."""
    try:
        found = sorted(folder.iterdir())
    except FileNotFoundError:  # nothing was kept yet
        return
    for file in found:
        if file.suffix == SUFFIX and file.is_file() and not file.is_symlink():
            yield file


def _text(file: Path) -> str:
    try:
        with file.open("rb") as opened:
            return decoded(opened.read(LARGEST + 1), file.name, drawn=False)
    except OSError as error:
        raise BadInput(f"{file.name}: it cannot be read: {error.strerror or error}") from None


def _about_in(text: str) -> dict[str, object]:
    """Return what the first line tells about a plan."""
    first = text.partition("\n")[0]
    if not first.startswith(_ABOUT):
        return {}
    try:
        found = json.loads(first.removeprefix(_ABOUT))
    except (ValueError, RecursionError):
        return {}  # it was written over: the plan itself may be as good
    return found if isinstance(found, dict) else {}
