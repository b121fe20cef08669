"""The ground station as a process of its own: started, killed, and asked behind the page's back.

`Stations` keeps some running: a test takes one as if nothing had ever been drawn or flown there.
"""

from __future__ import annotations

import json
import os
import re
import shutil
import signal
import subprocess
import sys
from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace
from itertools import count
from pathlib import Path
from typing import Any
from urllib.error import HTTPError
from urllib.parse import urlencode
from urllib.request import Request, urlopen

import pytest

from tests.kill.judge import done_by_the_world
from tests.kill.lives import eventually
from tests.kill.trial import end_gateway
from tests.kit.apps import compiled_file, fly_straight
from tests.paths import EXAMPLES

PATIENCE = 60.0
"""Seconds until something that does not happen is called a failure."""

SAID = re.compile(r"^station: (http://\S+)", re.MULTILINE)

NUMBERS = count()
"""Each command has a name of its own."""


def until(holds: Callable[[], bool], what: str | Callable[[], str]) -> None:
    """Wait until something holds; what that is may be said by how things are at the end."""
    if not eventually(holds, PATIENCE):
        said = what if isinstance(what, str) else what()
        raise AssertionError(f"it never came about that {said}")


@dataclass(frozen=True, slots=True, kw_only=True)
class App:
    """A program that flies an app, and the two files that its example has."""

    name: str
    program: Path
    fleet: Path
    missions: Path


def compiled_app(name: str, folder: Path) -> App:
    """Compile an example there, and make a program of it that imports it from there."""
    files = folder / name
    shutil.copytree(EXAMPLES / name, files)
    fly_straight(files / "fleet.toml")
    package = compiled_file(files / "app.pluto", folder / f"{name}.package")
    program = folder / f"{name}.sh"
    path = f"PYTHONPATH='{package / 'src'}'"
    program.write_text(f"#!/bin/sh\n{path} exec '{sys.executable}' -m {name} \"$@\"\n")
    program.chmod(0o755)
    return App(
        name=name, program=program, fleet=files / "fleet.toml", missions=files / "missions.toml"
    )


class Asked:
    """A station as tests ask it behind its page's back, however it is reached."""

    folder: Path

    def _ask(self, method: str, path: str, given: object = None) -> tuple[int, Any]:
        raise NotImplementedError

    def get(self, path: str, **query: str) -> Any:
        """Return what there is to read at an address."""
        return self._ask("GET", f"{path}?{urlencode(query)}" if query else path)[1]

    def post(self, path: str, given: dict[str, object]) -> tuple[int, Any]:
        """Command something; return the status and the answer."""
        return self._ask("POST", path, given)

    def put(self, path: str, given: dict[str, object]) -> tuple[int, Any]:
        """Put something there; return the status and the answer."""
        return self._ask("PUT", path, given)

    def tell(self, what: str, **given: object) -> str:
        """Command something under a name of its own; return what is said."""
        status, answer = self.post(f"/api/{what}", {"id": f"test-{next(NUMBERS)}", **given})
        assert status == 200, answer
        return str(answer["said"])

    def refused(self, what: str, **given: object) -> str:
        """Command what cannot be done now; return why."""
        status, answer = self.post(f"/api/{what}", {"id": f"test-{next(NUMBERS)}", **given})
        assert status == 409, answer
        return str(answer["said"])

    def plan(self, missions: list[dict[str, Any]]) -> list[Any]:
        """Give it a plan; return the problems of that."""
        revision = self.get("/api/plan")["revision"]
        status, answer = self.put("/api/plan", {"revision": revision, "missions": missions})
        assert status == 200, answer
        problems: list[Any] = answer["problems"]
        return problems

    @property
    def missions(self) -> list[dict[str, Any]]:
        """The missions of its plan."""
        missions: list[dict[str, Any]] = self.get("/api/plan")["missions"]
        return missions

    def now(self) -> dict[str, Any]:
        """Return the newest that all pages are shown, whole: at once, as to one who has seen another flight."""
        live: dict[str, Any] = self.get("/api/live", flight="none", seen="0", log="0", results="0")
        return live

    @property
    def phase(self) -> str:
        """What goes on, in the station's word."""
        return str(self.now()["state"]["phase"])

    def statuses(self) -> dict[str, str]:
        """Return how the missions stand that fly or have flown."""
        return {row["name"]: row["status"] for row in self.now()["missions"]}

    def mission(self, name: str) -> dict[str, Any]:
        """Return what is shown of a mission."""
        return next(row for row in self.now()["missions"] if row["name"] == name)

    def drone(self, id: str) -> dict[str, Any]:
        """Return what is shown of a drone."""
        return next(row for row in self.now()["drones"] if row["id"] == id)

    def in_the_air(self, above: float = 0.5) -> list[str]:
        """Return the drones that are seen to be so many metres up."""
        return [row["id"] for row in self.now()["drones"] if (row["z"] or 0.0) > above]

    def audit(self) -> list[dict[str, Any]]:
        """Return the commands that were heard, a refused one too."""
        file = self.folder / "station" / "audit.log"
        lines = file.read_text("utf-8").splitlines() if file.exists() else []
        return [json.loads(line) for line in lines]


@dataclass(kw_only=True)
class Station(Asked):
    """An app's `serve`, over all its lives: one folder, one port."""

    app: App
    folder: Path
    options: tuple[str, ...]
    url: str = ""
    """Where the page is, token and all."""
    lives: int = 0
    port: int = 0
    first_plan: list[dict[str, Any]] = field(default_factory=list)
    """What it was started with."""
    before: frozenset[Path] = frozenset()
    """The journals of those who had it before."""
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

    def reset(self) -> bool:
        """Put away what flies, and the plan; False: that is not enough to be as at the beginning."""
        if self._life is None or self._life.poll() is not None:
            return False
        if self.phase in ("flying", "stopping"):
            self.tell("stop", how="land")
            until(lambda: self.phase in ("stopped", "over"), "all have landed")
        if self.phase in ("stopped", "interrupted"):
            self.tell("discard")
        now = self.now()
        unhurt = all(one["status"] != "LOST" and not one["retired"] for one in now["drones"])
        if now["state"]["phase"] != "idle" or now["state"]["map"] or not unhurt:
            return False
        self.plan(self.first_plan)
        self.before = frozenset(self.folder.glob("**/*.journal"))
        return True

    def journals(self) -> list[Path]:
        """Return the journals of its flights, the first one first."""
        return sorted({*self.folder.glob("**/*.journal")} - self.before)

    def done(self) -> Counter[tuple[str, str]]:
        """Count what the simulated world has seen done that must not be done twice."""
        counts: Counter[tuple[str, str]] = Counter()
        for journal in self.journals():
            counts += done_by_the_world(journal)
        return counts

    @property
    def url_to_watch(self) -> str:
        """Where the page is for those who command nothing, token and all."""
        token = (self.folder / "station" / "watch_token").read_text(encoding="ascii")
        return f"{self.url.partition('#')[0]}#token={token}"

    def _ask(self, method: str, path: str, given: object = None) -> tuple[int, Any]:
        headers = {"X-Pluto": "1", "Content-Type": "application/json"}
        _, _, token = self.url.partition("#token=")
        if token:
            headers["Authorization"] = f"Bearer {token}"
        data = None if given is None else json.dumps(given).encode()
        url = f"http://127.0.0.1:{self.port}{path}"
        try:
            asked = Request(url, data=data, headers=headers, method=method)
            with urlopen(asked, timeout=PATIENCE) as answer:
                return answer.status, json.loads(answer.read())
        except HTTPError as refused:
            with refused:
                return refused.code, json.loads(refused.read())


class Stations:
    """Stations that tests use one after another: each app with its options is served once."""

    MOST = 2
    """As many are kept running."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._apps: dict[str, App] = {}
        self._kept: dict[tuple[str, ...], Station] = {}
        self._numbers = count()

    def app(self, name: str) -> App:
        """Return an example, compiled once."""
        if name not in self._apps:
            self._apps[name] = compiled_app(name, self._folder)
        return self._apps[name]

    def fresh(self, name: str, *options: str) -> Station:
        """Return a station that nobody else has, with files of its own, before its first life."""
        folder = self._folder / f"station{next(self._numbers)}"
        app = self.app(name)
        shutil.copytree(app.fleet.parent, folder / "files")
        (folder / "kept").mkdir()
        files = folder / "files"
        app = replace(app, fleet=files / "fleet.toml", missions=files / "missions.toml")
        return Station(app=app, folder=folder / "kept", options=options)

    def shared(self, name: str, *options: str) -> Station:
        """Return a running station that others have had before, as if it were new."""
        station = self._kept.pop((name, *options), None)
        if station is not None and not station.reset():
            station.end()
            station = None
        if station is None:
            station = self.fresh(name, *options)
            station.start()
            station.first_plan = station.missions
        self._kept[name, *options] = station
        while len(self._kept) > self.MOST:
            self._kept.pop(next(iter(self._kept))).end()
        return station

    def end(self) -> None:
        """Leave none running."""
        for station in self._kept.values():
            station.end()
        self._kept.clear()


@pytest.fixture(scope="session")
def stations(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Stations]:
    """The stations of this worker; none of their processes is left behind."""
    stations = Stations(tmp_path_factory.mktemp("stations"))
    yield stations
    stations.end()
