"""Help in hooks.py: what missions, trips, drones and the rest offer, in a file that is being typed."""

from __future__ import annotations

from plutoc.emit.hooks_file import MISSION_OFFERS, TRIP_OFFERS
from plutoc.emit.stubs import EXPORTS
from plutoc.service.document import Document
from plutoc.service.hooks.help import hover
from plutoc.service.hooks.types import types_of
from tests.compiler.service.test_hover import ALFALFA, EXAMPLES

DOCUMENT = Document(path="app.pluto", text=ALFALFA)
HOOKS = (EXAMPLES / "alfalfa" / "hooks.py").read_text(encoding="utf-8")


"""What only packages offer whose app has a policy."""


def test_all_that_hooks_are_promised_is_offered() -> None:
    types = types_of(DOCUMENT.graph)
    for name, offers in (("Mission", MISSION_OFFERS), ("Trip", TRIP_OFFERS)):
        promised = set(offers.split("`")[1::2])
        assert promised <= {member.name for member in types[name].members}
    assert EXPORTS.keys() <= types.keys()
    assert all(types[name].doc for name in EXPORTS)


def test_hover_says_the_type_and_the_doc() -> None:
    def said(place: str) -> str:
        found = hover(DOCUMENT, HOOKS, HOOKS.index(place) + len(place) - 1)
        return found.markdown if found else ""

    assert "Wait this many seconds" in said("context.sleep")
    assert "evaluator find_blooms" in said("def find_blooms")
    assert "context: Context" in said("await context")
    assert "An evaluator's verdict" in said("return Verdict")
