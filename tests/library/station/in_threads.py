"""What reads the files of flights, in a thread of this process: a station's own is tested as a process."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from typing import Concatenate, ParamSpec, TypeVar

from pluto_fleet.app import App
from pluto_fleet.station.config import StationConfig
from pluto_fleet.station.flight_files import FlightFiles

R = TypeVar("R")
P = ParamSpec("P")


class InThreads:
    """Answers in a thread."""

    def __init__(self, app: App, config: StationConfig) -> None:
        self._files = FlightFiles(app, config)
        self._thread = ThreadPoolExecutor(1, "files")

    async def ask(
        self,
        question: Callable[Concatenate[FlightFiles, P], R],
        /,
        *given: P.args,
        **named: P.kwargs,
    ) -> R:
        """Answer a question."""
        call = partial(question, self._files, *given, **named)
        return await asyncio.get_running_loop().run_in_executor(self._thread, call)
