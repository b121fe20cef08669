"""Moments that another process understands: how long ago was it, even if the clock was set since?"""

from __future__ import annotations

import time
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

_BOOT = Path("/proc/sys/kernel/random/boot_id")


@dataclass(frozen=True, slots=True, kw_only=True)
class Moment:
    """A moment, on the wall and since the machine was started."""

    wall: float
    """Seconds since 1970, as far as the clock is right."""
    boot: str
    """Which start of the machine that was; empty: it cannot be told."""
    up: float
    """Seconds since then, sleep included; they cannot be set."""

    def since(self, data: Mapping[str, Any]) -> float:
        """Return the seconds since a moment that was written down; never less than none."""
        if self.boot and self.boot == data["boot"]:
            return max(0.0, self.up - float(data["up"]))
        return max(0.0, self.wall - float(data["wall"]))

    @property
    def data(self) -> dict[str, object]:
        """The moment as plain data."""
        return {"wall": self.wall, "boot": self.boot, "up": self.up}


def this_moment() -> Moment:
    """Return what the clocks show."""
    boot = _this_boot()
    up = time.clock_gettime(time.CLOCK_BOOTTIME) if boot else 0.0
    return Moment(wall=time.time(), boot=boot, up=up)


@cache
def _this_boot() -> str:
    with suppress(OSError):
        return _BOOT.read_text(encoding="ascii").strip()
    return ""
