"""`plutoc edit` as a process of its own: started, killed, and its files looked at behind its back."""

from __future__ import annotations

import os
import re
import signal
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path

from tests.library.station.browser.serving import PATIENCE, until

SAID = re.compile(r"^.*: edit it at (http://\S+)$", re.MULTILINE)
NAME = "drugs.pluto"


@dataclass(slots=True, kw_only=True)
class Editor:
    """The editor of one file."""

    file: Path
    url: str = ""
    _life: subprocess.Popen[bytes] | None = field(default=None)

    @property
    def printed(self) -> Path:
        """What it has printed; not beside the app, where Git would see it."""
        folder = self.file.parent
        return folder.with_name(f"{folder.name}.printed")

    def start(self, port: int = 0) -> None:
        """Start it, and wait until it says where it is."""
        words = [sys.executable, "-m", "plutoc", "edit", str(self.file), "--no-open"]
        words += ["--port", str(port)]
        with self.printed.open("wb") as out:
            self._life = subprocess.Popen(
                words,
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

    @property
    def text(self) -> str:
        """The app on the disk."""
        return self.file.read_text(encoding="utf-8") if self.file.exists() else ""

    @property
    def hooks(self) -> str:
        """hooks.py on the disk."""
        path = self.file.with_name("hooks.py")
        return path.read_text(encoding="utf-8") if path.exists() else ""

    @contextmanager
    def answering_late(self) -> Iterator[None]:
        """Let it answer nothing for a while, as on a busy machine."""
        assert self._life is not None
        self._life.send_signal(signal.SIGSTOP)
        try:
            yield
        finally:
            self._life.send_signal(signal.SIGCONT)

    def kill(self) -> None:
        """End it as a power cut does."""
        if self._life is not None:
            self._life.send_signal(signal.SIGKILL)
            self._life.wait()
            self._life = None

    def end(self) -> None:
        """End it as Ctrl-C does."""
        if self._life is None:
            return
        self._life.send_signal(signal.SIGINT)
        try:
            self._life.wait(PATIENCE)
        finally:
            self.kill()
