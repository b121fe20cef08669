"""What drones have aboard: real ones cannot tell, so it is kept beside their ledger."""

from __future__ import annotations

import json
import os
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

NAME = "aboard.json"


class Cargo:
    """The names of the items aboard, by drone; they outlive the gateway."""

    def __init__(self, folder: Path, say: Callable[[str], object]) -> None:
        self._file, self._say = folder / NAME, say
        self._aboard: dict[str, str] = {}
        with suppress(OSError, ValueError):
            known = json.loads(self._file.read_text(encoding="utf-8"))
            if isinstance(known, dict):
                self._aboard = {str(drone): str(item) for drone, item in known.items()}

    def of(self, drone: str) -> str | None:
        """Return what a drone has aboard."""
        return self._aboard.get(drone)

    def carries(self, drone: str, item: str | None) -> None:
        """A drone has picked an item; None: it has none aboard any more."""
        if self._aboard.get(drone) == item:
            return
        if item is None:
            del self._aboard[drone]
        else:
            self._aboard[drone] = item
        part = self._file.with_name(f".{NAME}.part")
        try:
            with part.open("w", encoding="utf-8") as file:
                json.dump(self._aboard, file)
                file.flush()
                os.fsync(file.fileno())
            part.replace(self._file)
        except OSError as error:
            self._say(f"{self._file} cannot be written: {error}")
