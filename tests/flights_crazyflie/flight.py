"""A flight of real processes whose drones are Crazyflies, simulated down to their radio."""

from __future__ import annotations

import json
import os
import signal
from collections.abc import Callable, Mapping
from contextlib import closing, suppress
from dataclasses import dataclass, field
from pathlib import Path
from subprocess import TimeoutExpired
from typing import Any, ClassVar

from pluto_fleet.crtp import process
from pluto_fleet.crtp.flight_log import COMMANDS, TRACE, CommandRecord, PositionRecord
from pluto_fleet.journal.place import gateway_folder
from pluto_fleet.journal.reader import Reader
from pluto_fleet.shared.domain.errors import BadInput
from tests.kill.lives import Lives, eventually
from tests.kill.trial import end_gateway, gateway_of

Event = Mapping[str, Any]


@dataclass(kw_only=True)
class Flight(Lives):
    """Flies Crazyflies, and makes them."""

    flag: ClassVar[str] = "--crtp-sim"
    """By which `fly` is told how many there are."""
    drones: int | None = None
    """How many simulated ones the app shall start; None: the fleet file says where they are."""
    world: Path | None = None
    """The folder of the simulated drones, if it is not the gateway's."""
    notes: list[str] = field(default_factory=list)
    """What was seen besides."""

    @property
    def gateway(self) -> Path:
        return gateway_folder(self.journal)

    @property
    def air(self) -> Path:
        return self.world or self.gateway

    def start(self) -> None:
        """Let a life begin: the first, or one that goes on where the last one was killed."""
        words = ["resume", str(self.journal)]
        if not self.journal.exists():
            simulated = [] if self.drones is None else [self.flag, str(self.drones)]
            words = ["fly", *self.files, *simulated, "--journal", str(self.journal)]
        self.begin(*words)

    def tell(self, *words: str) -> str:
        """Give a command to the app that flies; return what it says."""
        done = self.run("tell", str(self.journal), *words)
        assert done.code == 0, done.err
        return done.out

    def kill_gateway(self) -> None:
        pid = gateway_of(self.journal)
        assert pid is not None
        os.kill(pid, signal.SIGKILL)

    def let(self, drone: str, fault: str, value: float | bool | list[float] = True) -> None:
        process.told(self.air, "fault", drone=drone, name=fault, value=value)

    @property
    def state(self) -> Mapping[str, Mapping[str, Any]]:
        """How the drones really are."""
        found: Mapping[str, Mapping[str, Any]] = json.loads(process.told(self.air, "state"))
        return found

    def airborne(self) -> list[str]:
        with suppress(BadInput):
            return [id for id, one in self.state.items() if one["airborne"]]
        return []

    def until(self, holds: Callable[[], bool], seconds: float = 60.0) -> None:
        if not eventually(holds, seconds):
            raise AssertionError(f"it does not come to that:\n{self.told}")

    def goes_on(self, seconds: float) -> None:
        """Let it go on for a while, or to its end."""
        assert self.life is not None
        with suppress(TimeoutExpired):
            self.life.wait(seconds)

    def until_up(self, drone: str, height: float = 0.3) -> None:
        """Wait until a drone is so high."""
        self.until(lambda: float(self.state[drone]["at"][2]) > height)

    @property
    def events(self) -> list[Event]:
        """What the journal says, each event with the time on the wall when it was written."""
        with closing(Reader(self.journal)) as reader:
            rows = list(reader.instants())
        return [{**event, "wall": row.wall} for row in rows for event in json.loads(row.text)]

    def ends(self) -> dict[str, str]:
        ended = (event for event in self.events if event["event"] == "mission.ended")
        return {event["mission"]: event["status"] for event in ended}

    @property
    def commands(self) -> list[CommandRecord]:
        lines = (self.air / COMMANDS).read_text(encoding="utf-8").splitlines()
        read = (json.loads(line) for line in lines)
        return [CommandRecord(**{**one, "at": tuple(one["at"])}) for one in read]

    @property
    def trace(self) -> list[PositionRecord]:
        """Where the drones were in the air; a last line that is only half there is left out."""
        text = (self.air / TRACE).read_text(encoding="utf-8")
        rows = (line.split(",") for line in text[: text.rfind("\n") + 1].splitlines())
        return [
            PositionRecord(float(time), drone, (float(x), float(y), float(z)))
            for time, drone, x, y, z in rows
        ]

    @property
    def told(self) -> str:
        """All that was said: by the lives, and by the gateway."""
        log = self.gateway / "log"
        gateway = log.read_text(errors="replace") if log.exists() else ""
        return f"{super().told}\n{gateway}"

    def end(self) -> None:
        """Leave nothing behind."""
        super().end()
        end_gateway(self.journal)
        process.end(self.air)
