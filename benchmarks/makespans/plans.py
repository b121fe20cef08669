"""Thirty plans, drawn from their numbers: the same in every run.

Each kind of plan is there three times. They have different maps, fleets, missions and drones' batteries, so that no
policy is good in all of them for a reason that holds in few.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from random import Random

Place = tuple[float, float]

APP = """\
pluto 1
app makespans "Plans whose makespan is measured" {{
  category plain(payload: 12 g) can take_photo, measure, pick_item, release_item
  category swift(speed: 0.8 m/s, flight_time: 5 min) can take_photo, measure
  category slow(speed: 0.3 m/s, payload: 20 g) can take_photo, pick_item, release_item
  category tired(flight_time: 3 min, charge_time: 5 min) can take_photo, measure
{hook}
  create = MissionCreator
  allocate = DroneAllocator({policy})
  launch = TripLauncher
  watch = TripMonitor
  retry = PriorityManager(max_attempts: 3)

  start -> create -> allocate -> launch -> watch
  watch -> allocate when STANDBY
  watch -> retry when FAILED
  retry -> allocate when STANDBY
  [watch, retry] -> end otherwise
}}
"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Kind:
    """What the plans of one kind have in common."""

    name: str
    drones: tuple[int, int]
    missions: tuple[int, int]
    """From how many to how many there may be."""
    size: Place = (12.0, 9.0)
    trips: tuple[int, int] = (1, 1)
    apart: float = 0.0
    categories: tuple[str, ...] = ("plain",)
    carried: float = 0.0
    """The share of missions that carry an item."""
    priorities: tuple[int, ...] = (0,)
    docks: str = "row"
    """`row`: all side by side at an edge of the map; `about`: anywhere."""


KINDS = (
    Kind(name="few drones", drones=(3, 5), missions=(30, 45)),
    Kind(name="few, apart", drones=(3, 5), missions=(25, 40), apart=0.5, docks="about"),
    Kind(name="many drones", drones=(12, 20), missions=(50, 80), size=(20.0, 20.0), docks="about"),
    Kind(name="many, apart", drones=(8, 12), missions=(30, 45), size=(20.0, 15.0), apart=0.5),
    Kind(name="several trips", drones=(4, 6), missions=(10, 16), trips=(2, 5), docks="about"),
    Kind(
        name="charging",
        drones=(3, 5),
        missions=(35, 50),
        size=(13.0, 10.0),
        categories=("tired",),
    ),
    Kind(name="items", drones=(4, 6), missions=(16, 24), carried=0.7, trips=(1, 2)),
    Kind(
        name="priorities",
        drones=(4, 6),
        missions=(25, 40),
        priorities=(0, 0, 0, 1, 2),
        docks="about",
    ),
    Kind(
        name="categories",
        drones=(5, 8),
        missions=(25, 40),
        size=(16.0, 12.0),
        categories=("plain", "swift", "slow"),
        carried=0.3,
    ),
    Kind(
        name="all of it",
        drones=(4, 8),
        missions=(20, 30),
        size=(18.0, 14.0),
        trips=(1, 3),
        apart=0.5,
        categories=("plain", "swift", "tired"),
        carried=0.2,
        priorities=(0, 0, 1),
        docks="about",
    ),
)
OF_EACH_KIND = 3
_EDGE, _BETWEEN = 0.8, 0.8


@dataclass(frozen=True, slots=True, kw_only=True)
class Plan:
    """One plan, as its user would write it."""

    name: str
    missions: str
    map: str
    apart: float
    drones: str

    def fleet(self, after_trip: str) -> str:
        """Return the fleet file; an empty `after_trip` is the default."""
        after = f'after_trip = "{after_trip}"\n' if after_trip else ""
        return f"{self.map}\n[fleet]\napart = {self.apart}\n{after}{self.drones}"


def plans(count: int = OF_EACH_KIND * len(KINDS)) -> Iterator[Plan]:
    """Give so many plans; the first ones are one of each kind."""
    for number in range(count):
        kind = KINDS[number % len(KINDS)]
        yield drawn(kind, Random(f"makespans/{number}"), f"{number + 1} {kind.name}")


def drawn(kind: Kind, chance: Random, name: str) -> Plan:
    """Draw a plan of a kind."""
    width, depth = kind.size
    count = chance.randint(*kind.drones)
    homes = _homes(kind, chance, count)
    kinds = [*kind.categories, *chance.choices(kind.categories, k=count)][:count]
    drones = (
        f'[[drone]]\nid = "d{number}"\ncategory = "{category}"\nhome = [{x}, {y}]\n'
        for number, (category, (x, y)) in enumerate(zip(kinds, homes, strict=True))
    )
    missions = (_mission(kind, chance, n) for n in range(chance.randint(*kind.missions)))
    return Plan(
        name=name,
        missions="".join(missions),
        map=f"[map]\nsize = [{width}, {depth}]",
        apart=kind.apart,
        drones="".join(drones),
    )


def _homes(kind: Kind, chance: Random, count: int) -> Sequence[Place]:
    if kind.docks == "row":
        return [(round(_EDGE + n * _BETWEEN, 2), _EDGE) for n in range(count)]
    found: list[Place] = []
    while len(found) < count:
        x, y = _somewhere(kind, chance)
        if all(abs(x - a) > _BETWEEN or abs(y - b) > _BETWEEN for a, b in found):
            found.append((x, y))
    return found


def _somewhere(kind: Kind, chance: Random) -> Place:
    width, depth = kind.size
    x, y = chance.uniform(_EDGE, width - _EDGE), chance.uniform(_EDGE, depth - _EDGE)
    return round(x, 1), round(y, 1)


def _mission(kind: Kind, chance: Random, number: int) -> str:
    lines = [f'[[mission]]\nname = "m{number}"']
    priority = chance.choice(kind.priorities)
    for part, (action, more) in enumerate(_actions(kind, chance, number)):
        x, y = _somewhere(kind, chance)
        lines += ["[[mission.trip]]", f'name = "m{number}.{part}"', f'action = "{action}"']
        lines += [f"target = [{x}, {y}]", f"priority = {priority}", *filter(None, [more])]
    return "\n".join(lines) + "\n"


def _actions(kind: Kind, chance: Random, number: int) -> list[tuple[str, str]]:
    """Return what is done on each trip of a mission, and with which item."""
    if chance.random() < kind.carried:
        item = f'item = {{ name = "i{number}", mass = "8 g" }}'
        return [("pick_item", item), ("release_item", item)]
    one = "take_photo" if "slow" in kind.categories else chance.choice(("take_photo", "measure"))
    return [(one, "")] * chance.randint(*kind.trips)
