"""What came of the events of an app, by its trace."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from pluto_fleet.report.reactions import Reactions, reactions_of


def raised(id: str, when: float, made: str | None = None) -> list[Mapping[str, Any]]:
    """Return the entries of an occurrence, and of the mission that is made of it."""
    over = {"why": "it burns already"} if made is None else {"made": made}
    return [
        {"t": when, "event": "event.raised", "id": id, "kind": "smoke", "raised": when},
        {"t": when, "event": "event.over", "id": id, **over},
    ]


def promised(mission: str, deadline: float) -> Mapping[str, Any]:
    return {"t": 0.0, "event": "mission.promised", "mission": mission, "deadline": deadline}


def ended(mission: str, when: float, status: str = "COMPLETED") -> Mapping[str, Any]:
    return {"t": when, "event": "mission.ended", "mission": mission, "status": status}


def late(mission: str, when: float) -> Mapping[str, Any]:
    return {"t": when, "event": "mission.late", "mission": mission}


def handed_over(away: float) -> Mapping[str, Any]:
    return {"t": 9.0, "event": "trip.handed_over", "mission": "m", "away": away, "reach": 0.5}


def test_a_bound_is_kept_only_by_what_was_completed_in_time() -> None:
    trace = [
        *raised("a", 1.0, "soon"),
        promised("soon", 5.0),
        *raised("b", 2.0, "late"),
        promised("late", 5.0),
        *raised("c", 3.0, "failed"),
        promised("failed", 9.0),
        *raised("d", 4.0, "unbound"),
        *raised("e", 4.0),
        ended("soon", 4.0),
        late("late", 5.0),
        ended("failed", 6.0, "FAILED"),
        ended("late", 12.0),
        ended("unbound", 24.0),
    ]
    smoke = reactions_of(trace).events["smoke"]
    assert (smoke.raised, smoke.missions) == (5, 4)
    assert smoke.seconds == [3.0, 10.0, 20.0]
    assert (smoke.promised, smoke.kept) == (3, 1)


def test_missions_of_no_event_are_not_counted() -> None:
    """Nor of one that is not in this trace."""
    trace = [
        promised("patrol", 5.0),
        {"t": 1.0, "event": "event.over", "id": "before", "made": "m"},
        ended("patrol", 1.0),
        ended("m", 2.0),
    ]
    found = reactions_of(trace)
    assert found.data() == {}
    assert [*found.lines()] == []


def test_who_takes_over_from_further_than_within_reach_leaves_a_gap() -> None:
    found = Reactions()
    found.add(reactions_of([handed_over(0.5), handed_over(0.2)]))
    found.add(reactions_of([handed_over(0.75)]))
    (line,) = found.lines()
    assert line == "3 hand-overs, 2 without a gap: who took over was at most 0.75 m away"


def test_several_runs_are_told_as_one() -> None:
    found = Reactions()
    for when in (2.0, 4.0):
        found.add(reactions_of([*raised("a", 1.0, "m"), promised("m", 3.0), ended("m", when)]))
    header, row = found.lines()
    assert header.split("  ")[-1] == "bounds kept"
    assert row.split() == ["smoke", "2", "2", "2", "2", "s", "2.9", "s", "2", "of", "2"]
