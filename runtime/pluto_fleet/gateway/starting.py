"""Finding or starting the gateway of a folder: a process that outlives the one that starts it."""

from __future__ import annotations

import asyncio
import json
import os
import signal
import subprocess
from collections.abc import Callable, Sequence
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING

from ..jobs.reports import Down
from ..process import locks, respawn
from ..process.ipc import ask
from ..process.ipc import connect as open_connection
from ..process.whole_file import write_whole
from ..shared.domain.errors import BadInput
from .process import ANOTHER_RUNS, LOCK, LOG, NO_ROOM, NOTE, SETTINGS
from .remote import GATEWAY_TIMEOUT, RemoteLink
from .settings import Settings, data_of
from .wire import MAX_REPORT

if TYPE_CHECKING:
    from ..shared.time.kernel import Kernel

_WITHIN, _EACH = 10.0, 0.01
"""Seconds that a gateway may take to start, and between two polls."""
_LOADING = 50.0
"""Further seconds to load the drones' navigations: an import may take 20, and is tried first."""
_LONG = 1_000_000
"""Bytes of a log after which a new one is begun."""

_STARTED: list[subprocess.Popen[bytes]] = []
"""The gateways that this process has started; ended ones are reaped when the next starts."""


async def connect(
    folder: Path,
    settings: Settings,
    kernel: Kernel,
    epoch: int,
    lost: Callable[[], object] | None = None,
    command: Sequence[str] | None = None,
) -> RemoteLink:
    """Connect to the gateway of a folder, which is started unless it runs.

    `command` starts it, with its folder appended; default: the library's own program.
    """
    loop = asyncio.get_running_loop()
    until = loop.time() + _WITHIN + (0.0 if settings.real is None else _LOADING)
    process: subprocess.Popen[bytes] | None = None
    while True:
        try:
            link = await _linked(folder, settings, kernel, epoch, lost)
        except TimeoutError:
            _send(folder, signal.SIGKILL)  # it hangs and flies nothing any more: another one can
        except OSError:
            pass  # there is no gateway yet
        else:
            if speed_in(folder) != settings.speed:
                write_whole(folder / SETTINGS, json.dumps(data_of(settings)))
            return link
        if process is None or process.poll() is not None:
            if process is not None and _broke(process.returncode):
                raise BadInput(_ended(folder, process.returncode))
            try:
                process = start(folder, settings, command)
            except OSError as error:
                raise BadInput(f"{folder}: the gateway cannot be started: {error}") from error
        if loop.time() > until:
            process.kill()  # else it would block the next one, and fly nothing
            raise BadInput(f"the gateway does not answer; what it said is in {folder / LOG}")
        await asyncio.sleep(_EACH)


def _broke(code: int) -> bool:
    """Whether a gateway failed to start; not if it was killed, or if another one runs."""
    return code >= 0 and code != ANOTHER_RUNS


async def _linked(
    folder: Path,
    settings: Settings,
    kernel: Kernel,
    epoch: int,
    lost: Callable[[], object] | None,
) -> RemoteLink:
    """Connect to the running gateway; raise `OSError` if there is none, `TimeoutError` if it does not answer."""
    reader, writer = await open_connection(folder / NOTE, MAX_REPORT)
    link = RemoteLink(kernel, reader, writer, lost)
    try:
        async with asyncio.timeout(GATEWAY_TIMEOUT):
            await link.link(epoch, settings.patience, settings.speed)
    except BaseException:
        writer.close()
        raise
    return link


def start(
    folder: Path, settings: Settings, command: Sequence[str] | None = None
) -> subprocess.Popen[bytes]:
    """Start a gateway that outlives this process; its output goes to its log."""
    folder.mkdir(mode=0o700, parents=True, exist_ok=True)
    write_whole(folder / SETTINGS, json.dumps(data_of(settings)))
    _STARTED[:] = [process for process in _STARTED if process.poll() is None]
    if (folder / LOG).exists() and (folder / LOG).stat().st_size > _LONG:
        (folder / LOG).replace(folder / f"{LOG}.old")
    words = [*(command or respawn.library("gateway")), str(folder)]
    process = respawn.start(words, folder / LOG)
    _STARTED.append(process)
    return process


def speed_in(folder: Path) -> float | None:
    """Return the speed of time of the gateway of a folder; None: it was never started."""
    with suppress(OSError, ValueError, KeyError, TypeError):
        return float(json.loads((folder / SETTINGS).read_text(encoding="utf-8"))["speed"])
    return None


def stop_directly(folder: Path, how: Down, patience: float) -> str:
    """Bring all drones down without their brain; return the gateway's answer.

    Raises `BadInput`, as `ask` does, if there is no gateway, or it says nothing in these seconds.
    """
    return ask(folder / NOTE, {"do": "stop", "how": how.value}, patience)


def cut_directly(folder: Path, drone: str | None, patience: float) -> str:
    """Switch a drone's motors off, or with None those of all; return the gateway's answer.

    Raises `BadInput`, as `ask` does, if there is no gateway, or it says nothing in these seconds.
    """
    which = {"all": True} if drone is None else {"drone": drone}
    return ask(folder / NOTE, {"do": "cut-motors", **which}, patience)


def still_runs(folder: Path) -> int | None:
    """Return the process id of the gateway of a folder; None: none runs."""
    return locks.holder(folder / LOCK)


def let_end(folder: Path) -> None:
    """Ask the gateway of a folder to end once all its drones have landed: no brain will return."""
    _send(folder, signal.SIGTERM)


def _send(folder: Path, number: signal.Signals) -> None:
    process = still_runs(folder)
    if process is not None:
        with suppress(OSError):
            os.kill(process, number)


def _ended(folder: Path, code: int) -> str:
    """Return the error of a gateway that failed to start, with the end of its log."""
    if code == NO_ROOM:
        return f"{folder}: the gateway cannot begin: the disk is full; make room, then resume"
    lines: list[str] = []
    with suppress(OSError):
        lines = (folder / LOG).read_text(encoding="utf-8", errors="replace").strip().splitlines()
    if not lines:
        return f"the gateway ended before it was ready, with exit code {code}, and said nothing"
    return f"the gateway ended before it was ready: {lines[-1]} (all it said is in {folder / LOG})"
