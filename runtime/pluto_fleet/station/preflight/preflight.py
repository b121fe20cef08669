"""Forecasting a Start beside a flight: one at a time, the newest wins, and none holds a Stop up."""

from __future__ import annotations

import asyncio
import secrets
from collections.abc import Callable, Sequence
from contextlib import aclosing, suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

from ...process.beside import in_a_copy
from ...process.copies import Died
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

FIRST_WITHIN = 12.0
"""Seconds after which a forecast whose first run has not ended is made in a simpler world, or not at all."""

KEPT = 4
"""How many rehearsals are kept, the newest."""

MOST_RUNS = 1_001


@dataclass(slots=True)
class _Flown:
    """What is found of a question."""

    needs: Needs = field(default_factory=lambda: Needs({}, {}))
    runs: list[Run] = field(default_factory=list)
    rehearsed: Rehearsed | None = None

    def take(self, one: Found) -> None:
        """Take what a copy has found next."""
        if isinstance(one, Run):
            self.runs.append(one)
        elif isinstance(one, Needs):
            self.needs = one
        else:
            self.rehearsed = one


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
        path = self._folder / f"{id}{SUFFIX}"
        kept = False
        try:
            flown = await self._flown(question, path)
            if not flown.runs and (simpler := question.simpler) is not None:
                question, flown = simpler, await self._flown(simpler, path)
            if not flown.runs:
                raise BadInput(
                    f"not even one run of this plan was flown within {duration(FIRST_WITHIN)}:"
                    " choose fewer missions"
                )
            rehearsed = flown.rehearsed
            kept = rehearsed is not None and rehearsed.recorded
            return forecast(
                question,
                keys,
                flown.needs,
                flown.runs,
                rehearsed,
                id if kept else None,
                problems,
            )
        finally:
            with suppress(OSError):  # what stays is deleted after another forecast
                if not kept:
                    path.unlink(missing_ok=True)
                self._tidy()

    async def _flown(self, question: Question, path: Path) -> _Flown:
        """Return what is found in time: nothing more if the first run takes too long."""
        flown, loop = _Flown(), asyncio.get_running_loop()
        ends = loop.time() + WITHIN
        try:
            async with (
                asyncio.timeout(FIRST_WITHIN) as limit,
                aclosing(in_a_copy(lambda: found(question, path))) as finds,
            ):
                async for one in finds:
                    flown.take(one)
                    if flown.runs:
                        limit.reschedule(ends)
                        self.begun()
        except TimeoutError:
            pass  # the forecast is made of the runs so far
        except Died as end:
            raise BadInput(
                f"the process that flew the forecast {end}: something in hooks.py ends it,"
                " or there is not enough memory"
            ) from None
        return flown

    def _tidy(self) -> None:
        """Delete all rehearsals but the newest."""
        there = sorted(self._folder.glob(f"*{SUFFIX}"), key=lambda path: path.stat().st_mtime)
        for path in there[:-KEPT]:
            path.unlink(missing_ok=True)


def _nothing() -> None:
    """Do nothing: no callback is set."""
