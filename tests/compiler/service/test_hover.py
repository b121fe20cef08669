"""Hover: a sentence for everything that has a name, and why a status cannot pass."""

from __future__ import annotations

import pytest

from plutoc.service.document import Document
from plutoc.service.reading.hints import hints
from plutoc.service.reading.hover import hover
from tests.paths import ROOT

EXAMPLES = ROOT / "examples"
ALFALFA = (EXAMPLES / "alfalfa" / "app.pluto").read_text(encoding="utf-8")


def said(text: str, place: str, within: str = "") -> str:
    """Return what is said where a word stands, within a line that holds some text."""
    found = hover(
        Document(path="app.pluto", text=text),
        text.index(within or place) + (within.index(place) if within else 0),
    )
    assert found is not None
    assert text[found.span.start : found.span.end].startswith(place[:2])
    return found.markdown


@pytest.mark.parametrize(
    ("place", "within", "words"),
    [
        ("alfalfa", "app alfalfa", ["Alfalfa crop monitoring"]),
        ("scout", "", ["payload: 10 g", "flight_time: 7 min", "reserve: 20 %"]),
        ("take_photo", "", ["action take_photo safe"]),
        ("payload", "", ["a mass (mg, g, kg)", "default 10 g"]),
        (
            "pollinate",
            "action pollinate",
            ["dose: mass = 50 mg", "async def pollinate(drone: Drone"],
        ),
        ("handling", "as handling", ["Something that was done, and not a result"]),
        ("pollinate", "result pollinate", ["dose: mass = 50 mg"]),
        ("mass", "dose: mass", ["`mg`, `g`, `kg`", "kilograms"]),
        ("once", "50 mg) once", ["not repeated after a crash"]),
        ("find_blooms", "hook: find_blooms", ["-> Verdict"]),
        (
            "retry",
            "retry = Pri",
            ["retry = PriorityManager(max_attempts: 3)", "leave with `STANDBY`"],
        ),
        ("PriorityManager", "", ["# PriorityManager", "max_attempts"]),
        ("policy", "", ["`nearest`, `first`"]),
        ("nearest", "", ["`nearest`, one of these"]),
        ("5 min", "", ["a time, 300 (seconds)"]),
        ("FAILED", "when FAILED", ["Along `first -> retry` it passes"]),
        ("start", "start ->", ["It leads to `create`"]),
        ("end", "again -> end", ["Missions end with `COMPLETED`, `FAILED`"]),
        ("otherwise", "end otherwise", ["no other arrow"]),
        ("category", "", ["drones of one shape"]),
    ],
)
def test_each_word_is_explained(place: str, within: str, words: list[str]) -> None:
    text = said(ALFALFA, place, within)
    assert all(word in text for word in words), text


def test_every_name_of_every_example_is_explained() -> None:
    for path in sorted(EXAMPLES.glob("*/app.pluto")):
        document = Document(path=str(path), text=path.read_text(encoding="utf-8"))
        for one in document.names:
            assert hover(document, one.span.start), one


@pytest.mark.parametrize(
    ("line", "words"),
    [
        (
            "first -> retry when FAILED",
            ["carries `FAILED`", "`STANDBY` cannot pass: `retry` does not"],
        ),
        ("judge -> end otherwise", ["`COMPLETED` cannot pass: the arrow to `again` takes it"]),
        ("again -> wait when STANDBY", ["`UNEXECUTED` cannot pass: `again` never emits it"]),
        ("retry -> allocate when STANDBY", ["`FAILED` cannot pass: the guard does not name it"]),
    ],
)
def test_an_arrow_says_what_passes_and_why_the_rest_does_not(line: str, words: list[str]) -> None:
    text = said(ALFALFA, "->", line)
    assert all(word in text for word in words), text


def test_brackets_are_explained_edge_by_edge() -> None:
    text = said(ALFALFA, "->", "-> [watch, timer]")
    assert "launch → watch" in text and "launch → timer" in text and "All together" in text


def test_what_is_accepted_by_a_guard_only_is_said_to_be() -> None:
    text = ALFALFA.replace("retry -> allocate when STANDBY", "retry -> allocate")
    assert "`allocate` accepts it only where a guard says so" in said(
        text, "->", "retry -> allocate"
    )


def test_each_arrow_is_hinted_with_what_passes() -> None:
    document = Document(path="app.pluto", text=ALFALFA)
    found = {
        (ALFALFA[: hint.offset].rpartition("\n")[2].strip()): hint.text for hint in hints(document)
    }
    assert found["first -> retry"] == "FAILED"
    assert found["start -> create -> wait -> allocate -> launch -> [watch, timer]"] == "RUNNING"
    assert len(found) == ALFALFA.count("->")


def test_a_graph_with_a_mistake_is_hinted_as_far_as_missions_get() -> None:
    text = ALFALFA.replace("first -> judge when COMPLETED", "")
    found = [hint.text for hint in hints(Document(path="app.pluto", text=text))]
    assert "UNEXECUTED" in found and "nothing" in found


@pytest.mark.parametrize("text", ["", "pluto 1", "# only this", "pluto 1\napp x {\n  a ->\n}"])
def test_of_nothing_nothing_is_said(text: str) -> None:
    assert hover(Document(path="app.pluto", text=text), len(text)) is None


def test_a_default_is_told_as_an_app_writes_it() -> None:
    text = 'pluto 1\napp a {\n  action say(note: text = "a \\"b\\" \\\\") once\n}\n'
    found = hover(Document(path="a.pluto", text=text), text.index("note"))
    assert found is not None
    assert r'default "a \"b\" \\"' in found.markdown
