"""One task in a copy of this process: what it finds, what goes wrong in it, and its death."""

from __future__ import annotations

import asyncio
import os
from collections.abc import Callable, Iterator

import pytest

from pluto_fleet.process.beside import in_a_copy
from pluto_fleet.process.copies import Died

pytestmark = pytest.mark.process


class Unreadable:
    """Can be sent, and not be received."""

    def __reduce__(self) -> tuple[Callable[[str], int], tuple[str]]:
        return int, ("none",)


def test_what_goes_wrong_in_a_copy_is_raised_here_and_it_ends_when_nobody_reads_on(
    no_worker_left: None,
) -> None:
    heard: list[object] = []

    async def find(how: object) -> None:
        def work() -> Iterator[object]:
            print("it is not printed")
            yield os.getpid()
            match how:
                case "error":
                    raise LookupError("of a hook")
                case "exit":
                    raise SystemExit
                case "unreadable":
                    yield Unreadable()
                case "killed":
                    os.kill(os.getpid(), 9)

        async for one in in_a_copy(work):
            heard.append(one)

    with pytest.raises(LookupError, match="of a hook"):
        asyncio.run(find("error"))
    with pytest.raises(Died, match="ended by SystemExit"):  # and not this process
        asyncio.run(find("exit"))
    with pytest.raises(ValueError, match="none"):
        asyncio.run(find("unreadable"))
    with pytest.raises(Died, match="was killed by SIGKILL"):
        asyncio.run(find("killed"))
    asyncio.run(find("well"))
    assert len({*heard}) == 5 and os.getpid() not in heard
    asyncio.run(given_up())


async def given_up() -> None:
    """Read what one copy finds first, and see that it ends, though it waits for ever."""

    def work() -> Iterator[int]:
        yield os.getpid()
        os.read(reads, 1)

    reads, writes = os.pipe()
    finds = in_a_copy(work)
    copy = await anext(finds)
    await finds.aclose()
    async with asyncio.timeout(60.0):
        while is_there(copy):
            await asyncio.sleep(0.01)
    os.close(reads)
    os.close(writes)


def is_there(process: int) -> bool:
    """Whether a child has not been waited for yet."""
    try:
        os.waitid(os.P_PID, process, os.WEXITED | os.WNOHANG | os.WNOWAIT)
    except ChildProcessError:
        return False
    return True
