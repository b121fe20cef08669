"""What is flown while processes are killed: examples that carry things, on a small map."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from tests.kit.apps import STRAIGHT_LEGS


@dataclass(frozen=True, slots=True, kw_only=True)
class Plan:
    """An example, and the missions that its drones shall fly."""

    app: str
    missions: str
    fleet: str

    def write(self, folder: Path) -> Mapping[str, Path]:
        """Write both files, and return where they are."""
        files = {"missions": folder / "missions.toml", "fleet": folder / "fleet.toml"}
        files["missions"].write_text(self.missions)
        files["fleet"].write_text(self.fleet)
        return files


def _errand(name: str, item: str, start: str, end: str, more: str = "") -> str:
    thing = f'item = {{ name = "{item}", mass = "3 g" }}'
    return f"""
[[mission]]
name = "{name}"
{more}
[[mission.trip]]
name = "fetch"
action = "pick_item"
{thing}
target = [{start}]
[[mission.trip]]
name = "bring"
action = "release_item"
{thing}
target = [{end}]
"""


def trip(name: str, action: str, target: str, more: str = "") -> str:
    """Return a trip of a missions file."""
    head = f'[[mission.trip]]\nname = "{name}"\naction = "{action}"\n'
    return f"{head}target = [{target}]\n{more}\n"


def fleet(categories: str, *, after_trip: str = "home") -> str:
    """Return a fleet file with a drone for each of these categories."""
    drones = [
        f'[[drone]]\nid = "d{i}"\ncategory = "{category}"\nhome = [{0.5 + i}, 0.5]\n'
        for i, category in enumerate(categories.split())
    ]
    head = "[map]\nsize = [5.0, 4.0]\ncruise_height = 1.0\n"
    behaviour = f'[fleet]\nafter_trip = "{after_trip}"\n{STRAIGHT_LEGS}'
    return f"{head}{behaviour}{''.join(drones)}"


PLANS = (
    Plan(
        app="drugs_distribution",
        missions=_errand("north", "pills", "1.0, 1.5", "4.0, 1.5")
        + trip("look", "take_photo", "4.0, 2.0")
        + _errand("south", "drops", "2.0, 1.0", "3.0, 2.5")
        + '[[mission]]\nname = "warm"\n'
        + trip("here", "measure", "2.5, 3.0")
        + trip("there", "measure", "1.0, 3.0"),
        fleet=fleet("nurse nurse"),
    ),
    Plan(
        app="drugs_distribution_retry",
        missions=_errand("north", "pills", "1.0, 1.5", "4.0, 1.5")
        + trip("look", "take_photo", "4.0, 2.0", 'delay = "4 s"')
        + _errand("south", "drops", "2.0, 1.0", "3.0, 2.5")
        + _errand("east", "salve", "4.0, 1.0", "1.0, 2.5"),
        fleet=fleet("nurse nurse nurse", after_trip="next"),
    ),
    Plan(
        app="warehouse_item_finder",
        missions="".join(
            _errand(item, item, start, end, promises)
            for item, start, end, promises in (
                ("fuse", "1.0, 3.0", "4.0, 1.0", 'deadline = "8 s"'),
                ("label", "2.0, 3.0", "4.0, 1.5", ""),
                ("sensor", "3.0, 3.0", "4.0, 2.0", 'window = ["6 s", "40 s"]'),
                ("screw", "4.0, 3.0", "1.0, 1.0", 'after = ["fuse", "label"]\ndeadline = "1 min"'),
            )
        ),
        fleet=fleet("light light lifter", after_trip="stay"),
    ),
)
