"""Sources that are nearly those of the examples and of the cases: pieces changed, lines of others put in."""

from __future__ import annotations

from functools import cache
from random import Random

from tests.fuzz.texts import HOSTILE
from tests.mutations import MUTATIONS, mutated
from tests.paths import CASES, EXAMPLES

ODD_BYTES = (
    *(b"\0", b"\r", b"\xff", b"\xc3", b"\xef\xbb\xbf", b"\r\n", b"\xe2\x80\xae", b"\xed\xa0\x80"),
    *(b"\xf0\x9f\x92\xa9", b"\xe2\x80\xa8", b"0" * 20, b"\x1b[31m", b"\x7f", b"\\", b"# "),
)


@cache
def seeds() -> tuple[str, ...]:
    """Return the sources of the examples, which compile, and as many times those of the cases."""
    whole = [path.read_text("utf-8") for path in sorted(EXAMPLES.rglob("*.pluto"))]
    paths = sorted(CASES.glob("*/app.pluto"))
    cases = [path.read_bytes().decode("utf-8", "replace") for path in paths]
    return (*whole * max(1, len(cases) // len(whole)), *cases)


def changed(random: Random) -> bytes:
    """Return a source with a few of its characters, words or lines changed."""
    text = random.choice(seeds())
    for _ in range(random.choice((1, 1, 1, 2, 3, 8))):
        if random.random() < 0.1:
            at = random.randrange(len(text) + 1)
            text = text[:at] + random.choice(HOSTILE) + text[at:]
        elif text.strip():
            text = mutated(text, random.choice(list(MUTATIONS)), random)
    data = text.encode()
    if random.random() < 0.3:
        at = random.randrange(len(data) + 1)
        data = data[:at] + random.choice(ODD_BYTES) * random.choice((1, 2, 100)) + data[at:]
    return data


def spliced(random: Random) -> bytes:
    """Return a source with lines of other sources in it."""
    lines = random.choice(seeds()).splitlines(keepends=True)
    for _ in range(random.choice((1, 1, 2, 4))):
        other = random.choice(seeds()).splitlines(keepends=True) or ["\n"]
        at = random.randrange(len(lines))
        lines[at : at + random.choice((0, 1))] = [random.choice(other)]
    return "".join(lines).encode()
