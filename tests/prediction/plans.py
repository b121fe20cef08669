"""The plans whose makespan and batteries are predicted, and then flown.

What a camera or a sensor gives is the world's, and no matter of motion: so no simulated world has
anything to see, and where an app judges its photos it is content with all of them.
"""

from __future__ import annotations

import re
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from tests.kit.apps import EXAMPLES, NAMES, compiled_file


@dataclass(frozen=True, slots=True, kw_only=True)
class Plan:
    """An app, and what is flown with it."""

    name: str
    app: str
    sources: Mapping[str, str]
    """The texts of the app and of its hooks, by the files' names."""
    missions: str
    fleet: str
    lists: Mapping[str, str] = field(default_factory=dict)
    """The texts of the lists of which missions are made, by the files' names."""

    @property
    def drones(self) -> int:
        """How many drones there are."""
        return len(tomllib.loads(self.fleet)["drone"])

    def compiled(self, folder: Path) -> Path:
        """Compile the app; return the folder that its package is imported from."""
        folder.mkdir(parents=True)
        for name, text in self.sources.items():
            (folder / name).write_text(text, encoding="utf-8")
        return compiled_file(folder / "app.pluto", folder / self.app) / "src"

    def write(self, folder: Path) -> None:
        """Write both files, and the lists beside them."""
        folder.mkdir(parents=True)
        (folder / "missions.toml").write_text(self.missions, encoding="utf-8")
        (folder / "fleet.toml").write_text(self.fleet, encoding="utf-8")
        for name, text in self.lists.items():
            (folder / name).write_text(text, encoding="utf-8")


_CONTENT = {
    "SHARP = 0.7": "SHARP = 0.0",
    "AHEAD = 0.55": "AHEAD = 0.0",
    "ASIDE = 0.25": "ASIDE = 0.0",
    "LISTENS = 2": "LISTENS = 1",
}
"""What makes evaluators content with each photo."""
_ROUNDS = re.compile(r"(?m)^(repeat|every) = .*\n")
"""Fields that make a plan last for longer than it can be flown."""
_WORLD = re.compile(r"(?ms)^(#[^\n]*\n)*\[\[?world\b.*?(?=^\[\[?(?!world\b)|\Z)")
EMPTY_WORLD = "\n[world]\n"
"""A world in which there is nothing to see."""


def example(name: str) -> Plan:
    """Return an example with its own missions, without further rounds."""
    folder = EXAMPLES / name
    sources = {file: (folder / file).read_text() for file in _FILES if (folder / file).exists()}
    for strict, content in _CONTENT.items():
        sources = {file: text.replace(strict, content) for file, text in sources.items()}
    return Plan(
        name=name,
        app=name,
        sources=sources,
        missions=_ROUNDS.sub("", (folder / "missions.toml").read_text()),
        fleet=_WORLD.sub("", (folder / "fleet.toml").read_text()) + EMPTY_WORLD,
        lists={path.name: path.read_text() for path in sorted(folder.glob("*.csv"))},
    )


_FILES = ("app.pluto", "hooks.py")

TOURS = {
    "app.pluto": """pluto 1

app tours "Plans by which predictions are judged" {
  category slow(speed: 0.3 m/s, payload: 20 g) can pick_item, release_item, take_photo, measure
  category plain(payload: 12 g) can pick_item, release_item, take_photo, measure, inspect
  category swift(speed: 1 m/s, flight_time: 5 min) can take_photo, measure, inspect
  category tired(flight_time: 3 min, charge_time: 5 min) can take_photo, measure

  action inspect safe

  create = MissionCreator
  wait = Clock
  allocate = DroneAllocator(policy: nearest)
  launch = TripLauncher
  watch = TripMonitor
  retry = PriorityManager(max_attempts: 3)

  start -> create -> wait -> allocate -> launch -> watch
  watch -> wait when STANDBY
  watch -> retry when FAILED
  retry -> allocate when STANDBY
  watch -> end when COMPLETED
  retry -> end otherwise
}
""",
    "hooks.py": '''"""An action that fails when it is tried for the first time, in every world."""

from __future__ import annotations

from . import ActionFailed, Context, Drone, Trip


async def inspect(drone: Drone, trip: Trip, context: Context) -> object:
    """Look for three seconds; the first time it is too dark."""
    await context.sleep(3.0)
    if trip.attempt == 1:
        raise ActionFailed("it is too dark")
    return None
''',
}
"""An app with drones of four kinds; none is faster than a Crazyflie follows, for that is refused."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Stop:
    """One trip: what is done, and where."""

    action: str
    at: tuple[float, ...]
    item: str = ""
    """The item that is picked or released; of eight grams."""
    delay: float = 0.0


Rectangle = tuple[float, float, float, float]
"""From (x, y) to (x, y)."""


def tour(
    name: str,
    *,
    size: tuple[float, float],
    cruise: float,
    drones: Mapping[tuple[float, float], str],
    missions: Mapping[str, tuple[Stop, ...]],
    no_fly: tuple[Rectangle, ...] = (),
    after_trip: str = "home",
) -> Plan:
    """Return a plan of `TOURS`; `drones`: the category of each, by its home."""
    walls = [[[x, y], [X, y], [X, Y], [x, Y]] for x, y, X, Y in no_fly]
    fleet = [
        f"[map]\nsize = {[*size]}\ncruise_height = {cruise}\nceiling = 4.0\nno_fly = {walls}",
        f'[fleet]\nafter_trip = "{after_trip}"',
    ]
    for number, ((x, y), category) in enumerate(drones.items(), 1):
        fleet.append(f'[[drone]]\nid = "cf{number}"\ncategory = "{category}"\nhome = [{x}, {y}]')
    plan: list[str] = []
    for mission, stops in missions.items():
        plan.append(f'[[mission]]\nname = "{mission}"')
        plan += [_trip(number, stop) for number, stop in enumerate(stops, 1)]
    return Plan(
        name=name,
        app="tours",
        sources=TOURS,
        missions="\n".join(plan) + "\n",
        fleet="\n".join(fleet) + EMPTY_WORLD,
    )


def _trip(number: int, stop: Stop) -> str:
    lines = ["[[mission.trip]]", f'name = "{number}"', f'action = "{stop.action}"']
    lines.append(f"target = {[*stop.at]}")
    if stop.item:
        lines.append(f'item = {{ name = "{stop.item}", mass = "8 g" }}')
    if stop.delay:
        lines.append(f'delay = "{stop.delay:g} s"')
    return "\n".join(lines)


def _measures(*places: tuple[float, ...]) -> tuple[Stop, ...]:
    return tuple(Stop(action="measure", at=at) for at in places)


def _photos(*places: tuple[float, ...]) -> tuple[Stop, ...]:
    return tuple(Stop(action="take_photo", at=at) for at in places)


def _carries(item: str, fro: tuple[float, ...], to: tuple[float, ...]) -> tuple[Stop, ...]:
    return (
        Stop(action="pick_item", at=fro, item=item),
        Stop(action="release_item", at=to, item=item),
    )


OWN = (
    tour(  # trip after trip, with charging in between
        "one drone",
        size=(8.0, 6.0),
        cruise=1.0,
        drones={(1.0, 1.0): "tired"},
        missions={
            "near": _measures((2.5, 1.5), (1.5, 3.0)),
            "far": _measures((5.0, 2.5), (4.0, 4.0)),
            "there and back": _photos((3.0, 3.0), (1.0, 2.0)),
        },
    ),
    tour(  # three walls, each with one gap
        "crowded ward",
        size=(12.0, 5.0),
        cruise=1.2,
        drones={(x, y): "plain" for x in (0.6, 1.5) for y in (0.8, 2.5, 4.2)},
        missions={
            "A": _photos((11.0, 1.0), (5.0, 4.2)),
            "B": _photos((11.0, 4.0), (5.0, 0.8)),
            "C": _measures((8.0, 1.0), (2.3, 4.2)),
            "D": _measures((8.0, 4.0), (2.3, 0.8)),
            "E": _carries("pills", (4.5, 2.5), (10.0, 2.5)),
            "F": _photos((7.0, 2.5), (11.0, 2.5)),
        },
        no_fly=tuple((x, y, x + 0.2, y + 1.7) for x in (3.2, 6.2, 9.2) for y in (0.0, 3.3)),
    ),
    tour(  # three missions meet twice, each time at one spot
        "shared spots",
        size=(10.0, 8.0),
        cruise=1.2,
        drones={(1.0 + 1.5 * n, 0.8): "plain" for n in range(3)},
        missions={name: _photos((5.0, 4.0), (2.5, 6.0)) for name in "ABC"},
        after_trip="next",
    ),
    tour(
        "three speeds",
        size=(12.0, 8.0),
        cruise=1.5,
        drones={
            (1.0, 1.0): "slow",
            (2.0, 1.0): "plain",
            (3.0, 1.0): "swift",
            (4.0, 1.0): "swift",
        },
        missions={
            "A": _photos((2.0, 6.0), (5.0, 6.0), (8.0, 6.0)),
            "B": _measures((10.0, 2.0), (10.0, 2.0, 3.0), (11.0, 7.0)),
            "C": _carries("pills", (3.0, 3.0), (5.0, 5.0)),
            "D": (*_measures((6.0, 2.0)), Stop(action="measure", at=(7.0, 4.0), delay=20.0)),
            "E": (Stop(action="inspect", at=(9.0, 4.0)),),
        },
        after_trip="stay",
    ),
    tour(
        "long legs",
        size=(24.0, 10.0),
        cruise=1.6,
        drones={(1.0, 1.0): "plain", (1.0, 2.0): "plain", (1.0, 3.0): "plain"},
        missions={
            "east": _carries("fuse", (6.0, 2.0), (20.0, 2.0)),
            "west": _carries("label", (18.0, 8.0), (5.0, 6.0)),
            "dark": (Stop(action="inspect", at=(12.0, 5.0)),),
            "light": _photos((22.0, 9.0)),
        },
        no_fly=((10.0, 6.5, 14.0, 7.5),),
    ),
)
"""Our own plans: what the examples lack."""


def known() -> dict[str, Plan]:
    """Return the plans of the examples and our own, by their names."""
    return {plan.name: plan for plan in (*map(example, NAMES), *OWN)}
