"""Whose motors were cut, until a person has looked after them: that outlives the gateway."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from typing import TYPE_CHECKING

from plutoc_runtime.domain.errors import FlightFailed

if TYPE_CHECKING:
    from .ledger import Ledger


class CutMotors:
    """It is written down before it is done, for nobody knows when the process is killed.

    So an earlier gateway may have died in between. Then the drone flies, and is to be landed.
    """

    def __init__(self, ledger: Ledger | None, flies: Callable[[str], bool]) -> None:
        self._ledger, self._flies = ledger, flies
        self._cut: dict[str, bool] = {}
        """By drone: whether they were cut here, and not by an earlier gateway."""
        if ledger is not None:
            self._cut.update(dict.fromkeys(ledger.cut, False))

    def __contains__(self, drone: str) -> bool:
        here = self._cut.get(drone)
        return here is not None and (here or not self._flies(drone))

    @contextmanager
    def cutting(self, drone: str) -> Iterator[None]:
        """Keep it; if the drone cannot be told, it is as it was: it shall come home if it can."""
        before = self._cut.get(drone)
        self._cut[drone] = True
        if before is None:
            self._write(drone, True)
        try:
            yield
        except FlightFailed:
            if before is None:
                self.mended(drone)
            else:
                self._cut[drone] = before
            raise
        self._make_sure()

    def mended(self, drone: str) -> None:
        """A person has looked after it."""
        if self._cut.pop(drone, None) is not None:
            self._write(drone, False)
            self._make_sure()

    def _write(self, drone: str, is_cut: bool) -> None:
        """Write it down, if that can be done: motors are not left on because a disk is full."""
        if self._ledger is not None:
            with suppress(OSError):
                self._ledger.write_cut(drone, is_cut)

    def _make_sure(self) -> None:
        if self._ledger is not None:
            with suppress(OSError):
                self._ledger.make_sure()
