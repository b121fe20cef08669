"""What a Crazyflie answers to commands: cflib takes the answers from the radio and drops them."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from typing import TYPE_CHECKING

from .driver import HIGH_LEVEL, SUPERVISOR

if TYPE_CHECKING:
    from cflib.crazyflie import Crazyflie as Cf
    from cflib.crtp.crtpstack import CRTPPacket

_ANSWER = 0x80
"""The supervisor sets this bit in its answers."""
_COMMANDS = 1
"""The channel on which it takes commands."""

Key = tuple[int, int]
"""The port, and the number of the command."""


class Acknowledgements:
    """Answers that somebody waits for."""

    def __init__(self) -> None:
        self._waiting: dict[Key, asyncio.Future[bytes]] = {}

    def listen(self, cf: Cf, tell: Callable[..., None]) -> None:
        """Hear all answers; called in the worker, as they come in a thread of cflib's."""

        def high_level(packet: CRTPPacket) -> None:
            tell(self._hear, HIGH_LEVEL, packet.channel, bytes(packet.data))

        def supervisor(packet: CRTPPacket) -> None:
            tell(self._hear, SUPERVISOR, packet.channel, bytes(packet.data))

        cf.add_port_callback(HIGH_LEVEL, high_level)
        cf.add_port_callback(SUPERVISOR, supervisor)

    def expect(self, key: Key) -> asyncio.Future[bytes]:
        """Begin to listen for the next answer to a command: before the command is sent."""
        answer: asyncio.Future[bytes] = asyncio.get_running_loop().create_future()
        self._waiting[key] = answer
        return answer

    async def heard(self, answer: asyncio.Future[bytes], limit: float) -> bytes | None:
        """Return the answer, or None if it does not come in time."""
        await asyncio.wait({answer}, timeout=limit)
        return answer.result() if answer.done() else None

    def drop(self, key: Key, answer: asyncio.Future[bytes]) -> None:
        """Listen no longer."""
        answer.cancel()
        if self._waiting.get(key) is answer:
            del self._waiting[key]

    def _hear(self, port: int, channel: int, data: bytes) -> None:
        if not data or (port == SUPERVISOR and channel != _COMMANDS):
            return
        number = data[0] & ~_ANSWER if port == SUPERVISOR else data[0]
        answer = self._waiting.get((port, number))
        if answer is not None and not answer.done():
            answer.set_result(data)
