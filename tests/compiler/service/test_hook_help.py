"""Help in hooks.py: what missions, trips, drones and the rest offer, in a file that is being typed."""

from __future__ import annotations

import pytest

from plutoc.emit.hooks_file import MISSION_OFFERS, TRIP_OFFERS
from plutoc.emit.stubs import EXPORTS
from plutoc.service.document import Document
from plutoc.service.hooks.help import complete, hover
from plutoc.service.hooks.types import types_of
from tests.compiler.service.test_hover import ALFALFA, EXAMPLES

DOCUMENT = Document(path="app.pluto", text=ALFALFA)
HOOKS = (EXAMPLES / "alfalfa" / "hooks.py").read_text(encoding="utf-8")


def labels(code: str) -> list[str]:
    """Complete where an `@` stands."""
    at = code.index("@")
    return [item.label for item in complete(DOCUMENT, code.replace("@", "", 1), at)]


@pytest.mark.parametrize(
    ("body", "wanted"),
    [
        ("mission.@", {"trips", "current", "repeat"}),
        ("mission.trips[0].@", {"target", "elapsed", "reset"}),
        ("mission.current.drone.@", {"id", "battery_level"}),
        ("for one in mission.trips:\n        one.@", {"target"}),
        ("last = mission.current\n    last.@", {"target"}),
        ("results.@", {"new", "all"}),
        ("for one in results.new:\n        one.@", {"trip", "value"}),
        ("if isinstance(results.new[0].value, Photo):\n        results.new[0].value.@", {"sees"}),
        ("return Verdict(@", {"ok=", "redo=", "fail="}),
        ("Status.@", {"STANDBY"}),
        ('f"{mission.@', {"trips"}),
        ("mis@", {"mission"}),
    ],
)
def test_an_evaluator_is_helped(body: str, wanted: set[str]) -> None:
    """Its parameters are known by their types, and without any by their places."""
    for first_line in (
        "def find_blooms(mission: Mission, results: Results) -> Verdict:",
        "def find_blooms(mission, results):",
    ):
        assert wanted <= set(labels(f"{HOOKS[:600]}\n\n{first_line}\n    {body}"))


def test_what_arrives_by_place_may_have_any_name() -> None:
    code = "def find_blooms(what, seen):\n    what.@\n"
    assert "trips" in labels(code)
    code = "async def pollinate(machine, flight, app, *, dose):\n    await app.live(machine).@\n"
    assert {"read", "write", "position"} <= set(labels(code))


def test_a_hook_that_lacks_is_offered_whole() -> None:
    (item,) = complete(DOCUMENT, "def find", len("def find"))
    assert item.insert.startswith("find_blooms(mission: Mission, results: Results) -> Verdict:\n")


FOR_POLICIES = {"Again", "Assignment", "Waiting"}
"""What only packages offer whose app has a policy."""


def test_what_can_be_imported_is_offered() -> None:
    assert set(labels("from . import @")) == set(EXPORTS) - FOR_POLICIES


WAREHOUSE = Document(
    path="app.pluto",
    text=(EXAMPLES / "warehouse_item_finder" / "app.pluto").read_text(encoding="utf-8"),
)


@pytest.mark.parametrize(
    ("code", "wanted"),
    [
        ("from . import @", set(EXPORTS)),
        ("def weakest_first(trip, candidates):\n    candidates[0].@", {"battery_level"}),
        ("def weakest_first(waiting, drones, now):\n    waiting[0].@", {"since", "deadline"}),
        ("def weakest_first(all, free, at):\n    for one in all:\n        one.drones[0].@", {"id"}),
        ("def weakest_first(all, free, at):\n    for one in all:\n        one.trip.@", {"target"}),
        ("def weakest_first(waiting, drones, now):\n    return Again(@", {"after=", "pairs="}),
    ],
)
def test_a_policy_of_either_shape_is_helped(code: str, wanted: set[str]) -> None:
    at = code.index("@")
    items = complete(WAREHOUSE, code.replace("@", "", 1), at)
    assert wanted <= {item.label for item in items}


@pytest.mark.parametrize("code", ["# mission.@", 'x = "mission.@"', "unknown.@", "1.@"])
def test_nothing_is_offered_where_nothing_is_known(code: str) -> None:
    assert labels(code) == []


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
