"""A text that is read from an earlier one's tree is read as by itself: same tree, same findings."""

from __future__ import annotations

import random

import pytest

from plutoc.source import Source
from plutoc.syntax.again import is_sound, read_again
from plutoc.syntax.parse import read
from tests.paths import ROOT

EXAMPLES = sorted((ROOT / "examples").glob("*/app.pluto"))
PIECES = (
    *("\n", "\n\n", "\r\n", " ", "->", "-> ", "(", ")", "[", "]", "{", "}", ",", ":", "=", '"'),
    *("#", "# a\n", "\\", "\t", "ä", "\u200b", "first", "when ", "otherwise", "STANDBY"),
    *("  a = Clock\n", "a -> [b, c]\n", "category x can measure\n", 'version "1"\n', "x = K(\n"),
    *("app", "use x\n", "pluto 2", "5 min", "q: 1, ", "evaluator ", "", "", ""),
)


def typed(text: str, chance: random.Random) -> str:
    """Return a text with a piece of it replaced."""
    start = chance.randrange(len(text) + 1)
    end = min(start + chance.choice((0, 0, 0, 1, 1, 3, 12)), len(text))
    return text[:start] + chance.choice(PIECES) + text[end:]


@pytest.mark.parametrize("seed", range(8))
def test_what_is_typed_is_read_as_by_itself(seed: int) -> None:
    chance = random.Random(seed)
    text = chance.choice(EXAMPLES).read_text(encoding="utf-8")
    before = read(Source("a", text))[0]
    for _ in range(40):
        new = typed(before.source.text if chance.random() < 0.4 else text, chance)
        source = Source("a", new)
        again, alone = read_again(source, before), read(source)
        assert again[1] == alone[1], new
        assert again[0] == alone[0], new
        if is_sound(*again):
            before = again[0]
        text = new if chance.random() < 0.8 else before.source.text
