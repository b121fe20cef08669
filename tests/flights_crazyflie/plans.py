"""What is flown: short ways on a small floor, for these flights take the time that they take."""

from __future__ import annotations

import re
from collections.abc import Mapping
from functools import partial
from pathlib import Path
from shutil import copytree

from tests.kill.plans import TRIP
from tests.kit.apps import EXAMPLES, compiled_file

Target = tuple[float, float, float]
Plan = Mapping[tuple[str, str], tuple[str, tuple[float, float], str]]
"""What each trip of each mission does, where, and what else is said of it."""

CRUISE = 0.5
SIZE = (6.0, 6.0)
DISTRIBUTION, RETRY = "drugs_distribution", "drugs_distribution_retry"
"""Examples: one that gives up a trip that fails, and one that lets another drone fly it."""


def quick_package(into: Path, speed: float | None = 1.0, app: str = RETRY) -> Path:
    """Compile an example with drones of another speed; return the folder of its sources."""
    copytree(EXAMPLES / app, into, dirs_exist_ok=True)
    if speed is not None:
        text = (into / "app.pluto").read_text()
        (into / "app.pluto").write_text(_CATEGORY.sub(partial(_as_fast, f"{speed:g} m/s"), text))
    return compiled_file(into / "app.pluto", into / app) / "src"


_CATEGORY = re.compile(r"(?m)^  category (\w+)(?:\((.*)\))? can")


def _as_fast(speed: str, category: re.Match[str]) -> str:
    given = (category[2] or "").split(", ")
    others = [one for one in given if one and not one.startswith("speed:")]
    return f"  category {category[1]}({', '.join([f'speed: {speed}', *others])}) can"


def homes(drones: int) -> dict[str, Target]:
    """Return where drones stand: a metre apart, in rows of five."""
    return {
        f"cf{place + 1}": (0.5 + place % 5, 0.5 + 2.5 * (place // 5), 0.0)
        for place in range(drones)
    }


def fleet(drones: int, uris: Mapping[str, str] | None = None) -> str:
    """Return a fleet file; with `uris`, of drones that can measure, where they can be reached."""
    written = f"[map]\nsize = {[*SIZE]}\nceiling = 2.5\n"
    written += f'cruise_height = {CRUISE}\n[fleet]\nafter_trip = "home"\n'
    if uris is not None:
        written += '[navigation.crazyflie]\nmeasure = { temperature = "bme.temp" }\n'
    for id, (x, y, _) in homes(drones).items():
        written += f'[[drone]]\nid = "{id}"\nhome = [{x}, {y}]\n'
        written += "" if uris is None else f'uri = "{uris[id]}"\n'
    return written


PILLS = 'item = { name = "pills", mass = "8 g" }'

WARD: Plan = {
    ("Ward", "look"): ("take_photo", (0.5, 1.2), ""),
    ("Ward", "warm"): ("measure", (0.5, 1.3), ""),
    ("Pills", "fetch"): ("pick_item", (1.5, 1.2), PILLS),
    ("Pills", "bring"): ("release_item", (1.5, 1.8), PILLS),
    ("Air", "here"): ("measure", (2.5, 1.2), 'parameters = { quantity = "pm10" }'),
    ("Door", "open"): ("take_photo", (3.5, 1.3), ""),
    ("Window", "shut"): ("take_photo", (4.5, 1.3), ""),
}
"""Five missions with all that a Crazyflie can do."""


def tours(drones: int, far: float = 1.0) -> Plan:
    """Return a mission a drone: it measures so many metres in front of a home."""
    return {
        (f"M{place + 1}", "t"): ("measure", (x, y + far), "")
        for place, (x, y, _) in enumerate(homes(drones).values())
    }


def missions(plan: Plan) -> str:
    """Return the missions file of a plan."""
    written, last = "", ""
    for (mission, name), (action, (x, y), more) in plan.items():
        if mission != last:
            written += f'[[mission]]\nname = "{mission}"\n'
            last = mission
        written += TRIP.format(name=name, action=action, x=x, y=y, more=more)
    return written


def targets(
    plan: Plan,
) -> dict[tuple[str, str], Target]:
    """Return where each trip leads."""
    return {trip: (x, y, CRUISE) for trip, (_, (x, y), _) in plan.items()}


def write(folder: Path, plan: str, drones: str) -> None:
    """Write both files."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "missions.toml").write_text(plan)
    (folder / "fleet.toml").write_text(drones)
