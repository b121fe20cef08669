"""Each example does what its page says that it does."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import pytest

from pluto_fleet.shared.domain.trace import Event
from tests.kit.apps import EXAMPLES, Example, example, loaded

SEEDS = range(6)


@pytest.fixture(scope="session")
def apps() -> Mapping[str, Example]:
    """Return the examples that these tests look into."""
    names = (
        *("aerial_mapping", "alfalfa", "drugs_distribution_retry", "night_round"),
        *("object_finder", "pm10", "warehouse_item_finder"),
    )
    return {name: example(name) for name in names}


def events(trace: Sequence[Event], kind: str, **facts: object) -> list[Event]:
    """Return the events of a kind, with these facts."""
    return [e for e in trace if e["event"] == kind and facts.items() <= e.items()]


def time(event: Event) -> float:
    """Return when an event was."""
    return float(str(event["t"]))


def test_keys_are_found_and_brought_once(apps: Mapping[str, Example]) -> None:
    """With photos of all kinds, what was seen comes home, and no other drone goes for it."""
    for seed in SEEDS:
        flown = apps["object_finder"].fly(seed)
        log = flown.outcome.log
        assert log.count("keys brought back") == log.count("book brought back") == 1
        assert log.count("keys not found here") == 1
        assert "keys seen: worktop" in log


def test_a_blurred_photo_is_taken_again(apps: Mapping[str, Example]) -> None:
    """A place is not given up because of a photo that shows nothing at all."""
    logs = [line for seed in SEEDS for line in apps["object_finder"].fly(seed).outcome.log]
    assert any("looking again, blurred photos: " in line for line in logs)


def test_lifters_carry_what_light_drones_cannot(apps: Mapping[str, Example]) -> None:
    """Weakest first: heavy items go with lifters, and the others do not."""
    flown = apps["warehouse_item_finder"].fly(0)
    carrier = {str(e["mission"]): str(e["drone"]) for e in events(flown.trace, "trip.launched")}
    assert carrier["battery"].startswith("lifter") and carrier["motor"].startswith("lifter")
    assert all(carrier[item].startswith("light") for item in ("screws", "fuse", "label", "sensor"))


def test_a_night_round_keeps_its_hours_and_its_order(apps: Mapping[str, Example]) -> None:
    """Beds first, by the hours of the list; the corridor after all beds, the door after that."""
    trace = apps["night_round"].fly(0).trace

    def seconds(kind: str, fact: str = "t") -> dict[str, float]:
        return {str(e["mission"]): float(str(e[fact])) for e in events(trace, kind) if fact in e}

    begun, ended = seconds("mission.created"), seconds("mission.ended")
    due = seconds("mission.promised", "deadline")
    beds = [f"Bed {number}" for number in range(1, 9)]
    assert begun["Corridor"] == max(ended[bed] for bed in beds)
    assert begun["Door"] == ended["Corridor"]
    assert all(ended[name] <= when for name, when in due.items()) and due.keys() >= {*beds}
    assert not events(trace, "mission.late")


def test_blooms_are_pollinated_once_and_sick_plants_reported(apps: Mapping[str, Example]) -> None:
    """Three places bloom; two rounds warn of the same pest and the same disease."""
    flown = apps["alfalfa"].fly(0)
    added = [name for e in events(flown.trace, "mission.extended") for name in _names(e["add"])]
    assert sorted(added) == ["pollinate A", "pollinate A", "pollinate B"]
    warnings = [line for line in flown.outcome.log if line.startswith("WARNING")]
    assert sorted(warnings) == [
        *["WARNING: disease at (14.8, 5.2)"] * 2,
        *["WARNING: pest at (8.7, 1.7)"] * 2,
    ]
    assert all(mission.round == 1 for mission in flown.outcome.missions)


def test_rounds_begin_a_quarter_of_an_hour_apart(apps: Mapping[str, Example]) -> None:
    """The Clock holds the second round back."""
    launched = events(apps["alfalfa"].fly(0).trace, "trip.launched", mission="North arc", trip="A")
    assert [time(event) for event in launched] == [0.0, 900.0]


def test_maps_end_sharp(apps: Mapping[str, Example]) -> None:
    """What is blurred or off its place is retaken, until each strip's photos fit."""
    retaken = 0
    for seed in SEEDS:
        flown = apps["aerial_mapping"].fly(seed)
        assert flown.outcome.log.count("6 photos fit the map") == 4
        retaken += sum("it is taken again" in line for line in flown.outcome.log)
        for mission in flown.outcome.missions:
            assert mission.attempts >= len(mission.completed_trips)
    assert retaken > 0


def test_gradients_are_followed_and_bounded(apps: Mapping[str, Example]) -> None:
    """Each mission looks more closely at no more than four places, and some do."""
    for seed in SEEDS:
        flown = apps["pm10"].fly(seed)
        added = [sum(t.added for t in m.completed_trips) for m in flown.outcome.missions]
        assert sum(added) > 0 and max(added) <= 4
        places = [t.target for m in flown.outcome.missions for t in m.completed_trips if t.added]
        # The clouds stand around (12, 8) and (5.5, 3.5): no drone looks closely anywhere else.
        assert all(min(off(p, (12, 8)), off(p, (5.5, 3.5))) <= 3.5 for p in places)


def off(point: tuple[float, float, float], middle: tuple[float, float]) -> float:
    """Return how far a point is from a place on the ground."""
    return float(((point[0] - middle[0]) ** 2 + (point[1] - middle[1]) ** 2) ** 0.5)


def test_delays_count_from_the_trip_before(apps: Mapping[str, Example]) -> None:
    """Trip B of the first mission may start half a minute after A is done, and C a minute after B."""
    trace = apps["drugs_distribution_retry"].fly(0).trace
    for before, after, delay in (("A", "B", 30.0), ("B", "C", 60.0)):
        (done,) = events(trace, "trip.completed", mission="Mission 1", trip=before)
        (start,) = events(trace, "trip.launched", mission="Mission 1", trip=after)
        (wait,) = events(trace, "trip.delayed", mission="Mission 1", trip=after)
        assert wait["until"] == pytest.approx(time(done) + delay)
        assert time(start) >= time(done) + delay - 1e-6, "and then it needs a drone"


def test_a_tighter_limit_calls_drones_back() -> None:
    """With `limit: 20 s`, as the page proposes, trips are called back, retried and given up."""
    name = "drugs_distribution_timer"
    text = (EXAMPLES / name / "app.pluto").read_text(encoding="utf-8")
    assert text.count("limit: 2 min") == 1
    hooks = (EXAMPLES / name / "hooks.py").read_text(encoding="utf-8")
    app = loaded(text.replace("limit: 2 min", "limit: 20 s").replace(name, "NAME"), hooks).app
    flown = replace(example(name), app=app).fly(0).outcome
    assert "trip A is called back after 20 s" in flown.log
    first = flown.missions[0]
    assert (first.status.value, first.completed_trips, first.attempts) == ("FAILED", (), 3)


def _names(value: object) -> list[str]:
    assert isinstance(value, list)
    return [str(name) for name in value]
