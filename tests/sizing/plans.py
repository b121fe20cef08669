"""Plans to be sized: by chance, and such whose answer is known."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from random import Random
from typing import Any

from pluto_fleet.app import App
from pluto_fleet.files.fleet import FleetFile
from pluto_fleet.files.plan_check import unflyable
from pluto_fleet.shared.alone.world import Faults
from pluto_fleet.shared.domain.airspace import Airspace
from pluto_fleet.shared.domain.app import moving
from pluto_fleet.shared.domain.model import Category, Item
from pluto_fleet.shared.domain.motion import CRAZYFLIE
from pluto_fleet.sizing.answer import Answer, sized
from pluto_fleet.sizing.fleets import Stock
from pluto_fleet.sizing.question import Question
from pluto_fleet.sizing.tries import Rule, flown, usual_runs
from tests.kit.apps import Mission, Trip, app, fleet, flow, mission, pick, release, trip

CONFIDENCE = 0.99
"""Of the plans by chance."""

FRESH = 1_000
"""Runs with other seeds in which a promise must hold."""

_SIDE = 12.0


@dataclass(frozen=True, kw_only=True)
class Plan:
    """A question, and the fleets that may be the answer."""

    question: Question
    fleet: FleetFile
    most: int = 12

    @property
    def stock(self) -> Stock:
        """Its fleets."""
        return Stock(fleet=self.fleet, missions=self.question.missions, most=self.most)


def sized_plan(plan: Plan, *, confidence: float, seed: int = 0, jobs: int = 1) -> Answer:
    """Return the answer to a plan."""
    rule = Rule(confidence=confidence, runs=usual_runs(confidence))
    return sized(plan.question, plan.stock, rule, seed=seed, jobs=jobs, watch=lambda _: None)


def fresh_share(answer: Answer, *, runs: int, seed: int, jobs: int) -> float:
    """Return which share of fresh runs of a promised fleet succeeds."""
    assert answer.found is not None
    promised = answer.stock.of(answer.found.counts)
    assert promised is not None
    again = flown(answer.question, promised, seed, 0, runs, jobs)
    return sum(run.success for run in again) / runs


# By chance


def by_chance(number: int) -> Plan:
    """Return a plan with missions, categories, mishaps and a time that are drawn."""
    chance = Random(f"sizing/{number}")
    categories = _categories(chance)
    drawn = app(flow(attempts=3), categories=categories)
    missions = [_mission(chance, place) for place in range(chance.randint(1, 5))]
    homes = [(1.0 + place, 0.8, 0.0) for place in range(len(categories) * 2)]
    file = fleet(*homes, categories=[one.name for one in categories])
    file = replace(
        file,
        airspace=Airspace(size=(_SIDE, _SIDE)),
        apart=0.5,
        motion=replace(CRAZYFLIE, spread=chance.choice((0.01, 0.05, 0.1))),
    )
    drawn = moving(drawn, file.motion)
    if unflyable(missions, drawn, file, file.airspace):
        return by_chance(number + 1_000_000)
    crash, link = chance.choice((0.0, 0.0, 0.0003, 0.002)), chance.choice((0.0, 0.001, 0.004))
    question = Question(app=drawn, missions=missions, faults=Faults(crash=crash, link=link))
    whole = Plan(question=question, fleet=file)
    time = _time(chance, whole)
    return (
        replace(whole, question=replace(question, by=time))
        if time
        else by_chance(number + 1_000_000)
    )


def without_chance(number: int) -> Plan:
    """Return such a plan in which every run is the same."""
    plan = by_chance(number)
    still = replace(plan.fleet, motion=replace(plan.fleet.motion, spread=0.0, action_spread=0.0))
    return replace(plan, fleet=still, question=replace(plan.question, faults=Faults()))


def smallest_by_trying_all(plan: Plan) -> int | None:
    """Return the size of the smallest fleet of a plan without chance, by flying every one."""
    stock = plan.stock
    for total in range(1, plan.most + 1):
        for counts in _compositions(total, len(stock.kinds)):
            one = stock.of(counts)
            if one is not None and plan.question.fly(one, 0).success:
                return total
    return None


def _compositions(total: int, parts: int) -> list[tuple[int, ...]]:
    if parts == 1:
        return [(total,)]
    return [(n, *rest) for n in range(total + 1) for rest in _compositions(total - n, parts - 1)]


def _categories(chance: Random) -> Sequence[Category]:
    flight_time, charge_time = chance.choice((90.0, 420.0)), chance.choice((120.0, 1200.0))
    battery: dict[str, Any] = {"flight_time": flight_time, "charge_time": charge_time}
    carrier = Category(name="carrier", speed=chance.choice((0.6, 0.9)), **battery)
    if chance.random() < 0.5:
        return [carrier]
    return [
        Category(name="scout", actions=frozenset({"take_photo", "measure"}), **battery),
        carrier,
    ]


def _mission(chance: Random, index: int) -> Mission:
    trips: list[Trip] = []
    for number in range(chance.randint(1, 3)):
        x, y = (round(chance.uniform(2.0, _SIDE - 1.0), 1) for _ in "xy")
        action = chance.choice(("take_photo", "measure", "pick_item"))
        parameters = {"quantity": "temperature"} if action == "measure" else {}
        item = Item(name=f"box {number}", mass=0.004) if action == "pick_item" else None
        trips.append(trip(f"{len(trips)}", x, y, action, parameters=parameters, item=item))
        if item is not None:
            trips.append(trip(f"{len(trips)}", y, x, "release_item", item=item))
    return mission(f"M{index}", *trips, index=index)


def _time(chance: Random, plan: Plan) -> float | None:
    """Return a time that some fleet needs, more or less; None: no time is enough for it."""
    counts = tuple(chance.randint(1, 2) for _ in plan.stock.kinds)
    on = plan.stock.of(counts)
    assert on is not None
    calm = replace(plan.question, faults=Faults())
    run = calm.fly(on, 0)
    return run.seconds * chance.uniform(0.8, 1.3) if run.success else None


# Whose answer is known


@dataclass(frozen=True, kw_only=True)
class Known:
    """A plan, and what must be said of it."""

    name: str
    plan: Plan
    drones: int | None = None
    """How many it needs; None: no number is enough."""
    cause: str = ""
    """The kind of the first cause, if so."""
    said: str = ""
    """What it says, among others."""

    def wrong(self, answer: Answer) -> str:
        """Say how an answer differs from this one."""
        drones = answer.found and answer.found.drones
        if drones != self.drones:
            return f"it says {drones} drones and not {self.drones}"
        if drones is None and (not answer.causes or answer.causes[0].what != self.cause):
            return f"it says that the cause is {answer.causes[:1]} and not {self.cause}"
        if drones is None and self.said not in answer.causes[0].text:
            return f"it says {answer.causes[0].text!r} and not {self.said!r}"
        return ""


def _straight(
    *missions: Mission, by: float | None, most: int = 12, tested: App | None = None, **more: Any
) -> Plan:
    """Return a plan of drones that fly straight and exactly."""
    faults = more.pop("faults", Faults())
    on = more.pop("on", None) or fleet((1.0, 0.5, 0.0), (2.0, 0.5, 0.0))
    for index, each in enumerate(missions):
        each.index = index
    question = Question(app=tested or app(flow()), missions=missions, faults=faults, by=by)
    return Plan(question=question, fleet=replace(on, **more), most=most)


def _there(count: int, far: float = 15.0) -> list[Mission]:
    """Return missions of one trip each, all as far away."""
    return [mission(f"M{n}", trip("A", far, 1.0 + 1.5 * n)) for n in range(count)]


def known() -> list[Known]:
    """Return the plans whose answer is known.

    One trip to 15 m takes about half a minute at 0.5 m/s, and as long again the way back.
    """
    slow = Category(name="scout", flight_time=100.0, charge_time=2000.0)
    boxes = [mission(f"M{n}", pick("A", 5.0 + n), release("B", 8.0 + n)) for n in range(2)]
    photo = Category(name="scout", actions=frozenset({"take_photo"}))
    return [
        Known(name="one for each", plan=_straight(*_there(5), by=50.0), drones=5),
        Known(
            name="of no category",
            plan=_straight(*boxes, by=None, tested=app(flow(), categories=[photo])),
            cause="reach",
            said="scout cannot pick_item",
        ),
        Known(
            name="not so many may fly",
            plan=_straight(*_there(6), by=50.0, max_airborne=2),
            cause="airborne",
            said="max_airborne = 2",
        ),
        Known(
            name="an item aboard",
            plan=_straight(*boxes, by=None, most=4, faults=Faults(crash=0.3)),
            cause="faults",
            said="an item aboard ends its mission",
        ),
        Known(
            name="batteries that charge for too long",
            plan=_straight(*_there(6), by=700.0, most=1, tested=app(flow(), categories=[slow])),
            cause="charging",
            said="--swap",
        ),
        Known(
            name="more than were allowed",
            plan=_straight(*_there(6), by=50.0, most=4),
            cause="drones",
            said="8 would do",
        ),
    ]
