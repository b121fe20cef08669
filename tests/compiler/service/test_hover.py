"""Hover: a sentence for everything that has a name, and why a status cannot pass."""

from __future__ import annotations

import pytest

from plutoc.service.document import Document
from plutoc.service.reading.hints import hints
from plutoc.service.reading.hover import hover
from tests.paths import ROOT

EXAMPLES = ROOT / "examples"
ALFALFA = (EXAMPLES / "alfalfa" / "app.pluto").read_text(encoding="utf-8")


def test_every_name_of_every_example_is_explained() -> None:
    for path in sorted(EXAMPLES.glob("*/app.pluto")):
        document = Document(path=str(path), text=path.read_text(encoding="utf-8"))
        for one in document.names:
            assert hover(document, one.span.start), one


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
