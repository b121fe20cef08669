"""The plans whose makespan and batteries are predicted, and then flown.

What a camera or a sensor gives is the world's, and no matter of motion: so no simulated world has
anything to see, and where an app judges its photos it is content with all of them.
"""

from __future__ import annotations

import re
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path

import tomlkit

from tests.kit.apps import EXAMPLES, NAMES, compiled_file
from tests.paths import ROOT


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


_HERE = Path(__file__).parent
_CONTENT = {
    "SHARP = 0.7": "SHARP = 0.0",
    "AHEAD = 0.55": "AHEAD = 0.0",
    "ASIDE = 0.25": "ASIDE = 0.0",
    "LISTENS = 2": "LISTENS = 1",
}
"""What makes evaluators content with each photo."""
_ROUNDS = re.compile(r"(?m)^(repeat|every) = .*\n")
_MORE = re.compile(r"(?m)^repeat = \d+")
_PAUSES = re.compile(r"(?m)^every = .*\n")
"""Fields that make a plan last for longer than it can be flown."""
_WORLD = re.compile(r"(?ms)^(#[^\n]*\n)*\[\[?world\b.*?(?=^\[\[?(?!world\b)|\Z)")
EMPTY_WORLD = "\n[world]\n"
"""A world in which there is nothing to see."""


def example(name: str) -> Plan:
    """Return an example with its own missions, without further rounds."""
    plan = _example(name, "missions.toml", "fleet.toml")
    missions = _ROUNDS.sub("", plan.missions)
    return replace(plan, missions=missions, fleet=_WORLD.sub("", plan.fleet) + EMPTY_WORLD)


def _told_of_ardupilot() -> Mapping[str, object]:
    """Return the `[motion]` that the page says of an ArduPilot as it comes."""
    page = (ROOT / "docs" / "motion.md").read_text(encoding="utf-8")
    (said,) = re.findall(r"For ArduPilot as it comes, say (.*?)\. `pluto", page, re.DOTALL)
    return tomllib.loads("\n".join(re.findall(r"`(\w+ = [^`]+)`", said)))


MOTIONS: Mapping[str, Mapping[str, object]] = {
    "px4": {"legs": "steady"},
    "ardupilot": {"legs": "steady", **_told_of_ardupilot()},
}
"""How vehicles of each make move that are set as they come (docs/motion.md)."""


def outdoors(name: str, make: str) -> Plan:
    """Return the outdoor form of an example, with two rounds at most and no pause between, for vehicles of a make."""
    plan = _example(name, "outdoors_missions.toml", "outdoors.toml")
    missions = _MORE.sub("repeat = 1", _PAUSES.sub("", plan.missions))
    fleet = tomlkit.parse(plan.fleet)
    fleet.setdefault("navigation", {}).setdefault("mavlink", {})["autopilot"] = make
    fleet.setdefault("motion", {}).update(MOTIONS[make])
    return replace(plan, name=f"{name}, {make}", missions=missions, fleet=tomlkit.dumps(fleet))


def _example(name: str, missions: str, fleet: str) -> Plan:
    """Return an example that is content with each photo."""
    folder = EXAMPLES / name
    sources = {file: (folder / file).read_text() for file in _FILES if (folder / file).exists()}
    for strict, content in _CONTENT.items():
        sources = {file: text.replace(strict, content) for file, text in sources.items()}
    return Plan(
        name=name,
        app=name,
        sources=sources,
        missions=(folder / missions).read_text(),
        fleet=(folder / fleet).read_text(),
        lists={path.name: path.read_text() for path in sorted(folder.glob("*.csv"))},
    )


_FILES = ("app.pluto", "hooks.py")

TOURS = {
    "app.pluto": (_HERE / "tours.pluto").read_text(),
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


def _own(folder: Path) -> Plan:
    """Return one of our own plans."""
    missions, fleet = ((folder / f"{name}.toml").read_text() for name in ("missions", "fleet"))
    name = folder.name.replace("_", " ")
    return Plan(name=name, app="tours", sources=TOURS, missions=missions, fleet=fleet)


OWN = tuple(map(_own, sorted((_HERE / "own").iterdir())))
"""Our own plans: what the examples lack."""


def known() -> dict[str, Plan]:
    """Return the plans of the examples and our own, by their names."""
    return {plan.name: plan for plan in (*map(example, NAMES), *OWN)}
