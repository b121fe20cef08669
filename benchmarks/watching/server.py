"""The process that serves, what it is asked, and what it costs."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any
from urllib.request import Request, urlopen

TICKS = os.sysconf("SC_CLK_TCK")


@dataclass(slots=True, kw_only=True)
class Server:
    """A station that serves."""

    process: subprocess.Popen[str]
    url: str
    """Ends without a slash."""
    folder: Path
    started_in: float
    """Seconds from its start to the line that says where the page is."""

    def ask(self, path: str, given: object = None, method: str = "GET") -> Any:
        """Ask, or command."""
        headers = {"X-Pluto": "1", "Content-Type": "application/json"}
        data = None if given is None else json.dumps(given).encode()
        request = Request(self.url + path, data=data, headers=headers, method=method)
        with urlopen(request, timeout=60) as answer:
            return json.loads(answer.read())

    @property
    def used(self) -> float:
        """Seconds of CPU that the server has used."""
        return seconds_of(self.process.pid)

    @property
    def memory(self) -> float:
        """Megabytes that it holds."""
        return memory_of(self.process.pid)

    @property
    def kept(self) -> float:
        """Megabytes of the journals of its flights."""
        return sum(file.stat().st_size for file in self.folder.glob("*.journal*")) / 1e6

    def gateway(self) -> int | None:
        """Return the process that the drones are behind."""
        for lock in self.folder.glob("**/*.gateway/lock"):
            return int(lock.read_text())
        return None

    def end(self) -> None:
        """Land all, and leave no process behind."""
        gateway = self.gateway()
        if self.process.stdout is not None:
            self.process.stdout.close()
        self.process.terminate()
        try:
            self.process.wait(60)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()
        if gateway is not None and b"gateway" in _command_of(gateway):
            os.kill(gateway, 9)


def serve(sources: Sequence[Path], fleet: Path, folder: Path, app: str = "watched") -> Server:
    """Start the station of the app in a folder of its own; app and library are imported from `sources`."""
    folder.mkdir(parents=True, exist_ok=True)
    words = [sys.executable, "-m", app, "serve", "--sim", "--fleet", str(fleet)]
    words += ["--port", "0", "--folder", str(folder)]
    begun = time.perf_counter()
    process = subprocess.Popen(
        words,
        env={
            **os.environ,
            "PYTHONPATH": os.pathsep.join(map(str, sources)),
            "PYTHONUNBUFFERED": "1",
        },
        stdout=subprocess.PIPE,
        text=True,
    )
    assert process.stdout is not None
    for line in process.stdout:
        if line.startswith("station: "):
            url = line.removeprefix("station: ").strip().rstrip("/")
            took = time.perf_counter() - begun
            return Server(process=process, url=url, folder=folder, started_in=took)
    raise SystemExit(f"the station has ended with {process.wait()}")


def seconds_of(process: int, thread: int | None = None) -> float:
    """Return the seconds of CPU that a process has used, or one thread of it."""
    of = f"/proc/{process}/stat" if thread is None else f"/proc/{process}/task/{thread}/stat"
    fields = Path(of).read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / TICKS


def memory_of(process: int) -> float:
    """Return the megabytes that a process holds."""
    text = Path(f"/proc/{process}/status").read_text()
    found = re.search(r"VmRSS:\s+(\d+) kB", text)
    return int(found[1]) / 1000 if found else 0.0


def _command_of(process: int) -> bytes:
    try:
        return Path(f"/proc/{process}/cmdline").read_bytes()
    except OSError:
        return b""
