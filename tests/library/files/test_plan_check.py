"""Could the fleet ever do what the missions ask? And are there names that a reader would take for each other?"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest

from pluto_fleet.files.fleet import DroneEntry, FleetFile
from pluto_fleet.files.plan_check import endless, look_alikes, problems, uncharged, untracked
from pluto_fleet.shared.domain.airspace import Airspace
from pluto_fleet.shared.domain.fleet_data import WorldData
from pluto_fleet.shared.domain.model import AfterTrip, Category, Item, Point
from pluto_fleet.shared.events.world import Mover
from pluto_fleet.shared.fleet.reach import chain_of, miss_of
from tests.kit import apps
from tests.library.files.an_app import APP, FieldMission, FieldTrip

SCOUT, CARRIER = APP.categories
HOME = (1.0, 1.0, 0.0)
WALL = ((8.0, -1.0), (9.0, -1.0), (9.0, 30.0), (8.0, 30.0))


def why_not(*asked: Any) -> str | None:
    """Return the reason alone why a drone cannot fly a chain."""
    miss = miss_of(*asked)
    return miss and miss.reason


def trip(action: str, x: float = 2.0, grams: float | None = None, name: str = "1") -> FieldTrip:
    target: Point = (x, 1.0, 1.2)
    item = None if grams is None else Item(name="pills", mass=grams / 1000)
    return FieldTrip(name=name, action=action, target=target, item=item)


def fleet(*drones: tuple[Category, Point], airspace: Airspace | None = None) -> FleetFile:
    return FleetFile(
        airspace=airspace or Airspace(),
        drones=tuple(
            DroneEntry(id=f"cf{i}", category=category.name, home=home)
            for i, (category, home) in enumerate(drones)
        ),
    )


def said(team: FleetFile, *trips: FieldTrip) -> list[str]:
    mission = FieldMission(name="M", trips=list(trips))
    return problems([mission], APP, team, team.airspace)


@pytest.mark.parametrize(
    ("real", "simulated", "said"),
    [
        (True, False, "name a tracker, by tracker = … in [fleet]"),
        (False, True, "add [[world.mover]] to a simulated world"),
        (
            True,
            True,
            "name a tracker, by tracker = … in [fleet], or add [[world.mover]] to a simulated world",
        ),
    ],
)
def test_who_follows_what_nobody_sees_is_told_what_to_add(
    real: bool, simulated: bool, said: str
) -> None:
    team = fleet((SCOUT, HOME))
    follows = FieldMission(name="M", trips=[trip("follow")])
    sentence = untracked([follows], APP, team, real=real, simulated=simulated)
    assert sentence == f"drones follow what moves, and nothing says where that is: {said}"
    walker = Mover(name="t1", kind="person", path=((1.0, 1.0),), speed=1.0)
    moving = replace(team, world=WorldData(movers=(walker,)))
    assert (untracked([follows], APP, moving, real=real, simulated=simulated) is None) == simulated
    seen = replace(team, tracker="lines")
    assert (untracked([follows], APP, seen, real=real, simulated=simulated) is None) == real
    stands = FieldMission(name="M", trips=[trip("take_photo")])
    assert untracked([stands], APP, team, real=real, simulated=simulated) is None


def test_a_chain_goes_from_a_pick_to_its_release() -> None:
    """Everything between flies with the same drone; any other trip stands alone."""
    photo, pick, measure, release = map(
        trip, ("take_photo", "pick_item", "measure", "release_item")
    )
    trips = [photo, pick, measure, release, photo]
    assert chain_of(trips) == [photo]
    assert chain_of(trips[1:]) == [pick, measure, release]
    assert chain_of(trips[1:3]) == [pick, measure]
    assert chain_of([]) == []


@pytest.mark.parametrize(
    ("category", "chain", "reason"),
    [
        (SCOUT, [trip("take_photo")], None),
        (SCOUT, [trip("pollinate")], "scout cannot pollinate"),
        (CARRIER, [trip("pick_item", grams=5), trip("release_item", grams=5)], None),
        (CARRIER, [trip("pick_item", grams=8), trip("release_item", grams=8)],
         "carrier carries at most 5 g, the item weighs 8 g"),
        (CARRIER, [trip("pick_item", grams=1), trip("measure"), trip("release_item", grams=1)],
         "carrier cannot measure"),
    ],
)  # fmt: skip
def test_a_drone_must_be_able_and_strong_enough(
    category: Category, chain: list[FieldTrip], reason: str | None
) -> None:
    """For every trip that it would have to fly in one go."""
    assert why_not(APP, Airspace(), category, HOME, chain) == reason


def test_the_battery_must_last_there_and_back_with_the_reserve() -> None:
    """A drone of 420 s and 0.5 m/s that must keep 20 % comes 80 m and back, less its climbing."""
    wide = Airspace(size=(500.0, 20.0))
    assert why_not(APP, wide, SCOUT, HOME, [trip("take_photo", 80.0)]) is None
    assert why_not(APP, wide, SCOUT, HOME, [trip("take_photo", 85.0)]) == (
        "scout would need 82 % of a full battery from its home (1, 1) and back, "
        "and 20 % must be left"
    )


def test_a_whole_chain_is_flown_with_one_battery() -> None:
    """Each of two trips is near enough alone, and both together are too far."""
    wide = Airspace(size=(500.0, 20.0))
    chain = [trip("pick_item", 120.0, 1), trip("release_item", 2.0, 1)]
    chain += [trip("pick_item", 120.0, 1), trip("release_item", 2.0, 1)]
    assert why_not(APP, wide, CARRIER, HOME, chain[:2]) is None
    assert why_not(APP, wide, CARRIER, HOME, chain) is not None
    assert said(fleet((CARRIER, HOME), airspace=wide), *chain) == []


def test_there_must_be_a_permitted_way() -> None:
    """A wall across the map parts the drones from what lies behind it."""
    airspace = Airspace(no_fly=(WALL,))
    reason = "scout finds no permitted way from (1, 1) to (12, 1)"
    assert why_not(APP, airspace, SCOUT, HOME, [trip("take_photo", 12.0)]) == reason
    assert why_not(APP, airspace, SCOUT, (12.0, 2.0, 0.0), [trip("take_photo", 12.0)]) is None


def test_the_sentence_tells_what_each_category_lacks() -> None:
    """Once for a category, however many drones it has."""
    team = fleet((SCOUT, HOME), (CARRIER, HOME), (SCOUT, (3.0, 3.0, 0.0)))
    pills = [trip("pick_item", grams=8, name="A"), trip("release_item", grams=8, name="2")]
    assert said(team, trip("take_photo"), *pills) == [
        (
            'mission "M", trips "A" to 2: no drone of the fleet can do it: scout cannot pick_item; '
            "carrier carries at most 5 g, the item weighs 8 g"
        )
    ]


def test_the_sentence_tells_the_nearest_miss() -> None:
    """Of two scouts, too far away both, that with less to go speaks."""
    wide = Airspace(size=(500.0, 20.0))
    team = fleet((SCOUT, HOME), (SCOUT, (5.0, 1.0, 0.0)), airspace=wide)
    [sentence] = said(team, trip("take_photo", 300.0))
    assert "from its home (5, 1) and back" in sentence


def test_what_repeats_until_stopped_has_no_end() -> None:
    """One sentence a mission; a number of rounds is an end."""
    missions = [
        FieldMission(name="A", trips=[], repeat=True),
        FieldMission(name="B", trips=[], repeat=1),
    ]
    assert endless(missions, APP) == [
        (
            'mission "A" repeats until it is stopped (repeat = true): say when with --until, '
            "such as --until 2h"
        )
    ]


@pytest.mark.parametrize(
    ("one", "other"),
    [
        ("caf\u00e9", "cafe\u0301"),
        ("North", "north"),
        ("\u0430pple", "apple"),
        ("\uff21", "A"),
        ("a b", "a  b"),
        ("stra\u00dfe", "STRASSE"),
        ("\u03bdan", "van"),
        ("kit", "\u043ait"),
        ("A-1", "A\u20111"),
        ("North", "North\ufe0f"),
        ("North", "No\u034frth"),
        ("North", "North\u3164"),
    ],
)
def test_two_names_that_look_alike_are_told(one: str, other: str) -> None:
    """And by which characters they differ; of missions, and of trips of one mission."""
    missions = [apps.mission(name, apps.trip("A", 3.0)) for name in (one, "between", other)]
    (said,) = look_alikes(missions)
    assert f"({one!a} and {other!a}): rename one" in said
    trips = apps.mission("m", apps.trip(one, 3.0), apps.trip(other, 4.0))
    (said,) = look_alikes([trips])
    assert 'two trips of mission "m" are easily taken' in said
    drones = [DroneEntry(id=id, category="scout", home=(0.5, 0.5, 0.0)) for id in (one, other)]
    (said,) = look_alikes([], drones)
    assert "two drones are easily taken" in said


def test_names_that_differ_are_left_alone() -> None:
    """Also the same one twice, which is refused where it must be."""
    missions = [apps.mission(name, apps.trip("A", 3.0)) for name in ("a1", "al", "b", "\u00e9")]
    assert not list(look_alikes([*missions, missions[0]]))


@pytest.mark.parametrize("after", AfterTrip)
@pytest.mark.parametrize(
    ("count", "charges", "scarce"), [(3, False, False), (40, False, True), (40, True, False)]
)
def test_more_than_the_batteries_hold_is_warned_of_where_nothing_charges_them(
    count: int, charges: bool, scarce: bool, after: AfterTrip
) -> None:
    """As far as that can be told without flying: by the order of the file."""
    on = replace(
        fleet((SCOUT, HOME), (SCOUT, (2.0, 1.0, 0.0))), charges_at_home=charges, after_trip=after
    )
    asked = [apps.mission(f"m{n}", apps.trip("A", 2.0 + 6 * (n % 2))) for n in range(count)]
    said = uncharged(asked, APP, on)
    assert (said is not None) == scarce
    assert said is None or said.startswith("nothing charges the drones at home")
