"""What is flown: short ways on a small floor, for these flights take the time that they take."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from tests.kill.plans import trip

Target = tuple[float, float, float]
Plan = Mapping[tuple[str, str], tuple[str, tuple[float, float], str]]
"""What each trip of each mission does, where, and what else is said of it."""

CRUISE = 0.5
DISTRIBUTION = "drugs_distribution"


def fleet(drones: int, *, after_trip: str = "home", more: str = "") -> str:
    """Return a fleet file: drones a metre apart, in rows of five."""
    homes = [(0.5 + place % 5, 0.5 + place // 5) for place in range(drones)]
    written = "".join(
        f'[[drone]]\nid = "cf{number}"\nhome = [{x}, {y}]\n'
        for number, (x, y) in enumerate(homes, 1)
    )
    floor = f"[map]\nsize = [6.0, 6.0]\ncruise_height = {CRUISE}\nceiling = 2.5\n"
    return f'{floor}[fleet]\nafter_trip = "{after_trip}"\n{more}{written}'


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


def tours(drones: int, trips: int = 1) -> Plan:
    """Return a mission a drone: each measures in front of its home, farther each time."""
    return {
        (f"M{number + 1}", f"t{count + 1}"): (
            "measure",
            (0.5 + number % 5, 0.5 + number // 5 + 0.4 + 0.2 * count),
            "",
        )
        for number in range(drones)
        for count in range(trips)
    }


def missions(plan: Plan) -> str:
    """Return the missions file of a plan."""
    written, last = "", ""
    for (mission, name), (action, (x, y), more) in plan.items():
        if mission != last:
            written += f'[[mission]]\nname = "{mission}"\n'
            last = mission
        written += trip(name, action, f"{x}, {y}", more)
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
