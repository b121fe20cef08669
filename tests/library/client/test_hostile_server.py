"""Whatever is at the address of a station, its client says so, in a sentence and in time."""

from __future__ import annotations

import json
import socket
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from itertools import repeat

import pytest

from pluto_fleet.client import Refused, Station, station
from pluto_fleet.shared.domain.errors import BadInput

PIECE = 0.02
"""Seconds between two pieces of a server that is slow."""
ENOUGH = 200
"""Pieces after which it has said all, so that a client that does not mind comes to an end."""


def answer(body: bytes, status: str = "200 OK", length: int | None = None) -> bytes:
    size = len(body) if length is None else length
    return f"HTTP/1.1 {status}\r\nContent-Length: {size}\r\n\r\n".encode() + body


def slowly(text: bytes) -> Iterator[bytes]:
    for piece in [text[n : n + 1] for n in range(ENOUGH)]:
        time.sleep(PIECE)
        yield piece
    yield text[ENOUGH:]


@contextmanager
def serving(pieces: Callable[[], Iterator[bytes]]) -> Iterator[str]:
    """Answer every request by these bytes."""
    listener = socket.create_server(("127.0.0.1", 0))

    def serve() -> None:
        with suppress(OSError):
            while True:
                line, _ = listener.accept()
                with line, suppress(OSError):
                    line.recv(65536)
                    for piece in pieces():
                        line.sendall(piece)

    thread = threading.Thread(target=serve, daemon=True)
    thread.start()
    try:
        yield f"http://127.0.0.1:{listener.getsockname()[1]}"
    finally:
        listener.shutdown(socket.SHUT_RDWR)
        listener.close()


LIVE = {"server": "a", "flight": "", "version": 1}
DEEP = b"[" * 100_000


@pytest.mark.parametrize(
    ("body", "said"),
    [
        (b"SSH-2.0-OpenSSH_9.6\r\n", "no station answers at"),
        (b"", "no station answers at"),
        (answer(b"x" * 10, length=99), "no station answers at"),
        (b"HTTP/1.1 200 OK\r\n" + b"A: b\r\n" * 10_000, "no station answers at"),
        (b"HTTP/1.1 200 OK\r\nTransfer-Encoding: chunked\r\n\r\nZZ\r\n", "no station answers at"),
        (answer(b"<html>"), "is no JSON: is that a station"),
        (answer(b"\xff\xfe"), "is no JSON"),
        (answer(DEEP), "is no JSON"),
        (answer(b"[1]"), "is not what this version"),
        (answer(b"null"), "is not what this version"),
        (answer(json.dumps(LIVE).encode()), "is not what this version"),
        (answer(json.dumps({**LIVE, "log": [1]}).encode()), "is not what this version"),
        (answer(b"", "302 Found\r\nLocation: http://127.0.0.1:1/"), "answers 302, and is no"),
        (answer(DEEP, "409 Conflict"), "answers 409, and is no station"),
        (answer(b'{"said": ["x"]}', "400 Bad"), "answers 400, and is no station"),
        (answer(b'{"revision": "x"}', "409 Conflict"), "answers 409, and is no station"),
    ],
)
def test_what_no_station_answers_is_told_in_a_sentence(body: bytes, said: str) -> None:
    with serving(lambda: iter([body])) as url, pytest.raises(BadInput, match=said):
        next(Station(url, timeout=20.0).updates())


@pytest.mark.parametrize("given", [b'{"said": 1}', b"[]", b'"x"'])
def test_what_was_done_is_a_sentence(given: bytes) -> None:
    with serving(lambda: iter([answer(given)])) as url, pytest.raises(BadInput):
        Station(url).stop(how="land")


def test_an_answer_without_end_is_given_up(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(station, "LARGEST_JSON", 2**20)
    monkeypatch.setattr(station, "LARGEST", 2**21)
    head = b"HTTP/1.1 200 OK\r\n\r\n"
    with serving(lambda: iter([head, *repeat(b"x" * 2**16, 1_000)])) as url:
        with pytest.raises(BadInput, match="is larger than 1 MiB"):
            Station(url).live()
        with pytest.raises(BadInput, match="is larger than 2 MiB"):
            Station(url).plan_file()


@pytest.mark.parametrize("head", [b"HTTP/1.1 200 OK\r\nX: " + b"a" * 500, answer(b'"x"' * 200)])
def test_an_answer_that_comes_byte_by_byte_is_given_up(head: bytes) -> None:
    """Its headers as well as its body: each byte comes in time, and the whole does not."""
    with serving(lambda: slowly(head)) as url, pytest.raises(BadInput, match="slowly") as told:
        Station(url, timeout=0.2).live()
    assert "no station answers" in str(told.value)


@pytest.mark.parametrize("token", ["x\r\nHost: y", "\ud800", "ü" * 3 + "\u4e00"])
def test_a_token_that_cannot_be_sent_is_told(token: str) -> None:
    with serving(lambda: iter([answer(b"{}")])) as url, pytest.raises(BadInput):
        Station(url, token=token).live()


def test_a_refusal_that_is_a_stations_is_one() -> None:
    refusal = answer(b'{"said": "nothing flies"}', "409 Conflict")
    with serving(lambda: iter([refusal])) as url, pytest.raises(Refused) as refused:
        Station(url).discard()
    assert (refused.value.status, str(refused.value)) == (409, "nothing flies")
