"""Sources that are nearly those of the examples and of the cases: bytes changed, parts swapped."""

from __future__ import annotations

from functools import cache
from random import Random

from tests.fuzz.texts import HOSTILE
from tests.paths import ROOT

ODD_BYTES = (
    *(b"\0", b"\r", b"\t", b"\xff", b"\xc3", b"\xef\xbb\xbf", b'"', b"\\", b"#", b"{", b"}", b"("),
    *(b")", b"[", b"]", b"->", b"=", b",", b":", b".", b"%", b"\n", b"\r\n", b" ", b"\xe2\x80\xae"),
    *(b"pluto 1\n", b"app a {", b" when ", b" otherwise", b"use a as b\n", b"start", b"end", b"-1"),
    *(b"\xed\xa0\x80", b"\xf0\x9f\x92\xa9", b"\xe2\x80\xa8", b"0" * 20, b"_", b"\x1b[31m", b"\x7f"),
)


@cache
def seeds() -> tuple[bytes, ...]:
    """Return the sources of the examples and of the cases, in order of path."""
    paths = sorted((ROOT / "examples").rglob("*.pluto"))
    paths += sorted((ROOT / "tests" / "cases").glob("*/app.pluto"))
    return tuple(path.read_bytes() for path in paths)


@cache
def whole() -> tuple[bytes, ...]:
    """Return those of the examples alone: they compile."""
    return tuple(path.read_bytes() for path in sorted((ROOT / "examples").rglob("*.pluto")))


def mutated(random: Random) -> bytes:
    """Return a source with a few of its bytes changed."""
    data = bytearray(random.choice(seeds() if random.random() < 0.5 else whole()))
    for _ in range(random.choice((1, 1, 1, 2, 3, 8))):
        at = random.randrange(len(data) + 1)
        match random.randrange(7):
            case 0:
                data[at : at + random.choice((1, 1, 2, 5, 40))] = b""
            case 1:
                data[at:at] = random.choice(ODD_BYTES)
            case 2:
                data[at:at] = random.choice(HOSTILE).encode()
            case 3 if at < len(data):
                data[at] = random.randrange(256)
            case 4:
                other = random.randrange(len(data) + 1)
                piece = data[at : at + random.choice((1, 3, 10, 60))]
                data[other:other] = piece
            case 5 if at < len(data):
                data[at] ^= 1 << random.randrange(8)
            case _:
                data[at:at] = data[at : at + 1] * random.choice((1, 2, 100))
    return bytes(data)


def spliced(random: Random) -> bytes:
    """Return an example with lines of other sources in it, or without some of its own."""
    lines = random.choice(whole()).splitlines(keepends=True)
    for _ in range(random.choice((1, 1, 2, 4))):
        other = random.choice(seeds()).splitlines(keepends=True) or [b"\n"]
        at = random.randrange(1, len(lines))
        match random.randrange(4):
            case 0 if len(lines) > 3:
                del lines[at]
            case 1:
                lines[at] = random.choice(other)
            case 2:
                one = random.randrange(1, len(lines))
                lines[at], lines[one] = lines[one], lines[at]
            case _:
                lines.insert(at, random.choice(other))
    return b"".join(lines)
