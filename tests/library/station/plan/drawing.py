"""Plans as a page would send them, sound ones and any others."""

from __future__ import annotations

import asyncio
from pathlib import Path
from typing import Any

from hypothesis import strategies as st

from pluto_fleet.files.fleet import FleetFile, default_fleet
from pluto_fleet.station.plan.plan import MissionPlan
from tests.library.files.an_app import APP

FLEET = default_fleet(APP)
"""Scouts, which see and measure, and carriers, on a plain of 20 × 20 m."""

Json = dict[str, Any]


def a_plan(keep: Path | None = None, fleet: FleetFile = FLEET, now: float = 0.0) -> MissionPlan:
    """Return an empty plan, or the one that is kept there; its revisions count from 1."""
    return MissionPlan(APP, fleet, keep, now=lambda: now)


def trip(key: str = "trip-one", **given: object) -> Json:
    """Return a trip that can be flown."""
    return {"key": key, "action": "take_photo", "target": [2, 3], **given}


def mission(key: str = "mission-one", *trips: Json, **given: object) -> Json:
    """Return a mission that can be flown."""
    return {"key": key, "name": key, "trips": list(trips or (trip(f"{key}-trip"),)), **given}


def drawn(*missions: Json, fleet: FleetFile = FLEET) -> MissionPlan:
    """Return a plan of these missions."""
    plan = a_plan(fleet=fleet)
    plan.replace(plan.revision, list(missions))
    return plan


def said(plan: MissionPlan) -> list[tuple[str | None, str | None, str | None, str]]:
    """Return what is said of a plan: mission, trip, field, sentence."""
    asyncio.run(plan.examined())
    problems: Any = plan.data()["problems"]
    return [(one["mission"], one["trip"], one["field"], one["text"]) for one in problems]


# Plans at random

TEXTS = st.text(max_size=12)
QUANTITIES = st.one_of(
    st.integers(0, 1000),
    st.floats(0, 1000),
    st.sampled_from(["3 min", "30 s", "1.5 h", "8 g", "40 mg", "20 %", "80 cm", ""]),
    TEXTS,
)
NAMES = st.one_of(TEXTS, st.sampled_from(["A", "B", "North field", "1", "2", "\x7f", "é\u2028"]))
METRES = st.one_of(st.integers(0, 20), st.floats(0, 20), st.floats(-1e12, 1e12))
PLACES = st.one_of(st.none(), st.lists(METRES, min_size=2, max_size=3))
ITEMS = st.one_of(
    st.none(), st.fixed_dictionaries({}, optional={"name": NAMES, "mass": QUANTITIES})
)
PARAMETERS = st.dictionaries(
    st.one_of(TEXTS, st.sampled_from(["dose", "quantity", "note", "gently"])),
    st.one_of(QUANTITIES, st.booleans()),
    max_size=3,
)
TRIPS = st.fixed_dictionaries(
    {"action": st.one_of(st.sampled_from(list(APP.actions)), TEXTS), "target": PLACES},
    optional={
        "name": st.one_of(st.none(), NAMES),
        "source": PLACES,
        "parameters": PARAMETERS,
        "item": ITEMS,
        "delay": QUANTITIES,
        "priority": st.integers(-3, 3),
    },
)
MISSIONS = st.fixed_dictionaries(
    {"name": NAMES, "trips": st.lists(TRIPS, max_size=4)},
    optional={
        "safe_time": QUANTITIES,
        "repeat": st.one_of(st.integers(0, 3), st.booleans()),
        "at": st.one_of(TEXTS, st.sampled_from(["08:00", "23:59:59"])),
        "evaluator": st.sampled_from(["find_blooms", "other", ""]),
    },
)


def keyed(missions: list[Json]) -> list[Json]:
    """Give each mission and trip a key of its own."""
    return [
        {
            **one,
            "key": f"mission-{i}",
            "trips": [{**t, "key": f"trip-{i}-{j:03}"} for j, t in enumerate(one["trips"])],
        }
        for i, one in enumerate(missions)
    ]


PLANS = st.lists(MISSIONS, max_size=4).map(keyed)

SOUND_TRIPS = st.fixed_dictionaries(
    {
        "action": st.sampled_from(["take_photo", "measure", "pollinate"]),
        "target": st.lists(st.one_of(st.integers(1, 19), st.floats(1, 9)), min_size=2, max_size=3),
    },
    optional={
        "delay": st.sampled_from([0, 2.5, "3 min", "0.1 h"]),
        "priority": st.integers(-3, 3),
        "source": st.just([0.5, 0.25]),
    },
).map(lambda one: {**one, "parameters": {"dose": "40 mg"}} if one["action"] == "pollinate" else one)
_WORDS = st.text(st.characters(codec="utf-8", exclude_categories=["C", "Z"]), min_size=1)
SOUND_PLANS = (
    st.lists(
        st.fixed_dictionaries(
            {
                "name": st.one_of(_WORDS, st.just('a "quoted" \\ name')),
                "trips": st.lists(SOUND_TRIPS, min_size=1, max_size=4),
            },
            optional={
                "safe_time": st.sampled_from([0, 90, 1.5e-5, "3 min"]),
                "repeat": st.sampled_from([0, 2, True]),
                "at": st.just("08:00"),
                "evaluator": st.just("find_blooms"),
            },
        ),
        max_size=4,
        unique_by=lambda one: one["name"],
    )
    .map(keyed)
    .filter(lambda missions: not said(drawn(*missions)))
)
