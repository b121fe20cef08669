"""What a user's class yields from outside of the drones, for as long as it takes: positions, or tracks.

A source may stop, fail or yield nonsense: none of that delays anything else, or ends the listening.
"""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator, Callable

PAUSE = 1.0
"""Seconds until a source that has ended is called again."""
MISTAKES: tuple[type[Exception], ...] = (Exception,)
"""Exceptions of a user's class, which are logged and stop nothing else."""
_MOST_SENTENCES = 20
"""How many sentences are logged: a source may invent ever new mistakes."""


class Source:
    """One source, which is called again whenever it has ended, in a running event loop."""

    def __init__(
        self,
        name: str,
        gives: str,
        call: Callable[[], AsyncIterator[object]],
        hear: Callable[[object], None],
        log: Callable[[str], object],
    ) -> None:
        """`name` and `gives` are for sentences: "the localization ceiling", "positions"."""
        self.name = name
        self._gives = gives
        self._call = call
        self._hear = hear
        self._log = log
        self._said: set[str] = set()
        self._listening: asyncio.Task[None] | None = None

    def start(self) -> None:
        if self._listening is None:
            self._listening = asyncio.create_task(
                self._listen(), name=f"{self._gives} of {self.name}"
            )

    async def close(self) -> None:
        """Stop it, and wait until it has ended."""
        if self._listening is not None:
            self._listening.cancel()
            await asyncio.gather(self._listening, return_exceptions=True)

    def say(self, sentence: str) -> None:
        """Log something once: a faulty source is faulty many times a second."""
        if sentence not in self._said and len(self._said) < _MOST_SENTENCES:
            self._said.add(sentence)
            self._log(sentence)

    async def _listen(self) -> None:
        while True:
            yielded = None
            try:
                yielded = self._call()
                async for one in yielded:
                    self._hear(one)
                    await asyncio.sleep(0)  # a source that never waits would block the loop
                why = "it ended"
            except MISTAKES as error:
                why = f"{type(error).__name__}: {error}"
            finally:
                close = getattr(yielded, "aclose", None)
                if close is not None:
                    await close()
            self.say(f"{self.name} gives no {self._gives} any more ({why})")
            await asyncio.sleep(PAUSE)
