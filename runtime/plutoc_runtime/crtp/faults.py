"""What can go wrong with a simulated drone, each by a name and a value."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from .air import Air
from .drone import SimulatedCrazyflie

Value = float | bool | list[float]


def _tumble(drone: SimulatedCrazyflie, _: float) -> None:
    drone.body.tumbled = True
    drone.body.cut()


def _fetch(drone: SimulatedCrazyflie, _: float) -> None:
    drone.body.place(drone.build.home)
    drone.restart()


def _volts(drone: SimulatedCrazyflie, volts: float) -> None:
    drone.battery.set_volts(volts)


def _level(drone: SimulatedCrazyflie, level: float) -> None:
    drone.battery.level = level


def _busy(drone: SimulatedCrazyflie, on: float) -> None:
    drone.busy = bool(on)


def _unsure(drone: SimulatedCrazyflie, on: float) -> None:
    drone.unsure = bool(on)


def _lock(drone: SimulatedCrazyflie, _: float) -> None:
    drone.supervisor.lock()


def _restart(drone: SimulatedCrazyflie, _: float) -> None:
    drone.restart()


def _on(drone: SimulatedCrazyflie, on: float) -> None:
    if on:
        drone.restart()
    else:
        drone.switch(False)


_OF_DRONES: Mapping[str, Callable[[SimulatedCrazyflie, float], None]] = {
    "tumble": _tumble,
    "fetch": _fetch,
    "volts": _volts,
    "level": _level,
    "busy": _busy,
    "unsure": _unsure,
    "lock": _lock,
    "restart": _restart,
    "on": _on,
}
_OF_AIR = ("silent", "loss", "latency")

FAULTS = (*_OF_AIR, "place", *_OF_DRONES)
"""All names. `fetch` is what a person does for a drone: stands it on its pad, and restarts it."""


def let(drone: SimulatedCrazyflie, air: Air, name: str, value: Value) -> None:
    """Let something go wrong, or right again; ValueError: there is no such fault."""
    if name == "place" and isinstance(value, list):
        x, y, z = value
        drone.body.place((x, y, z))
    elif name not in FAULTS or isinstance(value, list):
        raise ValueError(f"{name}: no such fault: there are {', '.join(FAULTS)}")
    elif name in _OF_DRONES:
        drone.note(f"fault {name}", value=value)
        _OF_DRONES[name](drone, value)
    elif name == "silent":
        air.silent = bool(value)
    elif name == "loss":
        air.loss = value
    else:
        air.latency = value
