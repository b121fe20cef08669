"""Hover: a sentence for everything that has a name, and why a status cannot pass."""

from __future__ import annotations

import pytest

from plutoc.emit.hooks_file import MISSION_OFFERS, TRIP_OFFERS
from plutoc.emit.stubs import EXPORTS
from plutoc.service.document import Document
from plutoc.service.hooks.help import hover as hover_in_hooks
from plutoc.service.hooks.types import types_of
from plutoc.service.reading.hints import hints
from plutoc.service.reading.hover import hover
from tests.paths import ROOT

EXAMPLES = ROOT / "examples"
ALFALFA = (EXAMPLES / "alfalfa" / "app.pluto").read_text(encoding="utf-8")
WHOLE = Document(path="app.pluto", text=ALFALFA)
HOOKS = (EXAMPLES / "alfalfa" / "hooks.py").read_text(encoding="utf-8")


def test_every_name_of_every_example_is_explained() -> None:
    for path in sorted(EXAMPLES.glob("*/app.pluto")):
        document = Document(path=str(path), text=path.read_text(encoding="utf-8"))
        for one in document.names:
            assert hover(document, one.span.start), one


def test_each_arrow_is_hinted_with_what_passes() -> None:
    found = {
        (ALFALFA[: hint.offset].rpartition("\n")[2].strip()): hint.text for hint in hints(WHOLE)
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


def test_all_that_hooks_are_promised_is_offered() -> None:
    types = types_of(WHOLE.graph)
    for name, offers in (("Mission", MISSION_OFFERS), ("Trip", TRIP_OFFERS)):
        promised = set(offers.split("`")[1::2])
        assert promised <= {member.name for member in types[name].members}
    assert EXPORTS.keys() <= types.keys()
    assert all(types[name].doc for name in EXPORTS)


def test_hover_says_the_type_and_the_doc() -> None:
    def said(place: str) -> str:
        found = hover_in_hooks(WHOLE, HOOKS, HOOKS.index(place) + len(place) - 1)
        return found.markdown if found else ""

    assert "Wait this many seconds" in said("context.sleep")
    assert "evaluator find_blooms" in said("def find_blooms")
    assert "context: Context" in said("await context")
    assert "An evaluator's verdict" in said("return Verdict")
