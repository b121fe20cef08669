"""`plutoc edit` for a browser: in a thread of this process, or as a process of its own that can be killed."""

from __future__ import annotations

import asyncio
import os
import re
import shutil
import signal
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from pathlib import Path
from threading import Event, Thread

from plutoc.editor.guard import Guard
from plutoc.editor.run import listening
from plutoc.editor.server import serve
from plutoc.editor.session import Session
from tests.kit.station import PATIENCE, until
from tests.paths import EXAMPLES

SAID = re.compile(r"^.*: edit it at (http://\S+)$", re.MULTILINE)
NAME = "drugs.pluto"


def fresh(example: str, folder: Path) -> Path:
    """Return the file of a copy of an example, or of an app that is not there yet."""
    if example:
        shutil.copytree(EXAMPLES / example, folder)
    else:
        folder.mkdir()
    return folder / ("app.pluto" if example else NAME)


@dataclass(kw_only=True)
class Edited:
    """A file that is edited, as it is on the disk."""

    file: Path
    url: str = ""

    @property
    def text(self) -> str:
        """The app on the disk."""
        return self.file.read_text(encoding="utf-8") if self.file.exists() else ""

    @property
    def hooks(self) -> str:
        """hooks.py on the disk."""
        path = self.file.with_name("hooks.py")
        return path.read_text(encoding="utf-8") if path.exists() else ""


@dataclass(kw_only=True)
class Editor(Edited):
    """The editor of a file, in a thread."""

    _thread: Thread | None = None
    _loop: asyncio.AbstractEventLoop | None = None
    _serving: asyncio.Future[None] | None = None

    def start(self) -> None:
        """Serve it until `end`."""
        ready = Event()
        self._thread = Thread(target=lambda: asyncio.run(self._serve(ready)))
        self._thread.start()
        assert ready.wait(PATIENCE)

    async def _serve(self, ready: Event) -> None:
        listener = listening("127.0.0.1", 0)
        guard = Guard(host="127.0.0.1", port=listener.getsockname()[1])
        self.url = guard.address
        self._loop = asyncio.get_running_loop()
        self._serving = asyncio.ensure_future(serve(Session(self.file), guard, listener, ready.set))
        with suppress(asyncio.CancelledError):
            await self._serving

    @contextmanager
    def answering_late(self) -> Iterator[None]:
        """Let it answer nothing for a while, as on a busy machine."""
        assert self._loop is not None
        goes_on = Event()
        self._loop.call_soon_threadsafe(goes_on.wait)
        try:
            yield
        finally:
            goes_on.set()

    def end(self) -> None:
        """End it; all is saved."""
        if self._thread is not None and self._loop is not None and self._serving is not None:
            self._loop.call_soon_threadsafe(self._serving.cancel)
            self._thread.join()
            self._thread = None


@dataclass(kw_only=True)
class EditorProcess(Edited):
    """The editor of a file, as a person starts it."""

    _life: subprocess.Popen[bytes] | None = field(default=None)

    @property
    def printed(self) -> Path:
        """What it has printed; not beside the app, where Git would see it."""
        folder = self.file.parent
        return folder.with_name(f"{folder.name}.printed")

    def start(self, port: int = 0) -> None:
        """Start it, and wait until it says where it is."""
        words = [sys.executable, "-m", "plutoc", "edit", str(self.file), "--no-open"]
        with self.printed.open("wb") as out:
            self._life = subprocess.Popen(
                [*words, "--port", str(port)],
                stdin=subprocess.DEVNULL,
                stdout=out,
                stderr=subprocess.STDOUT,
                env={**os.environ, "PYTHONUNBUFFERED": "1"},
            )
        until(lambda: SAID.search(self.said) is not None, lambda: f"it serves: {self.said}")
        found = SAID.search(self.said)
        assert found is not None
        self.url = found[1]

    @property
    def said(self) -> str:
        """What it has said so far."""
        return self.printed.read_text(encoding="utf-8")

    def kill(self) -> None:
        """End it as a power cut does."""
        if self._life is not None:
            self._life.send_signal(signal.SIGKILL)
            self._life.wait()
            self._life = None

    def end(self) -> None:
        """Leave no process behind."""
        self.kill()
