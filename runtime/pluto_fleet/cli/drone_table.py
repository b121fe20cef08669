"""What drones have answered, for a person and for another program."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from plutoc_runtime.domain.text import percent, place

from .drone_answers import heard
from .report import table

if TYPE_CHECKING:
    from ..drones.protocol import DroneTelemetry
    from .drone_answers import Answer

ONLY_IN_JSON = ("protocol",)
"""What a navigation tells besides, and a person need not know of a drone that answers."""

LONGEST = 120
"""Characters of a cell: what a drone says of itself may be anything."""


def drones_table(told: Sequence[Answer]) -> Iterator[str]:
    """Yield a line for each drone."""
    facts = list(dict.fromkeys(fact for one in told for fact in one.facts))
    shown = [fact for fact in facts if fact not in ONLY_IN_JSON]
    return table(
        ("drone", "uri", *shown, "battery", "position", "ready"),
        [
            [
                cell if len(cell) <= LONGEST else f"{cell[: LONGEST - 1]}…"
                for cell in (
                    one.asked.id if one.asked.known else "—",
                    one.asked.uri or "—",
                    *(one.facts.get(fact, "—") for fact in shown),
                    *_state(heard(one)),
                    "; ".join(one.problems) or "ready",
                )
            ]
            for one in told
        ],
        right=(),
    )


def drones_data(app: str, told: Sequence[Answer]) -> dict[str, object]:
    """Return the object that `drones --json` prints."""
    return {"app": app, "drones": [_data(one) for one in told]}


def _data(one: Answer) -> dict[str, object]:
    telemetry = heard(one)
    return {
        "drone": one.asked.id if one.asked.known else None,
        "uri": one.asked.uri,
        "navigation": one.asked.navigation,
        "ready": not one.problems,
        "problems": list(one.problems),
        "voltage": None if telemetry is None else telemetry.voltage or None,
        "battery_level": None if telemetry is None else telemetry.battery_level,
        "position": None if telemetry is None else list(telemetry.position),
        "flying": None if telemetry is None else telemetry.flying,
        "facts": dict(one.facts),
    }


def _state(telemetry: DroneTelemetry | None) -> tuple[str, str]:
    """Return its battery and where it is."""
    if telemetry is None:
        return "—", "—"
    level = percent(telemetry.battery_level)
    battery = f"{telemetry.voltage:.2f} V, {level}" if telemetry.voltage else level
    x, y, z = telemetry.position
    return battery, place((round(x, 2), round(y, 2), z))
