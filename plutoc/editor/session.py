"""One app being edited by its clients: what changes it, and what all are told of that."""

from __future__ import annotations

import asyncio
import json
import time
from collections.abc import Callable, Coroutine, Mapping, Sequence
from dataclasses import replace
from pathlib import Path

from plutoc.editor import asked as read
from plutoc.editor import compiling, gestures, running
from plutoc.editor.app_files import AppFiles
from plutoc.editor.asked import Asked, Refused
from plutoc.editor.compiling import Snapshot
from plutoc.editor.disk import CannotSave, ChangedOutside
from plutoc.editor.gestures import Gesture
from plutoc.editor.history import NO_CLIENT, File, Made, Stale, TooLarge
from plutoc.editor.questions import QUESTIONS, hook_function
from plutoc.editor.wire import Wire
from plutoc.mistake import traceback_of
from plutoc.project.reading import UsageError
from plutoc.report.layout import Positions
from plutoc.service.document import Document
from plutoc.service.editing.edit import CannotEdit
from plutoc.service.editing.operations import NotAnOperation
from plutoc.service.picture.palette import palette
from plutoc.service.picture.view import view
from plutoc_runtime import output
from plutoc_runtime.domain.text import said

SAVE_AFTER, LOOK_EVERY, AGAIN_AFTER = 0.3, 0.4, 2.0
"""Seconds: from a change to its saving, between two looks at the disk, to the next try."""
BEHIND = 64 * 1024 * 1024
"""Characters that a client may be behind; then it is let go, and comes back for the whole."""
_OPERATIONS = 100
_SLOW = ("compile", "run")
"""What takes its time: a client has one of them at a time, and a new one ends the one before."""

Data = dict[str, object]


class Client:
    """A page that is connected."""

    def __init__(self, number: int) -> None:
        self.number = number
        self._outbox: asyncio.Queue[str | None] = asyncio.Queue()
        self._behind = 0
        self._task: asyncio.Task[None] | None = None
        self._answer: Data = {}

    def start(self, work: Coroutine[object, object, None], answer: Data) -> None:
        """Begin work that takes its time, and is answered with this and more."""
        self.end()
        self._task, self._answer = asyncio.create_task(work), answer

    def end(self) -> None:
        """End that work, if it is not done."""
        if self._task is not None and not self._task.done():
            self._task.cancel()
            self.send(self._answer | {"error": "this was ended, as another one was begun"})

    def send(self, message: Data) -> None:
        """Send a message."""
        self.send_text(json.dumps(message, separators=(",", ":")))

    def send_text(self, text: str) -> None:
        """Send a message that is written already; a client that does not read is let go."""
        if self._behind <= BEHIND:
            self._behind += len(text)
            self._outbox.put_nowait(text if self._behind <= BEHIND else None)

    async def next(self) -> str | None:
        """Return the next message that it is to be sent; None: it is let go."""
        text = await self._outbox.get()
        self._behind -= len(text or "")
        return text


class Session:
    """The app and its clients."""

    def __init__(self, path: Path) -> None:
        self.files = AppFiles(path)
        self._clients: dict[int, Client] = {}
        self._last = NO_CLIENT
        self._asked: object = None
        """The id of what is being done for a client: it knows its own changes by it."""
        self._changed = asyncio.Event()
        self._cannot_save = ""
        self._seen: tuple[object, object] | None = None
        self._view: Data = {}
        self._palette = palette()
        self._opened = self.files.history.app
        self._package_text: str | None = None
        """What the package was made of, where that is known."""
        self._writes_package = False
        """While it does, a hooks.py that appears in there is no change of others."""
        self._changes: Mapping[str, Callable[[Client, Asked], Data]] = {
            "edit": self._edit,
            "type": self._type,
            "undo": lambda client, _: self._done(self.files.history.undo(client.number)),
            "redo": lambda client, _: self._done(self.files.history.redo(client.number)),
            "place": self._place,
            "tidy": self._tidy,
            "fix": self._fix,
            "format": lambda client, _: self._do(client, gestures.formatted(self.files)),
            "stub": self._stub,
            "resolve": self._resolve,
        }

    def join(self) -> Client:
        """Take a client in, and tell it all there is."""
        self._last += 1
        client = Client(self._last)
        self._clients[client.number] = client
        client.send(self._hello(client))
        for file in self.files.conflicts:
            client.send(self._conflict(file))
        if self._cannot_save:
            client.send({"push": "cannot_save", "why": self._cannot_save})
        return client

    def leave(self, client: Client) -> None:
        """Let a client go."""
        client.end()
        self._clients.pop(client.number, None)

    async def hear(self, client: Client, message: str, *, slow: bool = False) -> None:
        """Do what a client asks, and answer: nothing that it sends does more than to be refused.

        What takes its time goes on beside, and is answered when it is done.
        """
        answer: Data = {}
        try:
            asked = read.parsed(message)
            if type(asked.get("id")) in (int, str):
                answer["id"] = asked["id"]
            if asked.get("op") in _SLOW and not slow:
                client.start(self.hear(client, message, slow=True), answer)
                return
            answer |= await self._answer(client, asked)
        except (Refused, CannotEdit, NotAnOperation, TooLarge, UsageError) as error:
            answer["error"] = str(error)
        except Exception as error:  # noqa: BLE001 - a mistake of ours ends no one's work
            answer["error"] = _internal(error)
        client.send(answer)

    async def _answer(self, client: Client, asked: Asked) -> Data:
        op = asked.get("op")
        if op == "compile":
            return await self._compile(client, asked)
        if op == "run":
            return await self._run(asked)
        if isinstance(op, str) and op in self._changes:
            self._asked = asked.get("id")
            return self._changes[op](client, asked)
        if isinstance(op, str) and op in QUESTIONS:
            return QUESTIONS[op](self.files, asked)
        raise Refused(f"op must be one of {', '.join((*self._changes, *QUESTIONS, *_SLOW))}")

    def _tell(self, message: Data) -> None:
        text = json.dumps(message, separators=(",", ":"))
        for client in self._clients.values():
            client.send_text(text)

    def _hello(self, client: Client) -> Data:
        files = self.files
        return {
            "push": "hello",
            "client": client.number,
            "version": files.history.version,
            "text": Wire(files.history.app).shown,
            "hooks": self._hooks(),
            "view": self.view(),
            "palette": self._palette,
            "history": files.history.depth,
            "file": files.path.name,
            "title": files.document.graph.title,
        }

    def _hooks(self) -> Data | None:
        hooks = self.files.hooks
        if hooks is None:
            return None
        path = self.files.hooks_path.relative_to(self.files.path.parent)
        return {"path": path.as_posix(), "text": hooks.text}

    def view(self) -> Data:
        """Return the picture of the app as it is now."""
        document, positions = self.files.document, self.files.history.positions
        if self._seen is None or self._seen[0] is not document or self._seen[1] is not positions:
            try:
                self._view = self._drawn(document, positions)
            except Exception as error:  # noqa: BLE001 - the text must be told all the same
                self._view = _without_view(self._view, _internal(error))
            self._seen = (document, positions)
        return self._view

    def _drawn(self, document: Document, positions: Positions) -> Data:
        hooks = self.files.hooks
        return view(
            document,
            positions,
            hooks=hooks,
            offset=Wire(document.text).on_wire,
            hooks_offset=Wire(hooks.text if hooks else "", marked=False).on_wire,
        )

    def _do(self, client: Client, gesture: Gesture) -> Data:
        made = self.files.history.change(gesture.changes, client.number)
        return self._done(made, gesture.names)

    def _done(self, made: Sequence[Made], names: Sequence[str] = ()) -> Data:
        """Tell all what was changed, and have it saved."""
        if made:
            self.files.note(made)
            self._tell_changes(made, names)
            self._changed.set()
        return {"version": self.files.history.version, "new": list(names)}

    def _tell_changes(self, made: Sequence[Made], names: Sequence[str] = ()) -> None:
        hooks = self._hooks()
        for one in made:
            self._tell(
                {
                    "push": "change",
                    "version": one.version,
                    "by": one.by,
                    "asked": self._asked if one.by != NO_CLIENT else None,
                    "file": one.file.value,
                    "changes": [{"from": e.start, "to": e.end, "insert": e.text} for e in one.sent],
                    "view": self.view(),
                    "history": self.files.history.depth,
                    "new": list(names),
                    "hooks": hooks["path"] if hooks else None,
                }
            )

    def _type(self, client: Client, asked: Asked) -> Data:
        file, version, edits = read.file(asked), read.number(asked, "version"), read.edits(asked)
        history = self.files.history
        try:
            made = history.type(file, edits, version, client.number, time.monotonic())
        except Stale:
            shown = Wire(history.text(file)).shown
            return {"stale": True, "version": history.version, "text": shown}
        return self._done([made] if made else [])

    def _edit(self, client: Client, asked: Asked) -> Data:
        given = asked.get("operations", [asked.get("operation")])
        if not isinstance(given, list) or not 0 < len(given) <= _OPERATIONS:
            raise Refused("operations must be a list of objects")
        gesture = gestures.operations(self.files, given, read.positions(asked))
        answer = self._do(client, gesture)
        return answer | ({"note": gesture.note} if gesture.note else {})

    def _place(self, client: Client, asked: Asked) -> Data:
        positions = read.positions(asked)
        there = {name: at for name, at in positions.items() if name}
        return self._do(client, Gesture(changes=[self.files.history.placed(there)]))

    def _tidy(self, client: Client, asked: Asked) -> Data:
        history = self.files.history
        return self._do(client, Gesture(changes=[history.placed(dict.fromkeys(history.positions))]))

    def _fix(self, client: Client, asked: Asked) -> Data:
        return self._do(client, gestures.fix(self.files, read.number(asked, "problem")))

    def _stub(self, client: Client, asked: Asked) -> Data:
        """Say where a hook's function is; where there is none yet, its stub is written first."""
        name = read.text(asked, "name")
        there = hook_function(self.files, name)
        if there is not None:
            return there
        answer = self._do(client, gestures.stub(self.files, name))
        return answer | (hook_function(self.files, name) or {"file": File.HOOKS.value})

    def _resolve(self, client: Client, asked: Asked) -> Data:
        keep = asked.get("keep")
        if keep not in ("ours", "theirs"):
            raise Refused("keep must be ours or theirs")
        found = [
            file for file in self.files.conflicts if asked.get("file", file.value) == file.value
        ]
        if not found:
            raise Refused("there is nothing to decide any more")
        made = self.files.resolve(found[0], keep_ours=keep == "ours")
        answer = self._done(made)
        self._tell({"push": "disk", "what": "resolved", "file": found[0].value, "kept": keep})
        self._changed.set()
        return answer

    async def _compile(self, client: Client, asked: Asked) -> Data:
        """Say what compiling would change, or do it; a package is made of what is saved."""
        self.save()
        app = self._snapshot()
        if asked.get("write") is not True:
            if self._package_text is None:
                opened = replace(app, text=self._opened)
                self._package_text = (
                    self._opened if await asyncio.to_thread(compiling.is_of, opened) else None
                )
            return await asyncio.to_thread(compiling.preview, app, self._package_text)
        if self.files.conflicts:
            raise Refused("others have changed this app: decide first which text is to be kept")
        # a page that goes meanwhile ends neither the writing nor what follows from it
        return await asyncio.shield(self._write_package(app))

    async def _write_package(self, app: Snapshot) -> Data:
        self._writes_package = True
        try:
            answer = await asyncio.to_thread(compiling.written, app)
        finally:
            self._writes_package = False
        self._package_text = app.text
        self._done(self.files.after_compile())
        return answer

    async def _run(self, asked: Asked) -> Data:
        missions = asked.get("missions")
        if missions is not None:
            missions = read.text(asked, "missions")
        return await running.run(self._snapshot(), missions, read.number(asked, "seed", 0))

    def _snapshot(self) -> Snapshot:
        files = self.files
        return Snapshot(
            path=files.path,
            text=files.history.app,
            hooks=files.hooks,
            hooks_path=files.hooks_path,
        )

    def _conflict(self, file: File) -> Data:
        theirs = self.files.conflicts[file]
        return {
            "push": "disk",
            "what": "conflict",
            "file": file.value,
            "ours": Wire(self.files.history.text(file)).shown,
            "theirs": None if theirs.text is None else Wire(theirs.text).shown,
            "why": theirs.why,
        }

    @property
    def lost(self) -> str:
        """Why something would be lost if it ended now; empty: nothing would."""
        if self.files.conflicts:
            return "others have changed the app, and it is not decided which text is to be kept"
        return self._cannot_save if self.files.unsaved else ""

    async def keep_saving(self) -> None:
        """Save what is changed, soon after each change, until cancelled."""
        self._changed = asyncio.Event()  # of this loop
        if self.files.unsaved:
            self._changed.set()
        while True:
            await self._changed.wait()
            self._changed.clear()
            await asyncio.sleep(SAVE_AFTER)
            if not self.save():
                asyncio.get_running_loop().call_later(AGAIN_AFTER, self._changed.set)

    def save(self) -> bool:
        """Save what is not saved yet; return whether that could be done, and tell where not."""
        why, saved = "", False
        for file in sorted(self.files.unsaved, key=lambda one: one.value):
            try:
                saved |= self.files.save(file)
            except ChangedOutside:
                self.look()
            except CannotSave as error:
                why = str(error)
        if why and why != self._cannot_save:
            self._tell({"push": "cannot_save", "why": why})
        if saved and not why:
            self._tell({"push": "disk", "what": "saved"})
        self._cannot_save = why
        return not why

    async def keep_looking(self) -> None:
        """Look whether others change the files, until cancelled."""
        while True:
            await asyncio.sleep(LOOK_EVERY)
            self.look()

    def look(self) -> None:
        """Take in what others have changed, and tell it."""
        if self._writes_package:
            return
        for file, what, made in list(self.files.look()):
            self._tell_changes(made)
            if what == "conflict":
                self._tell(self._conflict(file))
            else:
                self._tell({"push": "disk", "what": what, "file": file.value})
        if self.files.unsaved:
            self._changed.set()


def _internal(error: Exception) -> str:
    """Tell of a mistake of ours, and return the sentence."""
    text = f"something went wrong inside the editor (P9001): {said(error)}"
    output.tell(f"plutoc edit: {text}")
    if where := traceback_of(error):
        output.tell(where)
    return text


def _without_view(last: Data, why: str) -> Data:
    """Return the last picture there was, with what keeps the new one from being drawn."""
    empty: Data = {"app": "", "title": "", "ends": {"start": [0, 0], "end": [320, 0]}}
    empty |= {name: [] for name in ("blocks", "edges", "hooks", "categories", "unreadable")}
    problem: Data = {"code": "P9001", "severity": "error", "message": why, "help": None}
    problem |= {"label": "", "file": "app", "from": 0, "to": 0, "line": 1, "fix": False}
    problem |= {"blocks": [], "path": [], "related": []}
    return {**empty, **last, "problems": [problem]}
