"""Completion: only what is legal, the likeliest first, wherever the cursor stands."""

from __future__ import annotations

import random

import pytest

from plutoc.diagnostic import Severity
from plutoc.service.answers import Item
from plutoc.service.completion.complete import complete
from plutoc.service.document import Document
from tests.compiler.service.test_hover import ALFALFA
from tests.lsp.holes import FIRST, cuts, mistakes, offered, rank

BARE = """\
pluto 1
app watch_it {
  create = MissionCreator
  allocate = DroneAllocator
  launch = TripLauncher
  watch = TripMonitor
  start -> create -> allocate -> launch -> watch
  @
}
"""


def at(text: str) -> tuple[Item, ...]:
    """Complete where an `@` stands."""
    offset = text.index("@")
    return complete(Document(path="watch_it.pluto", text=text.replace("@", "")), offset)


def inserted(text: str, item: Item) -> str:
    """Return the text with an item in its place."""
    plain = text.replace("@", "")
    return plain[: item.span.start] + item.insert + plain[item.span.end :]


def labels(text: str) -> list[str]:
    return [item.label for item in at(text)]


def in_alfalfa(old: str, new: str) -> str:
    assert old in ALFALFA
    return ALFALFA.replace(old, new)


def test_what_was_cut_out_is_among_the_first_and_all_that_is_offered_is_legal() -> None:
    """A share of the thousand holes of `python -m tests.lsp`."""
    chosen = random.Random(3).sample(cuts(1000), 60)
    among = 0
    for cut in chosen:
        made = offered(cut)
        assert mistakes(cut, made) == [], (cut.path, cut.word)
        found = rank(cut, made)
        among += found is not None and found < FIRST
    assert among >= 0.95 * len(chosen)


@pytest.mark.parametrize(
    "text",
    [
        BARE,
        BARE.replace("@", "wait = @"),
        BARE.replace("@", "watch -> @"),
        BARE.replace("@", "watch -> allocate @"),
        BARE.replace("@", "watch -> allocate when @"),
        BARE.replace("@", "category @"),
        BARE.replace("@", "category a(@) can measure"),
        BARE.replace("@", "category a can measure, @"),
        BARE.replace("@", "action a(@)"),
        BARE.replace("@", "action a(b: @)"),
        BARE.replace("@", "action a(b: time = 5 @)"),
        BARE.replace("@", "action a @"),
        BARE.replace("@", "modifier a @"),
        BARE.replace("@", "modifier a emits @"),
        BARE.replace("@", "evaluator @"),
        BARE.replace("@", "t = TimerMonitor(@)"),
        BARE.replace("@", "t = TimerMonitor(default: @)"),
        BARE.replace("@", "t = DroneAllocator(policy: @)"),
        BARE.replace("@", "").replace("pluto 1", "@"),
        BARE.replace("@", "").replace("watch_it", "@"),
        "@",
        "pluto 1\n@",
    ],
)
def test_each_place_has_something_and_all_of_it_is_legal(text: str) -> None:
    items = at(text)
    assert items
    for item in items:
        found = Document(path="watch_it.pluto", text=inserted(text, item)).of_names
        wrong = [one.message for one in found if one.severity is Severity.ERROR]
        assert wrong == [], item.insert


def test_the_arrow_that_a_graph_lacks_comes_first() -> None:
    assert labels(BARE)[0].startswith("watch -> ")


def test_a_name_that_is_used_is_the_one_to_be_declared() -> None:
    assert labels(BARE.replace("watch = TripMonitor", "@ = TripMonitor").replace("  @\n", "", 0))[
        :1
    ] == ["watch"]


def test_a_kind_comes_with_what_it_must_be_given() -> None:
    text = in_alfalfa("judge = MissionEvaluator(hook: find_blooms)", "judge = @")
    (item,) = (item for item in at(text) if item.label == "MissionEvaluator")
    assert item.insert == "MissionEvaluator(hook: find_blooms)"


def test_a_kind_brings_the_hook_that_the_app_lacks() -> None:
    text = BARE.replace("@", "judge = @")
    (item,) = (item for item in at(text) if item.label == "MissionEvaluator")
    assert "evaluator judge_mission" in inserted(text, item)


def test_a_guard_offers_what_the_block_emits_the_target_takes_and_no_other_arrow_has() -> None:
    assert labels(in_alfalfa("first -> retry when FAILED", "first -> retry when @")) == ["FAILED"]


def test_a_word_that_is_begun_narrows_what_is_offered_in_either_case() -> None:
    assert labels(BARE.replace("@", "x = tripm@"))[:1] == ["TripMonitor"]


def test_units_are_those_of_the_parameter_with_a_blank_before_them() -> None:
    text = in_alfalfa("default: 5 min", "default: 5@")
    assert [inserted(text, item) == ALFALFA for item in at(text) if item.label == "min"] == [True]
    assert labels(in_alfalfa("0.8 m/s", "0.8 @")) == ["m/s", "km/h"]


@pytest.mark.parametrize("place", ["# a @", 'version "@"', 'requires "@"'])
def test_in_a_comment_and_in_a_text_nothing_is_offered(place: str) -> None:
    assert labels(BARE.replace("@", place)) == []


def test_any_place_of_any_text_has_an_answer() -> None:
    chance = random.Random(5)
    for _ in range(60):
        start = chance.randrange(len(ALFALFA))
        text = ALFALFA[:start] + chance.choice('([{}])"#\n,->') + ALFALFA[start + 3 :]
        complete(Document(path="a.pluto", text=text), chance.randrange(len(text)))


def test_how_results_can_be_shown_is_offered_by_what_the_action_gives() -> None:
    """And what can be said of them, of which a measurement needs its quantity."""
    assert labels(BARE.replace("@", "result @"))[0] in ("measure", "take_photo")
    assert labels(BARE.replace("@", "result take_photo @")) == ["as"]
    assert labels(BARE.replace("@", "result take_photo as @")) == [
        "photos",
        "findings",
        "handling",
    ]
    [heat, *_] = at(text := BARE.replace("@", "result measure as @"))
    assert 'as heat(quantity: "temperature")' in inserted(text, heat)
    said = BARE.replace("@", 'result measure as heat(quantity: "pm10", @)')
    assert {*labels(said)} == {"unit", "label", "low", "high", "reach"}


def test_a_statement_may_say_what_results_are() -> None:
    [result] = [item for item in at(BARE) if item.label == "result"]
    assert result.insert.startswith("result ")
