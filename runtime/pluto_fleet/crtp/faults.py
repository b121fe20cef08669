"""What can go wrong with a simulated drone, each by a name and a value."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from .air import Air
from .drone import SimulatedCrazyflie
from .ports import Port, packed
from .setpoints import STOP, hover

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


def _upright(drone: SimulatedCrazyflie, _: float) -> None:
    drone.body.place(drone.body.position)


def _fixes(drone: SimulatedCrazyflie, on: float) -> None:
    drone.estimator.lose(not on)


def _noise(drone: SimulatedCrazyflie, metres: float) -> None:
    drone.estimator.noise = metres


def _rate(drone: SimulatedCrazyflie, hertz: float) -> None:
    drone.estimator.rate = hertz


def _deck(drone: SimulatedCrazyflie, on: float) -> None:
    drone.supervisor.faulty = bool(on)


def _setpoint(drone: SimulatedCrazyflie, height: float) -> None:
    if height is True:
        drone.hear(packed(Port.SETPOINT, 0, STOP))
    else:
        drone.hear(packed(Port.GENERIC_SETPOINT, 0, hover(height)))


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
    "upright": _upright,
    "fixes": _fixes,
    "noise": _noise,
    "rate": _rate,
    "deck": _deck,
    "setpoint": _setpoint,
    "lock": _lock,
    "restart": _restart,
    "on": _on,
}
_OF_AIR = ("silent", "loss", "latency")

FAULTS = (*_OF_AIR, "place", *_OF_DRONES)
"""All names. `fetch` is what a person does for a drone: stands it on its pad, and restarts it;
`upright`: stands it up where it lies. `fixes`: whether positions reach it; `noise` and `rate`: metres
by which they are off, and how many its own system gives a second. `setpoint`: of a stranger, that
lets it hover so high, or stops its motors. `deck`: whether one has a fault.
"""


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
