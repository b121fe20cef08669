"""Log blocks and parameters, byte by byte."""

from __future__ import annotations

import struct

from hypothesis import given
from hypothesis import strategies as st

from pluto_fleet.crtp.logs import MOST_BLOCKS
from pluto_fleet.crtp.packets import Errno, Port, packed
from tests.library.crtp.bench import Bench

CREATE, APPEND, START, STOP, DELETE, RESET = 6, 7, 3, 4, 2, 5
FLOAT = 7


def names() -> list[str]:
    return list(Bench().drone.variables)


def created(bench: Bench, number: int, *wanted: str) -> int:
    kinds = b"".join(struct.pack("<BH", FLOAT, names().index(name)) for name in wanted)
    answer = bench.told(Port.LOG, 1, bytes([CREATE, number]) + kinds)
    assert answer is not None
    return answer[2]


def test_a_block_holds_26_bytes_and_there_are_16_of_them() -> None:
    bench = Bench()
    six = ("stateEstimate.x",) * 6
    assert created(bench, 1, *six) == Errno.OK
    assert created(bench, 1, *six) == Errno.EEXIST
    assert created(bench, 2, *six, "stateEstimate.y") == Errno.E2BIG
    for number in range(2, MOST_BLOCKS + 1):
        assert created(bench, number, "stateEstimate.x") == Errno.OK
    assert created(bench, 99, "stateEstimate.x") == Errno.ENOMEM
    bench.told(Port.LOG, 1, bytes([RESET]))
    assert created(bench, 99, "stateEstimate.x") == Errno.OK


@given(st.integers(0, 15), st.integers(0, 3), st.binary(max_size=30))
def test_it_lives_on_no_matter_what_it_is_sent(port: int, channel: int, data: bytes) -> None:
    bench = Bench()
    bench.drone.receive(packed(port, channel, data), bench.now)
    bench.passes(0.05)
    assert all(len(answer.data) <= 30 for answer in bench.sent)
