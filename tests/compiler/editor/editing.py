"""An app in a folder, and clients that edit it without a browser."""

from __future__ import annotations

import asyncio
import json
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from pathlib import Path
from typing import Any

from plutoc.editor.session import Client, Session

APP = """pluto 1

# A farm.
app farm "The farm" {
  create = MissionCreator
  allocate = DroneAllocator  # 🚁
  launch = TripLauncher
  watch = TripMonitor
  start -> create -> allocate -> launch -> watch
  watch -> allocate when STANDBY
  watch -> end otherwise
}
"""
HOOKED = APP.replace("  create =", "  policy judge\n  create =").replace(
    "DroneAllocator", "DroneAllocator(policy: judge)"
)

Data = dict[str, Any]


class Page:
    """A client that keeps its texts as a browser does."""

    def __init__(self, session: Session) -> None:
        self.session = session
        self.client: Client = session.join()
        self.pushes: list[Data] = []
        self._last = 0

    async def ask(self, op: str, number: int | None = None, **given: object) -> Data:
        """Ask, and return the answer; pushes that come before are kept."""
        self._last = self._last + 1 if number is None else number
        await self.session.hear(self.client, json.dumps({"id": self._last, "op": op, **given}))
        while True:
            message = await self.next()
            if message.get("id") == self._last:
                return message
            self.pushes.append(message)

    async def type(self, at: int, insert: str, to: int | None = None, **given: object) -> Data:
        """Type at a place, in the version that is the newest."""
        change = {"from": at, "to": at if to is None else to, "insert": insert}
        version = given.pop("version", self.session.files.history.version)
        return await self.ask("type", None, changes=[change], version=version, **given)

    async def next(self) -> Data:
        """Return the next message."""
        async with asyncio.timeout(60):
            text = await self.client.next()
        assert text is not None
        message: Data = json.loads(text)
        return message

    async def told(self, push: str, **facts: object) -> Data:
        """Wait for a push like this, and return it."""
        while True:
            if not self.pushes:
                self.pushes.append(await self.next())
            message = self.pushes.pop(0)
            if message.get("push") == push and facts.items() <= message.items():
                return message

    async def saved(self) -> None:
        """Wait until nothing is left to be saved."""
        while self.session.files.unsaved:
            await self.told("disk", what="saved")


def app_in(folder: Path, text: str = APP, hooks: str | None = None) -> Path:
    """Write an app there, its line ends untouched."""
    path = folder / "farm.pluto"
    path.write_bytes(text.encode())
    if hooks is not None:
        (folder / "hooks.py").write_bytes(hooks.encode())
    return path


@asynccontextmanager
async def working(session: Session) -> AsyncIterator[None]:
    """Let the session save, and look at the disk."""
    tasks = [
        asyncio.create_task(session.keep_saving()),
        asyncio.create_task(session.keep_looking()),
    ]
    try:
        yield
    finally:
        for task in tasks:
            task.cancel()
        done = await asyncio.gather(*tasks, return_exceptions=True)
    assert all(isinstance(one, asyncio.CancelledError) for one in done), done


def files_of(folder: Path) -> dict[str, bytes]:
    """Return all that is in a folder."""
    return {
        path.relative_to(folder).as_posix(): path.read_bytes()
        for path in sorted(folder.rglob("*"))
        if path.is_file()
    }
