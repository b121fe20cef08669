"""Which fleets there are: the first drones of the file, and more beside them."""

from __future__ import annotations

from dataclasses import replace
from itertools import combinations
from math import dist

from pluto_fleet.files.fleet import DroneEntry
from pluto_fleet.shared.domain.airspace import Airspace
from pluto_fleet.sizing.fleets import Stock
from tests.kit.apps import fleet, mission, pick, release, trip

WALL = ((3.0, 0.0), (4.0, 0.0), (4.0, 5.0), (3.0, 5.0))
ROOM = Airspace(size=(6.0, 5.0), no_fly=(WALL,))
MISSION = mission("North", pick("A", 1.5), release("B", 5.0), trip("C", 2.5))
FILE = fleet(
    (0.5, 0.5, 0.0),
    (1.3, 0.5, 0.0),
    (0.5, 2.0, 0.0),
    categories=("scout", "carrier", "scout"),
    airspace=ROOM,
    apart=0.5,
)


def stock(most: int = 40) -> Stock:
    return Stock(fleet=FILE, missions=[MISSION], most=most)


def drones(counts: tuple[int, ...], most: int = 40) -> list[DroneEntry]:
    found = stock(most).of(counts)
    assert found is not None
    return list(found.drones)


def test_fewer_are_the_first_of_each_category_in_the_files_order() -> None:
    """As they stand there."""
    assert stock().kinds == ("scout", "carrier")
    assert stock().given == (2, 1)
    assert [drone.id for drone in drones((1, 1))] == ["cf1", "cf2"]
    assert [drone.id for drone in drones((2, 1))] == ["cf1", "cf2", "cf3"]
    assert [drone.id for drone in drones((2, 0))] == ["cf1", "cf3"]


def test_more_are_beside_them_in_free_docks() -> None:
    """Within the room, outside of the wall, as far apart as the others, and not where items lie."""
    more = drones((6, 6))
    assert [drone.id for drone in more[:3]] == ["cf1", "cf2", "cf3"]
    assert len({drone.id for drone in more}) == 12
    for drone in more:
        assert ROOM.problem(drone.home) is None
    for one, other in combinations(more, 2):
        assert dist(one.home, other.home) >= 0.8 - 1e-6
    for drone in more[3:]:
        assert dist(drone.home[:2], (1.5, 0.5)) >= 0.8 - 1e-6
    nearest = min(dist(drone.home, FILE.drones[0].home) for drone in more[3:])
    assert nearest < 1.2


def test_a_fleet_has_the_same_drones_as_the_next_larger_one() -> None:
    """So what was bought for one is not in vain for the other."""
    for number in range(1, 8):
        assert all(drone in drones((number + 1, 2)) for drone in drones((number, 2)))


def test_where_there_is_no_room_there_is_no_fleet() -> None:
    """Nor without a drone, nor with more than were allowed."""
    assert stock().of((0, 0)) is None
    assert stock(5).of((3, 3)) is None
    full = stock(1000)
    assert 15 < len(full.drones["scout"]) + len(full.drones["carrier"]) < 60
    assert full.of((500, 1)) is None
    assert len(full.largest.drones) == sum(map(len, full.drones.values()))


def test_a_name_of_the_file_is_not_given_twice() -> None:
    """Though it is as a new one would be called."""
    taken = replace(FILE.drones[1], id="scout3")
    file = replace(FILE, drones=(FILE.drones[0], taken))
    found = Stock(fleet=file, missions=[], most=10).of((5, 1))
    assert found is not None
    assert len({drone.id for drone in found.drones}) == 6
