"""The same app in any layout: blanks, line breaks, comments and commas wherever they may stand.

It reads sources with a pattern of its own, so that it shares no mistake with the formatter.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from random import Random

WORD = re.compile(
    r'"(?:[^"\\\n]|\\[^\n])*"|->|-?\d+(?:\.\d+)?(?:[ \t]*(?:%|[^\W\d]\w*(?:/[^\W\d]\w*)?))?|\w+|\S'
)
PART = re.compile(rf"(?P<comment>#[^\n]*)|(?P<newline>\n)|(?P<word>{WORD.pattern})")
NAME = re.compile(r"[^\W\d]\w*")
SAYINGS = (
    "#",
    "# why",
    "#!shebang",
    "# a -> b when X, Y",
    '# "quoted"',
    '# an open " quote',
    "# }{)(][",
    "# name = Kind(",
    "# → ünïcödé 日本",
    "# with\ta tab",
    "# a longer one, that says what is seen there anyway, and goes on behind the last column of all",
    "## twice # over",
    "# blanks behind   ",
    "# no blank that we know \u00a0",
)


@dataclass(frozen=True, slots=True)
class Gap:
    """What stands between two words: comments, and whether a line ends there."""

    comments: tuple[str, ...]
    ends_line: bool


@dataclass(frozen=True, slots=True)
class Words:
    """A source without its layout: its words, and the gap before each and behind the last."""

    words: tuple[str, ...]
    gaps: tuple[Gap, ...]


def words_of(text: str) -> Words:
    """Read a sound source."""
    words: list[str] = []
    gaps: list[Gap] = []
    comments: list[str] = []
    ends_line = False
    for part in PART.finditer(text):
        if part.lastgroup == "word":
            words.append(part[0])
            gaps.append(Gap(tuple(comments), ends_line))
            comments, ends_line = [], False
        elif part.lastgroup == "comment":
            comments.append(part[0])
        else:
            ends_line = True
    return Words(tuple(words), (*gaps, Gap(tuple(comments), ends_line)))


@dataclass(frozen=True, slots=True, kw_only=True)
class Liberty:
    """What a layout may change besides blanks and line breaks."""

    comments: float = 0.1
    """How many of the places that may have comments get some."""
    own: bool = True
    """The source's own comments stay."""
    blank_lines: bool = True
    commas: bool = True


def laid_out(source: Words, random: Random, liberty: Liberty) -> str:
    """Return a source in another layout that means the same."""
    words, gaps = list(source.words), list(source.gaps)
    if liberty.commas:
        words, gaps = _with_other_commas(words, gaps, random)
    end = random.choice(["\n"] * 9 + ["\r\n"])
    texts = [_text(words, gaps, i, random, liberty) for i in range(len(gaps))]
    for i, word in enumerate(words[:-1]):
        # In brackets a line that begins with `NAME =` would be the next statement.
        closes = NAME.fullmatch(word) and words[i + 1] == "=" and _depth(words, i)
        if closes and "\n" in texts[i] and "\n" not in texts[i + 1]:
            texts[i + 1] += "\n"
    out = [text + _respaced(word, random) for text, word in zip(texts, words, strict=False)]
    mark = random.choice(["\ufeff"] + [""] * 9)
    return mark + "".join([*out, texts[-1]]).replace("\n", end)


def _with_other_commas(
    words: Sequence[str], gaps: Sequence[Gap], random: Random
) -> tuple[list[str], list[Gap]]:
    """Add commas behind the last elements in brackets, and take them away."""
    new_words: list[str] = []
    new_gaps: list[Gap] = []
    for word, gap in zip(words, gaps, strict=False):
        if word in (")", "]") and new_words and new_words[-1] not in ("(", "["):
            if new_words[-1] == ",":
                if random.random() < 0.5:
                    new_words.pop()
                    taken = new_gaps.pop()
                    gap = Gap((*taken.comments, *gap.comments), True)
            elif random.random() < 0.3:
                new_words.append(",")
                new_gaps.append(Gap((), False))
        new_words.append(word)
        new_gaps.append(gap)
    return new_words, [*new_gaps, gaps[-1]]


def _text(
    words: Sequence[str], gaps: Sequence[Gap], i: int, random: Random, liberty: Liberty
) -> str:
    """Return the text of the gap before the i-th word."""
    before = words[i - 1] if i else None
    after = words[i] if i < len(words) else None
    inside = _depth(words, i) > 0
    free = inside or "{" in (before, None) or after in ("->", "}", None) or before is None
    must_end = gaps[i].ends_line and not free
    comments = list(gaps[i].comments) if liberty.own else []
    if (free or must_end) and random.random() < liberty.comments:
        for _ in range(random.randint(1, 3)):
            comments.insert(random.randint(0, len(comments)), random.choice(SAYINGS))
    if not (comments or must_end or (free and random.random() < 0.3)):
        return _blanks(before, after, random)
    return _several_lines(comments, random, inside or liberty.blank_lines, i > 0)


def _several_lines(comments: Sequence[str], random: Random, blank_lines: bool, beside: bool) -> str:
    def newlines() -> str:
        many = random.choice([1, 1, 1, 2, 3, 4]) if blank_lines else 1
        return "\n".join([""] + [_some(random) for _ in range(many - 1)] + [""])

    text = _some(random)
    if not (comments and beside and random.random() < 0.5):
        text += newlines() + _some(random)
    for comment in comments:
        text += comment + newlines() + _some(random)
    return text


def _blanks(before: str | None, after: str | None, random: Random) -> str:
    if before and after and WORD.fullmatch(before + after) is None:
        glued = [match[0] for match in WORD.finditer(before + after)]
        if glued == [before, after]:
            return _some(random)
    return _some(random) + random.choice(" \t")


def _some(random: Random) -> str:
    return random.choice(["", "", " ", "  ", "\t", "    "])


def _respaced(word: str, random: Random) -> str:
    """Write a quantity with other blanks before its unit."""
    quantity = re.fullmatch(r"(-?\d+(?:\.\d+)?)[ \t]*([^\d\s.].*)", word)
    return quantity[1] + _some(random) + quantity[2] if quantity else word


def _depth(words: Sequence[str], i: int) -> int:
    """Return how many brackets are open before the i-th word."""
    return sum((word in "([") - (word in ")]") for word in words[:i])
