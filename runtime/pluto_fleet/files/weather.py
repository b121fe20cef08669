"""The wind of a fleet file's `[world]`, and how its vehicles are counted with in it."""

from __future__ import annotations

from dataclasses import replace
from math import pi

from ..shared.domain.motion import Motion
from ..shared.domain.quantities import Type
from ..shared.domain.text import number
from ..shared.domain.values import Keys, Quantity, Table
from ..wind import Wind, effort

_NEEDED: Keys = {
    "speed": Quantity(Type.SPEED, 0.0, 60.0),
    "from": Quantity(Type.ANGLE, -2 * pi, 2 * pi),
}
_OTHERS: Keys = {"gusts": Quantity(Type.SPEED, 0.0, 60.0)}
_HINTS = {
    "speed": ', such as speed = "6 m/s"',
    "from": ', the compass direction that it comes from, such as from = "240 deg"',
}
STEADY = "steady"
"""The legs of drones that have an airspeed."""


def read_wind(top: Table, motion: Motion) -> Wind | None:
    """Return the wind of `[world]`, if there is one, and note what is wrong with it.

    `motion`: how drones move in calm air.
    """
    world = top.table("world")
    if "wind" not in world.data:
        return None
    before = len(top.problems)
    table = world.table("wind")
    given = table.read(_NEEDED, _OTHERS, _HINTS)
    if len(top.problems) > before:
        return None
    wind = Wind(speed=given["speed"], origin=given["from"], gusts=given.get("gusts", 0.0))
    if motion.legs != STEADY:
        steady = f'[motion] legs = "{STEADY}"'
        table.problem(f"is for multicopters outdoors, by {steady}: these fly {motion.legs} legs")
    elif wind.speed >= motion.airspeed:
        most = f"{number(motion.airspeed)} m/s through the air (airspeed of [motion])"
        blows = f"{number(wind.speed)} m/s blow away drones that fly at up to {most}"
        table.problem(f"{blows}: nothing may take off", "speed")
    return wind


def blown(motion: Motion, wind: Wind, north: float, speed: float) -> Motion:
    """Return how drones move in the wind on a map whose north is turned by so many degrees, clockwise from up.

    `speed`: that of the fastest category.
    """
    motion = replace(motion, wind=wind.on_map(north))
    return replace(motion, effort=effort(motion, min(speed, motion.limit)))
