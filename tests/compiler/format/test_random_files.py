"""Files that no one would write, but may: random statements in a random layout."""

from __future__ import annotations

from random import Random

from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from plutoc.syntax.tokens import OWNERS, SOFT_WORDS, WORDS
from tests.format.layouts import Liberty, laid_out, words_of
from tests.format.promises import formatted, keep, meaning, writing

NAMES = st.sampled_from(["a", "b_1", "STANDBY", "Kind", "ünï", "x" * 30, "yes", "m", *SOFT_WORDS])
"""The grammar takes any name anywhere; what it means is for later."""
INSIDE = NAMES | st.sampled_from(WORDS)
"""In brackets the language's words are names."""
NUMBERS = st.sampled_from(["1", "-0.50", "007", "123456789"])
UNITS = st.sampled_from(["min", "%", "m/s", "furlong"])
TEXTS = st.text(st.sampled_from('ab #,{}[]()->="\\é'), max_size=30).map(
    lambda text: '"' + text.replace("\\", "\\\\").replace('"', '\\"') + '"'
)


def joined(elements: st.SearchStrategy[str], least: int = 0) -> st.SearchStrategy[str]:
    """Return elements with commas between them."""
    return st.lists(elements, min_size=least, max_size=6).map(", ".join)


def optional(text: st.SearchStrategy[str]) -> st.SearchStrategy[str]:
    """Return a text or nothing."""
    return st.just("") | text


VALUES = st.recursive(
    NUMBERS | st.builds("{} {}".format, NUMBERS, UNITS) | TEXTS | INSIDE,
    lambda values: joined(values).map("[{}]".format),
    max_leaves=8,
)
OUTSIDE = NUMBERS | st.builds("{} {}".format, NUMBERS, UNITS) | TEXTS | NAMES
"""Values where the language's words are words: in no brackets."""
ARGUMENTS = optional(joined(st.builds("{}: {}".format, INSIDE, VALUES)).map("({})".format))
PARAMETER = st.builds("{}: {}{}".format, INSIDE, INSIDE, optional(VALUES.map(" = {}".format)))
PARAMETERS = optional(joined(PARAMETER).map("({})".format))
FIELD = st.builds("{}: {}{}".format, NAMES, NAMES, optional(OUTSIDE.map(" = {}".format)))
OWNER = st.sampled_from(OWNERS)
RESULT = optional(NAMES.map(" -> {}".format))
LISTED = joined(NAMES, least=1)
STOPS = NAMES | joined(INSIDE, least=1).map("[{}]".format)
STATEMENTS = st.one_of(
    st.builds("version {}".format, TEXTS),
    st.builds("requires {}{}".format, joined(TEXTS, least=1), optional(st.just(","))),
    st.builds("category {}{} can {}".format, NAMES, ARGUMENTS, LISTED),
    st.builds("{} has {}{}".format, OWNER, joined(FIELD, least=1), optional(st.just(","))),
    st.builds(
        "action {}{}{}{}".format, NAMES, PARAMETERS, RESULT, optional(NAMES.map(" {}".format))
    ),
    st.builds(
        "modifier {}{}{}{}".format,
        NAMES,
        PARAMETERS,
        optional(LISTED.map(" emits {}".format)),
        optional(LISTED.map(" writes {}".format)),
    ),
    st.builds("evaluator {}{}".format, NAMES, PARAMETERS),
    st.builds("policy {}".format, NAMES),
    st.builds("{} = {}{}{}".format, NAMES, optional(NAMES.map("{}.".format)), NAMES, ARGUMENTS),
    st.builds(
        "{}{}".format,
        st.lists(STOPS, min_size=2, max_size=8).map(" -> ".join),
        optional(st.just(" otherwise") | LISTED.map(" when {}".format)),
    ),
)
USES = st.builds("use {}{}\n".format, NAMES, optional(NAMES.map(" as {}".format)))
FILES = st.builds(
    "pluto 1\n{}app {}{} {{\n{}}}\n".format,
    st.lists(USES, max_size=3).map("".join),
    NAMES,
    optional(TEXTS.map(" {}".format)),
    st.lists(STATEMENTS.map("{}\n".format), max_size=8).map("".join),
)


@settings(
    max_examples=60, derandomize=True, deadline=None, suppress_health_check=[HealthCheck.too_slow]
)
@given(FILES, st.integers(0, 2**32), st.sampled_from([0, 0.05, 0.3, 1]))
def test_every_file_of_the_language_keeps_its_comments_and_its_meaning(
    text: str, seed: int, comments: float
) -> None:
    """In any layout, and however long its names are."""
    layout = laid_out(words_of(text), Random(seed), Liberty(comments=comments))
    keep(layout, meaning(text))


@settings(max_examples=30, derandomize=True, deadline=None)
@given(NAMES, PARAMETERS, NAMES, NAMES, st.integers(0, 2**32), st.sampled_from([0, 0.3, 1]))
def test_what_an_action_gives_comes_before_the_word_behind_it(
    name: str, parameters: str, word: str, result: str, seed: int, comments: float
) -> None:
    """However it was written; all words and comments are there, and the meaning is the same."""
    lines = [f"action {name}{parameters} {word} -> {result}", "a -> b"]
    text = "pluto 1\napp a {\n" + "\n".join(lines) + "\n}\n"
    layout = laid_out(words_of(text), Random(seed), Liberty(comments=comments))
    out = formatted(layout)
    assert formatted(out) == out
    assert meaning(out) == meaning(text)
    assert sorted(writing(out)) == sorted(writing(layout.replace("\r", "").removeprefix("\ufeff")))
    said = [one for one in writing(out) if not one.startswith("#")]
    assert said[-6:-4] == [result, word]
