"""Promises of a plan: windows, deadlines, and missions that come after others."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from pluto_fleet.files.missions import misplaced
from pluto_fleet.jobs.reports import Down
from pluto_fleet.shared.alone.world import Faults
from pluto_fleet.shared.domain.status import FAILED, Status
from pluto_fleet.shared.flow.promises import kept_from
from pluto_fleet.shared.time.hours import Hours
from tests.kit import apps
from tests.kit.living import Living, enterable

HOUR, DAY = 3_600.0, 86_400.0


def short(name: str, **promises: Any) -> apps.Mission:
    """Return a mission of one trip of some ten seconds."""
    return apps.mission(name, apps.trip("1", 3.0), promises=promises)


def long(name: str, **promises: Any) -> apps.Mission:
    """Return a mission of one trip of some forty seconds."""
    return apps.mission(name, apps.trip("1", 15.0), promises=promises)


# After other missions


def test_a_mission_begins_when_all_that_it_comes_after_have_completed() -> None:
    missions = long("a"), short("b"), short("c", after=["a", "b"])
    outcome = apps.flown(*missions, on=apps.TWO)
    ended, begun = apps.moments(outcome, "mission.ended"), apps.moments(outcome, "mission.created")
    assert begun["c"] == ended["a"] > ended["b"] > begun["b"] == 0.0
    assert outcome.completed


@pytest.mark.parametrize("order", [("a", "b"), ("b", "a")])
def test_a_mission_fails_at_once_that_comes_after_one_that_has_failed(
    order: tuple[str, str],
) -> None:
    missions = short("a"), long("b"), short("c", after=[*order]), short("d", after=["c"])
    outcome = apps.flown(*missions, on=apps.TWO, faults=Faults(action=1.0))
    a, b, c, d = outcome.missions
    ended = apps.moments(outcome, "mission.ended")
    assert [a.status, b.status, c.status, d.status] == [FAILED] * 4
    assert c.reason == 'it comes after mission "a", which is FAILED'
    assert d.reason == 'it comes after mission "c", which is FAILED'
    assert ended["a"] == ended["c"] == ended["d"] < ended["b"]
    assert set(apps.moments(outcome, "trip.launched")) == {"a", "b"}


def test_a_mission_whose_predecessor_is_cancelled_while_it_is_paused_is_told_so() -> None:
    """Nothing else was under way meanwhile."""
    living = Living(enterable(), long("a"), short("b", after=["a"]))
    living.at(5.0, lambda: living.life.control.pause("a"))
    living.at(8.0, lambda: living.life.control.cancel("a"))
    assert living.run() == ["CANCELLED", "FAILED"]


# Windows


def test_a_mission_begins_when_its_window_opens() -> None:
    outcome = apps.flown(short("a", opens=100.0, deadline=200.0))
    assert apps.moments(outcome, "trip.launched") == {"a": 100.0}
    assert not outcome.missions[0].late


def test_a_window_and_what_a_mission_comes_after_must_both_be_met() -> None:
    missions = long("a"), short("b", after=["a"], opens=1.0), short("c", after=["a"], opens=200.0)
    outcome = apps.flown(*missions, on=apps.TWO)
    begun = apps.moments(outcome, "mission.created")
    assert begun["b"] == apps.moments(outcome, "mission.ended")["a"]
    assert begun["c"] == 200.0


@given(
    now=st.floats(0, 10 * DAY),
    of_day=st.floats(0, DAY, exclude_max=True),
    opens=st.integers(0, 23),
    hours=st.integers(1, 23),
)
def test_a_window_that_has_opened_today_is_open(
    now: float, of_day: float, opens: int, hours: int
) -> None:
    written = {"opens": f"{opens}:00", "deadline": f"{(opens + hours) % 24}:00"}
    kept = kept_from(written, Hours(of_day - now), now)
    assert kept["deadline"] - kept["opens"] == pytest.approx(hours * HOUR)
    assert now <= kept["deadline"] <= now + DAY
    assert (kept["deadline"] - now + of_day) % DAY == pytest.approx(
        (opens + hours) % 24 * HOUR, abs=1e-3
    ) or of_day == pytest.approx((opens + hours) % 24 * HOUR, abs=1e-3)


@pytest.mark.parametrize("closes", ["08:00", "8:00", "08:00:00"])
def test_what_is_due_at_this_very_hour_is_due_tomorrow(closes: str) -> None:
    """A deadline at once could never be kept; a simulation starts at midnight, and "00:00" is the one to come."""
    at_eight = Hours(8 * HOUR - 5.0)
    due = {"deadline": 5.0 + DAY, "hours": {"deadline": closes}}
    assert kept_from({"deadline": closes}, at_eight, 5.0) == due
    window = kept_from({"opens": "07:00", "deadline": closes}, at_eight, 5.0)
    assert (window["opens"], window["deadline"]) == (5.0 + 23 * HOUR, 5.0 + DAY)
    assert kept_from({"opens": closes, "deadline": "09:00"}, at_eight, 5.0)["opens"] == 5.0
    assert kept_from({"deadline": 0.0}, at_eight, 5.0) == {"deadline": 5.0}


# Deadlines


def test_a_mission_that_has_not_ended_at_its_deadline_is_late_once() -> None:
    outcome = apps.flown(long("a", deadline=10.0))
    (late,) = apps.events(outcome, "mission.late")
    assert (late["t"], late["mission"], late["deadline"]) == (10.0, "a", 10.0)
    assert outcome.missions[0].late and outcome.completed


def test_what_ends_at_its_very_deadline_is_in_time() -> None:
    (whole,) = apps.moments(apps.flown(long("a")), "mission.ended").values()
    at_it = apps.flown(long("a", deadline=whole))
    before = apps.flown(long("a", deadline=whole - 0.01))
    assert (at_it.missions[0].late, before.missions[0].late) == (False, True)


def test_the_promises_of_a_mission_are_seconds_from_its_start() -> None:
    living = Living(enterable(), short("a"), long("z"))
    living.at(20.0, lambda: living.life.add([short("b", deadline=5.0)]))
    living.run()
    assert living.times("mission.late") == [25.0]


@pytest.mark.parametrize("fail_late", [False, True])
def test_whether_a_late_mission_fails_is_said_at_its_allocator(fail_late: bool) -> None:
    missions = long("a"), long("b", deadline=20.0)
    outcome = apps.flown(*missions, fail_late=fail_late)
    _, late = outcome.missions
    assert late.late
    if fail_late:
        assert (late.status, late.attempts) == (FAILED, 0)
        assert late.reason == "it is late: trip 1 had no drone by its deadline"
        assert apps.moments(outcome, "mission.ended")["b"] == 20.0
    else:
        assert late.status is Status.COMPLETED


def test_a_late_mission_is_not_called_back_from_its_flight() -> None:
    mission = apps.mission("a", *(apps.trip(f"{n}", 15.0) for n in (1, 2)))
    mission.promises = {"deadline": 20.0}
    outcome = apps.flown(mission, fail_late=True)
    assert len(apps.events(outcome, "trip.completed")) == 1
    assert mission.reason == "it is late: its deadline has passed before trip 2"


def test_a_late_mission_with_an_item_aboard_goes_on() -> None:
    mission = apps.mission("a", apps.pick("p", 15.0), apps.release("r", 3.0))
    mission.promises = {"deadline": 20.0}
    outcome = apps.flown(mission, fail_late=True)
    assert outcome.completed and mission.late


@pytest.mark.parametrize(("name", "value"), [("deadline", "soon"), ("late", 1), ("promises", None)])
def test_a_hook_that_spoils_a_promise_fails_its_own_mission(name: str, value: object) -> None:
    def spoil(mission: apps.Mission, context: object) -> None:
        if mission.name == "bad":
            setattr(mission, name, value)

    missions = long("bad", deadline=500.0), short("good", deadline=500.0)
    app = apps.app(apps.flow(prepare=spoil, fail_late=True))
    bad, good = apps.fly(app, *missions, on=apps.TWO).missions
    assert (bad.status, good.status) == (FAILED, Status.COMPLETED)
    assert f"mission.{name} is set by the app alone" in bad.reason


# After any end


def plan() -> list[apps.Mission]:
    return [
        long("a", deadline=20.0),
        short("b", after=["a"], deadline=90.0),
        short("c", opens=60.0, deadline=500.0),
        long("d", after=["b", "c"], deadline=120.0),
    ]


def judged(living: Living) -> None:
    """Hold that missions began in their order, and that those are late that ended after their deadlines."""
    assert living.run() == ["COMPLETED"] * 4
    ended = {str(one["mission"]): float(str(one["t"])) for one in living.named("mission.ended")}
    launched: dict[str, float] = {}
    for one in living.named("trip.launched"):
        launched.setdefault(str(one["mission"]), float(str(one["t"])))
    assert launched["b"] >= ended["a"] and launched["c"] >= 60.0
    assert launched["d"] >= max(ended["b"], ended["c"])
    due = {"a": 20.0, "b": 90.0, "c": 500.0, "d": 120.0}
    late = sorted(str(one["mission"]) for one in living.named("mission.late"))
    assert late == sorted(name for name, when in due.items() if ended[name] > when)
    for mission in living.life.missions:
        assert mission.late == (mission.name in late)
        assert mission.promises["deadline"] == due[mission.name]


INTERRUPTED: list[Callable[[Living, float], None]] = [
    lambda living, moment: living.crash(moment),
    lambda living, moment: living.crash(moment, down=50.0),
    lambda living, moment: living.stop(moment, Down.HOME),
    lambda living, moment: living.stop(moment, Down.LAND, rest=50.0),
]


@pytest.mark.parametrize("interrupt", INTERRUPTED)
@pytest.mark.parametrize("moment", [0.5, 19.9, 61.0, 119.5, 130.0])
def test_promises_are_judged_the_same_after_any_end(
    moment: float, interrupt: Callable[[Living, float], None]
) -> None:
    living = Living(enterable(), *plan(), on=apps.TWO)
    interrupt(living, moment)
    judged(living)


# The order of a plan


def wrong(**after: list[str]) -> list[tuple[int, str]]:
    """Return what is wrong with the order of missions."""
    return [*misplaced([short(name, after=names) for name, names in after.items()], {"known"})]


def test_each_mistake_of_an_order_is_told_once() -> None:
    assert wrong(a=["b"], b=["x"]) == [(1, 'comes after "x", and there is no such mission')]
    assert wrong(a=["a"], b=["a"]) == [(0, "comes after itself: it can never begin")]
    (told,) = wrong(behind=["a"], a=["b"], b=["c"], c=["a"])
    assert told[1] == (
        'comes after "b", which comes after "c", which comes after "a": none of them can begin'
    )


@given(st.data())
def test_orders_that_are_accepted_come_to_their_end(data: st.DataObject) -> None:
    names = [f"{n}" for n in range(6)]
    after = {name: data.draw(st.lists(st.sampled_from(names), max_size=2)) for name in names}
    done: set[str] = set()
    for _ in names:
        done |= {name for name in names if done >= {*after[name]}}
    assert (wrong(**after) == []) == (len(done) == len(names))
