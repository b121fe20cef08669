"""Those who wait, by what they ask of a drone's battery: as if each had been asked."""

from __future__ import annotations

from dataclasses import dataclass, field
from math import inf

from hypothesis import given
from hypothesis import strategies as st

from plutoc_runtime.model import Category, Drone, Point
from plutoc_runtime.thresholds import Thresholds
from tests.runtime import apps


@dataclass
class Standing:
    """The telemetry of a drone that a test charges and moves."""

    location: Point = (0.0, 0.0, 0.0)
    battery_level: float = 0.5
    landed: bool = True
    silence: float = 0.0


@dataclass(eq=False)
class Waiting:
    """Somebody who asks for more, the farther away the drone stands."""

    asks: float
    waits: bool = True
    asked: int = field(default=0)

    def level(self, drone: Drone) -> float:
        """Count how often that is found out."""
        self.asked += 1
        return self.asks + drone.location[0]


Entry = tuple[int, int, Waiting]


def drone(standing: Standing) -> Drone:
    return Drone(id="cf1", category=Category(name="scout"), home=(0, 0, 0), telemetry=standing)


def least_of(entries: list[Entry], one: Drone) -> float:
    return min((e[2].asks + one.location[0] for e in entries if e[2].waits), default=inf)


LEVEL = st.one_of(st.sampled_from([0.3, 0.5, 0.7, inf]), st.floats(0, 1))
STEPS = st.lists(
    st.one_of(
        st.tuples(st.just("come"), LEVEL),
        st.tuples(st.just("go"), st.integers(0, 200)),
        st.tuples(st.just("ask"), LEVEL.filter(lambda level: level < inf)),
        st.tuples(st.just("move"), st.sampled_from([0.0, 0.25])),
    ),
    max_size=150,
)


@given(STEPS, st.integers(0, 90))
def test_the_answer_is_that_of_asking_everybody(steps: list[tuple[str, float]], first: int) -> None:
    """However many come and go, wherever the drone stands and whatever it has."""
    standing = Standing()
    one, thresholds = drone(standing), Thresholds[Waiting]()
    entries: list[Entry] = [(0, n, Waiting(n % 7 / 7)) for n in range(first)]
    for what, number in steps:
        if what == "come":
            entries.append((0, len(entries), Waiting(number)))
            thresholds.add(entries[-1])
        elif what == "go" and entries:
            entries[int(number) % len(entries)][2].waits = False
        elif what == "move":
            standing.location = (number, 0.0, 0.0)
        elif what == "ask":
            standing.battery_level = number
            met = sorted(entry[1] for entry in thresholds.met(one, entries))
            assert met == [
                entry[1]
                for entry in entries
                if entry[2].waits and entry[2].asks + one.location[0] <= number
            ]
        assert thresholds.least(one, entries) == least_of(entries, one)


def test_nobody_is_asked_twice_of_the_same_drone_at_the_same_place() -> None:
    one, thresholds = drone(Standing()), Thresholds[Waiting]()
    entries: list[Entry] = [(0, n, Waiting(n / 100)) for n in range(100)]
    for _ in range(5):
        assert thresholds.least(one, entries) == 0.0
        assert len(list(thresholds.met(one, entries))) == 51
    assert {entry[2].asked for entry in entries} == {1}


def test_after_nobody_has_waited_all_begins_anew() -> None:
    one, thresholds = drone(Standing()), Thresholds[Waiting]()
    assert thresholds.least(one, [(0, 1, Waiting(0.2))]) == 0.2
    thresholds.kept.clear()
    assert thresholds.least(one, []) == inf


def test_many_who_wait_are_served_in_their_order_by_drones_that_must_charge() -> None:
    """More wait than are asked one by one: each drone goes to the first for whom it is enough."""
    far = [apps.mission(f"far{n}", apps.trip("A", 19.0), apps.trip("B", 18.0)) for n in range(20)]
    near = [apps.mission(f"near{n}", apps.trip("A", 1.0 + n / 10)) for n in range(20)]
    fleet = apps.fleet((0.5, 0.5, 0.0), (0.5, 2.5, 0.0))
    outcome = apps.fly(apps.app(apps.flow()), *far, *near, on=fleet)
    assert outcome.completed
    given = [str(e["mission"]) for e in apps.events(outcome, "trip.allocated")]
    nears = [name for name in given if name.startswith("near")]
    assert nears == [mission.name for mission in near]
    assert given.index("near19") < given.index("far15"), "they need not wait until it is charged"
