"""The faults of a simulated drone, by name and value."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from .commander import STOP, hover
from .drone import SimulatedCrazyflie
from .packets import LossyChannel, Port, packed

Value = float | bool | list[float]


def _tumble(drone: SimulatedCrazyflie, _: float) -> None:
    drone.body.tumbled = True
    drone.body.cut()


def _fetch(drone: SimulatedCrazyflie, _: float) -> None:
    drone.body.place(drone.build.home)
    drone.restart()


def _setpoint(drone: SimulatedCrazyflie, height: float) -> None:
    if height is True:
        drone.hear(packed(Port.SETPOINT, 0, STOP))
    else:
        drone.hear(packed(Port.GENERIC_SETPOINT, 0, hover(height)))


def _on(drone: SimulatedCrazyflie, on: float) -> None:
    if on:
        drone.restart()
    else:
        drone.switch(False)


_OF_DRONES: Mapping[str, Callable[[SimulatedCrazyflie, float], None]] = {
    "tumble": _tumble,
    "fetch": _fetch,
    "volts": lambda drone, volts: drone.battery.set_volts(volts),
    "level": lambda drone, level: drone.carried.charge_to(level),
    "busy": lambda drone, on: setattr(drone, "busy", bool(on)),
    "unsure": lambda drone, on: setattr(drone, "unsure", bool(on)),
    "upright": lambda drone, _: drone.body.place(drone.body.position),
    "fixes": lambda drone, on: drone.estimator.lose(not on),
    "noise": lambda drone, metres: setattr(drone.estimator, "noise", metres),
    "rate": lambda drone, hertz: setattr(drone.estimator, "rate", hertz),
    "deck": lambda drone, on: setattr(drone.supervisor, "faulty", bool(on)),
    "setpoint": _setpoint,
    "lock": lambda drone, _: drone.supervisor.lock(),
    "restart": lambda drone, _: drone.restart(),
    "on": _on,
}
_OF_AIR = ("silent", "loss", "latency")

FAULTS = (*_OF_AIR, "place", *_OF_DRONES)
"""All names. `fetch` is what a person does for a drone: stands it on its pad, and restarts it;
`upright`: stands it up where it lies. `fixes`: whether positions reach it; `noise` and `rate`: metres
by which they are off, and how many its own system gives a second. `setpoint`: of a stranger, that
lets it hover so high, or stops its motors. `deck`: whether one has a fault.
"""


def let(drone: SimulatedCrazyflie, air: LossyChannel, name: str, value: Value) -> None:
    """Set or reset a fault; raise `ValueError` if there is none of this name."""
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
