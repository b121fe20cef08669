"""A flight of real processes whose drones are Crazyflies, simulated down to their radio."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
from collections.abc import Callable, Mapping
from contextlib import closing, suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from pluto_fleet.crtp import process
from pluto_fleet.crtp.flight_log import CommandRecord, PositionRecord, commands_in, trace_in
from pluto_fleet.journal.place import gateway_folder
from pluto_fleet.journal.reader import Reader
from plutoc_runtime.domain.errors import BadInput
from tests.kill.lives import eventually
from tests.kill.trial import end_gateway, gateway_of

Event = Mapping[str, Any]

PATIENCE = 150.0
"""Seconds until a life that does not end is called a failure."""


@dataclass(slots=True, kw_only=True)
class Flight:
    """A journal, the lives of the app that write it, and the drones that it flies."""

    app: str
    source: Path
    """The folder that the app's package is imported from."""
    folder: Path
    """Where its two files are."""
    drones: int | None = None
    """How many simulated ones the app shall start; None: the fleet file says where they are."""
    world: Path | None = None
    """The folder of the simulated drones, if it is not the gateway's."""
    lives: list[str] = field(default_factory=list)
    """What each life has printed."""
    notes: list[str] = field(default_factory=list)
    """What was seen besides."""
    _life: subprocess.Popen[bytes] | None = None

    @property
    def journal(self) -> Path:
        """Where it is written down."""
        return self.folder / "flight.journal"

    @property
    def gateway(self) -> Path:
        """The folder of the gateway."""
        return gateway_folder(self.journal)

    @property
    def air(self) -> Path:
        """The folder of the simulated drones."""
        return self.world or self.gateway

    def start(self) -> None:
        """Let a life begin: the first, or one that goes on where the last one was killed."""
        words = ["resume", str(self.journal)]
        if not self.journal.exists():
            files = [self.folder / "missions.toml", "--fleet", self.folder / "fleet.toml"]
            simulated = [] if self.drones is None else ["--crtp-sim", str(self.drones)]
            words = ["fly", *map(str, files), *simulated, "--journal", str(self.journal)]
        with self._printed.open("wb") as out:
            self._life = subprocess.Popen(
                self._command(*words), env=self._environment, stdout=out, stderr=subprocess.STDOUT
            )

    def tell(self, *words: str) -> str:
        """Give a command to the app that flies; return what it says."""
        done = subprocess.run(
            self._command("tell", str(self.journal), *words),
            env=self._environment,
            text=True,
            capture_output=True,
            check=True,
            timeout=PATIENCE,
        )
        return done.stdout

    def wait(self, seconds: float = PATIENCE) -> int:
        """Return the exit code of a life that ends by itself."""
        assert self._life is not None
        try:
            code = self._life.wait(seconds)
        except subprocess.TimeoutExpired:
            self.kill()
            raise AssertionError(f"it does not end:\n{self.told}") from None
        self._over()
        return code

    def kill(self) -> None:
        """Kill the life as nothing can be kept from."""
        assert self._life is not None
        self._life.send_signal(signal.SIGKILL)
        self._life.wait()
        self._over()

    def kill_gateway(self) -> None:
        """Kill the gateway that commands the drones."""
        pid = gateway_of(self.journal)
        assert pid is not None
        os.kill(pid, signal.SIGKILL)

    def let(self, drone: str, fault: str, value: float | bool | list[float] = True) -> None:
        """Let something go wrong with a drone."""
        process.told(self.air, "fault", drone=drone, name=fault, value=value)

    @property
    def state(self) -> Mapping[str, Mapping[str, Any]]:
        """How the drones really are."""
        found: Mapping[str, Mapping[str, Any]] = json.loads(process.told(self.air, "state"))
        return found

    def airborne(self) -> list[str]:
        """Return the drones that are in the air."""
        with suppress(BadInput):
            return [id for id, one in self.state.items() if one["airborne"]]
        return []

    def until(self, holds: Callable[[], bool], seconds: float = 60.0) -> None:
        """Wait until something holds."""
        if not eventually(holds, seconds):
            raise AssertionError(f"it does not come to that:\n{self.told}")

    def until_up(self, drone: str, height: float = 0.3) -> None:
        """Wait until a drone is so high."""
        self.until(lambda: float(self.state[drone]["at"][2]) > height)

    @property
    def events(self) -> list[Event]:
        """What the journal says, each event with the time on the wall when it was written."""
        with closing(Reader(self.journal)) as reader:
            rows = list(reader.rows())
        return [{**event, "wall": row.wall} for row in rows for event in json.loads(row.text)]

    def ends(self) -> dict[str, str]:
        """Return how each mission has ended."""
        ended = (event for event in self.events if event["event"] == "mission.ended")
        return {event["mission"]: event["status"] for event in ended}

    @property
    def commands(self) -> list[CommandRecord]:
        """What the drones were commanded."""
        return list(commands_in(self.air))

    @property
    def trace(self) -> list[PositionRecord]:
        """Where the drones were in the air."""
        return list(trace_in(self.air))

    @property
    def told(self) -> str:
        """All that was said: by the life, and by the gateway."""
        texts = [*self.lives]
        for file in (self._printed, self.gateway / "log"):
            with suppress(OSError):
                texts.append(file.read_text(errors="replace"))
        return "\n".join(texts)

    def end(self) -> None:
        """Leave nothing behind."""
        if self._life is not None:
            self.kill()
        end_gateway(self.journal)
        process.end(self.air)

    def _command(self, *words: str) -> list[str]:
        return [sys.executable, "-m", self.app, *words]

    @property
    def _environment(self) -> dict[str, str]:
        return {
            **os.environ,
            "PYTHONPATH": str(self.source),
            "XDG_STATE_HOME": str(self.folder / "state"),
        }

    @property
    def _printed(self) -> Path:
        return self.folder / f"life{len(self.lives)}.txt"

    def _over(self) -> None:
        self.lives.append(self._printed.read_text(errors="replace"))
        self._life = None
