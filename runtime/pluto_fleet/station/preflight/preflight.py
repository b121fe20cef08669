"""Forecasting a Start beside whatever flies: one at a time, the newest wins, and none holds a Stop up."""

from __future__ import annotations

import asyncio
import secrets
from collections.abc import Callable, Sequence
from contextlib import aclosing
from pathlib import Path
from typing import TYPE_CHECKING

from ...process.beside import Died, in_a_copy
from ...shared.domain.errors import BadInput
from ...shared.domain.text import duration
from ..history.folder import rehearsals_in
from ..history.recording import SUFFIX
from .forecast import forecast
from .runs import Needs, Rehearsed, Run, found, nothing_flies

if TYPE_CHECKING:
    from ..wire import Forecast, Words
    from .question import Question
    from .runs import Found

WITHIN = 30.0
"""Seconds after which a forecast is made of the runs so far."""

KEPT = 4
"""How many rehearsals are kept, the newest."""

MOST_RUNS = 1_001


class Newer(BadInput):
    """A forecast was given up, as a newer one was asked for, or the plan has changed."""

    def __init__(self, why: str) -> None:
        super().__init__(f"this forecast was given up: {why}")


class Preflight:
    """The forecasts of one station."""

    def __init__(self, own_folder: Path) -> None:
        self._folder = rehearsals_in(own_folder)
        self._running: asyncio.Task[Forecast] | None = None
        self._why = ""
        """Why the one that runs was given up."""
        self.begun: Callable[[], object] = _nothing
        """Called when the first run of a forecast has been flown."""

    async def ask(self, question: Question, keys: Sequence[str], problems: list[Words]) -> Forecast:
        """Return the forecast of a Start; raise `BadInput` if there is none to make, or a newer one wins.

        Cancelling this gives it up at once.
        """
        if (why := nothing_flies(question)) is not None:
            raise why
        self.give_up("a newer one was asked for")
        mine = asyncio.ensure_future(self._made(question, keys, problems))
        self._running = mine
        try:
            await asyncio.wait([mine])
        finally:
            if not mine.done():
                mine.cancel()
            if self._running is mine:
                self._running = None
        if mine.cancelled():
            raise Newer(self._why)
        return mine.result()

    def give_up(self, why: str) -> None:
        """End the forecast that is being made, if any."""
        if self._running is not None:
            self._why = why
            self._running.cancel()

    def revised(self) -> None:
        """Called when the plan has changed: what is forecast is of no use any more."""
        self.give_up("the plan has changed")

    async def _made(
        self, question: Question, keys: Sequence[str], problems: list[Words]
    ) -> Forecast:
        id = f"rehearsal-{secrets.token_hex(8)}"
        self._folder.mkdir(mode=0o700, parents=True, exist_ok=True)
        path = self._folder / f"{id}{SUFFIX}"
        needs, runs, rehearsed = Needs({}, {}), list[Run](), None
        kept = False
        try:
            try:
                async with (
                    asyncio.timeout(WITHIN),
                    aclosing(in_a_copy(lambda: found(question, path))) as finds,
                ):
                    async for one in finds:
                        needs, rehearsed = self._take(one, runs, needs, rehearsed)
            except TimeoutError:
                pass  # it is made of the runs so far
            except Died as end:
                raise BadInput(
                    f"the process that flew the forecast {end}: something in hooks.py ends it,"
                    " or there is not enough memory"
                ) from None
            if not runs:
                raise BadInput(
                    f"not even one run of this plan was flown within {duration(WITHIN)}:"
                    " choose fewer missions"
                )
            kept = rehearsed is not None and rehearsed.recorded
            return forecast(question, keys, needs, runs, rehearsed, id if kept else None, problems)
        finally:
            if not kept:
                path.unlink(missing_ok=True)
            self._tidy()

    def _take(
        self, one: Found, runs: list[Run], needs: Needs, rehearsed: Rehearsed | None
    ) -> tuple[Needs, Rehearsed | None]:
        if isinstance(one, Run):
            runs.append(one)
            self.begun()
        elif isinstance(one, Needs):
            return one, rehearsed
        else:
            return needs, one
        return needs, rehearsed

    def _tidy(self) -> None:
        """Delete all rehearsals but the newest."""
        there = sorted(self._folder.glob(f"*{SUFFIX}"), key=lambda path: path.stat().st_mtime)
        for path in there[:-KEPT]:
            path.unlink(missing_ok=True)


def _nothing() -> None:
    """Do nothing: no callback is set."""
