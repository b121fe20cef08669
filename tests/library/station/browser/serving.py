"""The ground station as a process of its own: started, killed, and asked behind the page's back."""

from __future__ import annotations

import json
import os
import re
import signal
import subprocess
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any
from urllib.error import HTTPError
from urllib.request import Request, urlopen

from tests.kill.judge import done_by_the_world
from tests.kill.lives import eventually
from tests.kill.trial import end_gateway
from tests.library.station.browser.installed import App

PATIENCE = 60.0
"""Seconds until something that does not happen is called a failure."""

SAID = re.compile(r"^station: (http://\S+)", re.MULTILINE)


def until(holds: Callable[[], bool], what: str | Callable[[], str]) -> None:
    """Wait until something holds; what that is may be said by how things are at the end."""
    if not eventually(holds, PATIENCE):
        said = what if isinstance(what, str) else what()
        raise AssertionError(f"it never came about that {said}")


@dataclass(slots=True, kw_only=True)
class Station:
    """An app's `serve`, over all its lives: one folder, one port."""

    app: App
    folder: Path
    options: tuple[str, ...]
    url: str = ""
    """Where the page is, token and all."""
    lives: int = 0
    port: int = 0
    _life: subprocess.Popen[bytes] | None = field(default=None)

    def start(self) -> None:
        """Let a life begin; the next one is found at the port of the first."""
        sim = () if "--crtp-sim" in self.options else ("--sim",)
        words = [str(self.app.program), "serve", *sim, "--fleet", str(self.app.fleet)]
        words += ["--folder", str(self.folder), "--port", str(self.port), *self.options]
        kept = {name: value for name, value in os.environ.items() if not name.startswith("PYTHON")}
        self.lives += 1
        with self.printed.open("wb") as out:
            self._life = subprocess.Popen(
                words,
                env={**kept, "PYTHONUNBUFFERED": "1", "XDG_STATE_HOME": str(self.folder)},
                stdin=subprocess.DEVNULL,
                stdout=out,
                stderr=subprocess.STDOUT,
            )
        life = self._life
        until(
            lambda: SAID.search(self.said()) is not None or life.poll() is not None,
            "the station is there",
        )
        found = SAID.search(self.said())
        assert found, f"exit {life.poll()}:\n{self.said()}"
        self.url = found[1]
        self.port = int(self.url.split(":")[2].split("/")[0])

    @property
    def pid(self) -> int:
        """The process that serves."""
        assert self._life is not None
        return self._life.pid

    @property
    def printed(self) -> Path:
        """What the latest life has printed."""
        return self.folder.with_name(f"{self.folder.name}-{self.lives}.txt")

    def said(self) -> str:
        """Return what the latest life has printed so far."""
        return self.printed.read_text(errors="replace")

    def kill(self) -> None:
        """Kill the life as nothing can be kept from."""
        assert self._life is not None
        self._life.kill()
        self._life.wait()

    def stop(self) -> None:
        """Tell the life to end, as a system does that shuts down."""
        assert self._life is not None
        self._life.terminate()
        self._life.wait(PATIENCE)

    def end(self) -> None:
        """Leave no process behind: neither server, nor what it supervises, nor a gateway."""
        if self._life is not None and self._life.poll() is None:
            self._life.send_signal(signal.SIGINT)
            try:
                self._life.wait(PATIENCE)
            except subprocess.TimeoutExpired:
                self.kill()
        for journal in self.journals():
            end_gateway(journal)

    def journals(self) -> list[Path]:
        """Return the journals of its flights, the first one first."""
        return sorted(self.folder.glob("**/*.journal"))

    def done(self) -> Counter[tuple[str, str]]:
        """Count what the simulated world has seen done that must not be done twice."""
        counts: Counter[tuple[str, str]] = Counter()
        for journal in self.journals():
            counts += done_by_the_world(journal)
        return counts

    def audit(self) -> list[dict[str, Any]]:
        """Return the commands that were heard, a refused one too."""
        file = self.folder / "station" / "audit.log"
        lines = file.read_text().splitlines() if file.exists() else []
        return [json.loads(line) for line in lines]

    def get(self, path: str) -> Any:
        """Ask the server behind the page's back."""
        return self._ask(Request(self._at(path), headers=self._headers))[1]

    def post(self, path: str, given: dict[str, object]) -> tuple[int, Any]:
        """Command the server behind the page's back; return its status and its answer."""
        headers = {**self._headers, "Content-Type": "application/json"}
        data = json.dumps(given).encode()
        return self._ask(Request(self._at(path), data=data, headers=headers, method="POST"))

    def put(self, path: str, given: dict[str, object]) -> tuple[int, Any]:
        """Put something there behind the page's back."""
        headers = {**self._headers, "Content-Type": "application/json"}
        data = json.dumps(given).encode()
        return self._ask(Request(self._at(path), data=data, headers=headers, method="PUT"))

    @property
    def url_to_watch(self) -> str:
        """Where the page is for those who command nothing, token and all."""
        token = (self.folder / "station" / "watch_token").read_text(encoding="ascii")
        return f"{self.url.partition('#')[0]}#token={token}"

    def now(self) -> dict[str, Any]:
        """Return the newest that all pages are shown, whole."""
        live: dict[str, Any] = self.get("/api/live?flight=&seen=0&log=0&results=0")
        return live

    @property
    def phase(self) -> str:
        """What goes on, in the station's word."""
        return str(self.now()["state"]["phase"])

    def statuses(self) -> dict[str, str]:
        """Return how the missions stand that fly or have flown."""
        return {row["name"]: row["status"] for row in self.now()["missions"]}

    def _at(self, path: str) -> str:
        return f"http://127.0.0.1:{self.port}{path}"

    @property
    def _headers(self) -> dict[str, str]:
        headers = {"X-Pluto": "1"}
        _, _, token = self.url.partition("#token=")
        return {**headers, "Authorization": f"Bearer {token}"} if token else headers

    def _ask(self, request: Request) -> tuple[int, Any]:
        try:
            with urlopen(request, timeout=PATIENCE) as answer:
                return answer.status, json.loads(answer.read())
        except HTTPError as refused:
            with refused:
                return refused.code, json.loads(refused.read())
