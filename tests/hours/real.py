"""Hours in real time: an app that flies by a clock that `faketime` sets, moves, or lets sleep."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
import time
from collections.abc import Mapping, Sequence
from datetime import datetime
from pathlib import Path
from tempfile import mkdtemp
from typing import NamedTuple
from zoneinfo import ZoneInfo

from tests.kit import apps

APP = """pluto 1
app by_the_clock {
  create = MissionCreator
  wait = Clock
  allocate = DroneAllocator
  launch = TripLauncher
  watch = TripMonitor
  again = MissionRepeater
  start -> create -> wait -> allocate -> launch -> watch
  watch -> wait when STANDBY
  watch -> end when FAILED
  watch -> again when COMPLETED
  again -> wait when STANDBY
  again -> end when COMPLETED
}
"""
LIBRARIES = ("/usr/lib/x86_64-linux-gnu/faketime", "/usr/lib/aarch64-linux-gnu/faketime")
LATE = 3.0
"""Seconds after its hour by which a mission must have set out, on a machine that is busy."""


class RealCase(NamedTuple):
    """One flight: when it is started by the clocks of a zone, what is promised, and when that happens, in UTC."""

    zone: str
    start: str
    mission: str
    expected: Mapping[str, str]
    moves: float = 0.0
    """By how many seconds the clock is moved five seconds after the start."""
    kill: bool = False
    """Whether it is killed then, and resumed."""


ROME = "Europe/Rome"
SPRING = "2027-03-28 01:59:40"
AUTUMN = "2027-10-31 02:29:40"
BOTH = 'at = "12:30"\ndeadline = "12:20"'
SOON = 'at = "03:00:15"\ndeadline = "03:00:10"'
DUE = 'deadline = "03:45:05"\nat = "03:45:30"'
FROM = 'window = ["{}", "13:00"]'.format
LORD_HOWE = "Australia/Lord_Howe"
CHATHAM = "Pacific/Chatham"
CASES = (
    RealCase(ROME, SPRING, 'at = "03:00:05"', {"launched": "01:00:05"}),
    RealCase(ROME, SPRING, 'at = "02:30"', {"launched": "01:00:00"}),
    RealCase(ROME, AUTUMN, 'at = "02:30"', {"launched": "00:30:00"}),
    RealCase(ROME, SPRING, FROM("03:00:05"), {"launched": "01:00:05"}),
    RealCase(CHATHAM, "2027-09-26 02:44:40", DUE, {"late": "14:00:05", "launched": "14:00:30"}),
    RealCase(LORD_HOWE, "2027-10-03 01:59:40", 'at = "02:30:05"', {"launched": "15:30:05"}),
    # the clock is set forward, or the computer sleeps: before its hour, and over it; it is set back; a kill
    RealCase(
        "Asia/Kathmandu", "2027-05-01 08:00", 'at = "08:10:25"', {"launched": "02:25:25"}, 600.0
    ),
    RealCase(ROME, "2027-03-13 12:00", BOTH, {"late": "11:40:05", "launched": "11:40:05"}, 2_400.0),
    RealCase(
        "America/St_Johns", "2027-03-13 12:00", FROM("12:00:10"), {"launched": "15:30:10"}, -12.0
    ),
    RealCase(ROME, SPRING, SOON, {"late": "01:00:10", "launched": "01:00:15"}, kill=True),
)


def library() -> Path | None:
    """Return what `faketime` puts in the place of a process's clock; None: it is not installed."""
    paths = [Path(one, "libfaketime.so.1") for one in LIBRARIES]
    return next(filter(Path.exists, paths), None)


def flown(number: int) -> list[str]:
    """Fly a case; return in what it differs from what is expected."""
    case = CASES[number]
    folder = Path(mkdtemp(prefix="hours-"))
    try:
        return _flown(case, folder)
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def _flown(case: RealCase, folder: Path) -> list[str]:
    source = folder / "app.pluto"
    source.write_text(APP, "utf-8")
    package = apps.compiled_file(source, folder / "package")
    trip = '[[mission.trip]]\naction = "take_photo"\ntarget = [3.0, 1.5]\n'
    plan = folder / "m.toml"
    clock = folder / "clock"
    plan.write_text(f'[[mission]]\nname = "m"\n{case.mission}\n{trip}', "utf-8")
    start = datetime.fromisoformat(case.start).replace(tzinfo=ZoneInfo(case.zone))
    ahead = start.timestamp() - time.time()
    clock.write_text(f"{ahead:+.3f}", "utf-8")
    environment = {
        **os.environ,
        "TZ": case.zone,
        "LD_PRELOAD": str(library()),
        "FAKETIME_TIMESTAMP_FILE": str(clock),
        "FAKETIME_NO_CACHE": "1",
        "FAKETIME_DONT_FAKE_MONOTONIC": "1",
        "PYTHONPATH": os.pathsep.join([str(package / "src"), *map(str, sys.path)]),
        "XDG_STATE_HOME": str(folder / "state"),
    }
    journal = str(folder / "flight.journal")

    def begin(*words: str) -> subprocess.Popen[str]:
        return subprocess.Popen(
            [sys.executable, "-m", "by_the_clock", *words],
            env=environment,
            text=True,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
        )

    flight = begin("fly", str(plan), "--sim", "--journal", journal)
    try:
        time.sleep(5.0)
        if case.kill:
            flight.kill()
            flight.communicate()
            flight = begin("resume", journal)
        elif case.moves:
            clock.write_text(f"{ahead + case.moves:+.3f}", "utf-8")
        said, _ = flight.communicate(timeout=120.0)
    finally:
        flight.kill()
    told = begin("journal", journal, "--json").communicate()[0].splitlines()
    return _differs(case, [json.loads(line) for line in told if line.startswith("{")], said)


def _differs(case: RealCase, events: Sequence[Mapping[str, object]], said: str) -> list[str]:
    seen: dict[str, float] = {}
    for event in events:
        seen.setdefault(str(event["event"]).partition(".")[2], float(str(event["wall"])))
    wrong = []
    for kind, hour in case.expected.items():
        day = datetime.fromisoformat(case.start).replace(tzinfo=ZoneInfo(case.zone))
        due = datetime.fromisoformat(f"{day.astimezone(ZoneInfo('UTC')):%Y-%m-%d} {hour}+00:00")
        late = seen.get(kind, float("inf")) - due.timestamp()
        if not -0.1 <= late <= LATE:
            wrong.append(f"{kind} comes {late:.1f} s after {hour} UTC")
    return [*wrong, said] if wrong else []
