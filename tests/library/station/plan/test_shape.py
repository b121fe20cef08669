"""What a page may send: every shape but the one that plans have is refused, in words; an app may have fields."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from pluto_fleet.files.fleet import default_fleet
from pluto_fleet.shared.domain.errors import BadInput
from pluto_fleet.station.config import StationConfig, described
from pluto_fleet.station.map.drawn import DrawnMap
from pluto_fleet.station.plan.plan import MissionPlan, Stale
from pluto_fleet.station.plan.shape import MOST_MISSIONS, MOST_TRIPS
from tests.kit.apps import example
from tests.library.files.an_app import OWN
from tests.library.station.plan.drawing import Json, a_plan, mission, said, trip

SCALARS = st.one_of(
    st.none(), st.booleans(), st.integers(), st.floats(), st.text(max_size=5), st.just("\ud800")
)
KEYS = st.one_of(
    st.sampled_from(["key", "name", "launched", "trips", "action", "target", "item", "delay"]),
    st.text(max_size=3),
)
ANYTHING = st.recursive(
    SCALARS, lambda inner: st.lists(inner, max_size=3) | st.dictionaries(KEYS, inner, max_size=4)
)


def refused(missions: object) -> str:
    plan = a_plan()
    before = plan.data()
    with pytest.raises(BadInput) as caught:
        plan.replace(plan.revision, missions)
    assert plan.data() == before
    return str(caught.value)


def test_a_plan_has_an_end() -> None:
    """So many missions, and so many trips in all."""
    many = [mission(f"mission-{i}") for i in range(MOST_MISSIONS)]
    assert refused([*many, mission()]) == f"a plan has at most {MOST_MISSIONS} missions"
    trips = [trip(f"trip-{i:05}") for i in range(MOST_TRIPS + 1)]
    assert refused([mission("mission-one", *trips)]) == f"a plan has at most {MOST_TRIPS} trips"


def test_what_is_not_given_needs_no_key() -> None:
    """Pages may leave a field out, or say null."""
    plan, other = a_plan(), a_plan()
    plan.replace(plan.revision, [mission()])
    nothing: Json = dict.fromkeys(("name", "source", "item", "parameters", "delay"))
    full = mission("mission-one", trip("mission-one-trip", **nothing), safe_time=None)
    other.replace(other.revision, [full])
    assert plan.data() == other.data()


@given(st.data(), ANYTHING)
@settings(max_examples=60, derandomize=True, deadline=None)
def test_a_plan_with_anything_in_one_place_is_taken_or_refused(
    data: st.DataObject, anything: Any
) -> None:
    """No JSON raises anything else; what is taken is taken again, and its problems are sentences."""
    missions = [mission()]
    place = data.draw(st.sampled_from([missions[0], missions[0]["trips"][0]]))
    place[data.draw(st.sampled_from([*place, "item", "parameters"]))] = anything
    plan = a_plan()
    try_to(plan, anything, missions)
    try_to(plan, plan.revision, missions)
    try_to(plan, plan.revision, plan.data()["missions"])
    assert all(text for *_, text in said(plan))


def try_to(plan: MissionPlan, revision: object, missions: object) -> None:
    try:
        plan.replace(revision, missions)
    except (BadInput, Stale) as error:
        assert str(error).isprintable()


OWN_FLEET = default_fleet(OWN)
OWN_TRIP = {"action": "measure", "fragile": False, "warmth": "21 C"}


def test_a_page_learns_of_them_with_their_types_and_units(tmp_path: Path) -> None:
    config = StationConfig(folder=tmp_path, fleet=OWN_FLEET, faults={})
    fields: Any = described(OWN, config, DrawnMap(OWN_FLEET.airspace, config.map_path), "x")[
        "fields"
    ]
    by_name = {one["name"]: one for on in ("mission", "trip") for one in fields[on]}
    assert by_name["patient"] == {
        "name": "patient",
        "type": "text",
        "label": "Patient",
        "default": None,
        "own": True,
        "needed": True,
        "units": [],
    }
    assert by_name["margin"]["units"] == ["ms", "s", "min", "h"]
    assert (by_name["margin"]["default"], by_name["margin"]["needed"]) == (600.0, False)
    assert by_name["delay"] == {"name": "delay", "type": "time", "label": "delay", "default": None}
    json.dumps(fields)


def test_a_value_of_each_type_can_be_typed() -> None:
    """As a person writes it; it is launched in SI units."""
    typed = {"patient": "Ada", "margin": "3 min", "share": "40 %", "urgent": True}
    plan = MissionPlan(OWN, OWN_FLEET, None)
    plan.replace(plan.revision, [mission("mission-one", trip("trip-one-1", **OWN_TRIP), **typed)])
    assert said(plan) == []
    (made,), _ = plan.launchable()
    ready: Any = made
    assert (ready.patient, ready.margin, ready.share, ready.urgent) == ("Ada", 180.0, 0.4, True)
    (flown,) = ready.trips
    assert (flown.fragile, flown.warmth, flown.layers, flown.note) == (False, 294.15, 1, "")


@pytest.mark.parametrize(("name", "retries"), [("alfalfa", True), ("drugs_distribution", False)])
def test_a_page_is_told_the_graph_as_the_package_has_it(
    name: str, retries: bool, tmp_path: Path
) -> None:
    """And whether a failed trip may lead on in it."""
    made = example(name)
    config = StationConfig(folder=tmp_path, fleet=made.fleet, faults={})
    shown = described(made.app, config, DrawnMap(made.fleet.airspace, config.map_path), "x")
    file = made.package / "src" / name / "graph.json"
    assert shown["graph"] == json.loads(file.read_text(encoding="utf-8"))
    assert shown["retries"] is retries


def test_an_app_that_plutoc_did_not_write_has_no_graph(tmp_path: Path) -> None:
    config = StationConfig(folder=tmp_path, fleet=OWN_FLEET, faults={})
    assert (
        described(OWN, config, DrawnMap(OWN_FLEET.airspace, config.map_path), "x")["graph"] is None
    )
