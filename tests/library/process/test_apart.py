"""Questions that another process answers: what they hold up there, what goes wrong, and its death."""

from __future__ import annotations

import asyncio
import os
import signal
from collections.abc import Callable, Coroutine, Sequence
from contextlib import closing
from typing import Any

import pytest

from pluto_fleet.process.apart import PROCESSES, Apart
from pluto_fleet.process.copies import Died
from pluto_fleet.shared.domain.errors import BadInput

from .holding import held

pytestmark = pytest.mark.process

WORDS = ("one", "two", "three")

Scene = Callable[[Apart[Sequence[str]]], Coroutine[Any, Any, None]]


def play(scene: Scene) -> None:
    """Ask another process about some words."""
    with closing(Apart[Sequence[str]](WORDS)) as apart:
        asyncio.run(scene(apart))


def count(words: Sequence[str], *, longer_than: int = 0) -> int:
    return len([word for word in words if len(word) > longer_than])


def process(_: Sequence[str]) -> int:
    return os.getpid()


def refuse(words: Sequence[str], why: str) -> None:
    raise BadInput(f"{words[0]}: {why}")


def leave(_: Sequence[str]) -> None:
    raise SystemExit(3)


def unreadable(_: Sequence[str]) -> Callable[[], None]:
    return lambda: None


def die(_: Sequence[str]) -> None:
    os.kill(os.getpid(), signal.SIGKILL)


def test_what_holds_pythons_own_lock_there_holds_nothing_up_here() -> None:
    reads, writes = os.pipe()

    async def scene(apart: Apart[Sequence[str]]) -> None:
        holds = [asyncio.ensure_future(apart.ask(held, reads)) for _ in range(5)]
        await asyncio.sleep(0)
        os.write(writes, b"12345")  # in a thread of this process, none would come here
        assert sorted(await asyncio.gather(*holds)) == [b"1", b"2", b"3", b"4", b"5"]

    play(scene)
    os.close(reads)
    os.close(writes)


def test_what_goes_wrong_there_is_raised_here_and_the_next_question_is_answered() -> None:
    async def scene(apart: Apart[Sequence[str]]) -> None:
        with pytest.raises(BadInput, match="one: so it is"):
            await apart.ask(refuse, "so it is")
        with pytest.raises(SystemExit):
            await apart.ask(leave)
        with pytest.raises(Exception, match="lambda"):
            await apart.ask(unreadable)
        assert await apart.ask(count, longer_than=3) == 1
        assert await apart.ask(process) not in (os.getpid(), os.getppid())

    play(scene)


def test_if_one_dies_who_has_asked_it_is_told_and_another_answers_all_else() -> None:
    async def scene(apart: Apart[Sequence[str]]) -> None:
        first = await apart.ask(process)
        dies, beside = apart.ask(die), apart.ask(process)
        outcomes = await asyncio.gather(dies, beside, return_exceptions=True)
        assert isinstance(outcomes[0], Died)
        assert outcomes[1] == await apart.ask(process) != first

    play(scene)


def test_who_gives_an_answer_up_keeps_no_place() -> None:
    reads, writes = os.pipe()

    async def scene(apart: Apart[Sequence[str]]) -> None:
        for _ in range(3):
            holds = [asyncio.ensure_future(apart.ask(held, reads)) for _ in range(PROCESSES)]
            await asyncio.sleep(0)
            for one in holds:
                one.cancel()
            assert await apart.ask(count) == 3

    play(scene)
    os.close(reads)
    os.close(writes)


def test_interrupts_are_for_those_who_ask_and_it_ends_with_them(no_worker_left: None) -> None:
    there: list[int] = []

    async def scene(apart: Apart[Sequence[str]]) -> None:
        there.append(await apart.ask(process))
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            os.kill(there[0], number)
        assert await apart.ask(process) == there[0]

    play(scene)
    asyncio.run(gone(there[0]))


async def gone(process: int) -> None:
    """Wait until there is no such process."""
    async with asyncio.timeout(60.0):
        while os.path.exists(f"/proc/{process}"):
            await asyncio.sleep(0.01)
