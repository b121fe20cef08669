"""What a simulated Crazyflie measures, and what can be set on it."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING

from .battery import EMPTY, LOW
from .params import Parameter
from .supervisor import LANDED

if TYPE_CHECKING:
    from .drone import SimulatedCrazyflie

_FAR = 4.0
"""Metres that a range sensor says where there is nothing."""


def parameters(cells: int = 1) -> list[Parameter]:
    """Return the parameters, as they are after a start."""
    numbers = [
        ("stabilizer.estimator", "B", 2),
        ("stabilizer.controller", "B", 1),
        ("stabilizer.stop", "B", 0),
        ("kalman.resetEstimation", "B", 0),
        ("kalman.initialX", "f", 0.0),
        ("kalman.initialY", "f", 0.0),
        ("kalman.initialZ", "f", 0.0),
        ("kalman.robustTdoa", "B", 0),
        ("commander.enHighLevel", "B", 1),
        ("hlCommander.vtoff", "f", 0.5),
        ("hlCommander.vland", "f", 0.5),
        ("pm.lowVoltage", "f", LOW * cells),
        ("pm.criticalLowVoltage", "f", EMPTY * cells),
        ("supervisor.landedTimeout", "H", LANDED * 1000.0),
        ("posCtlPid.xVelMax", "f", 1.0),
        ("posCtlPid.yVelMax", "f", 1.0),
        ("posCtlPid.zVelMax", "f", 1.0),
        ("sound.effect", "B", 0),
        ("sound.freq", "H", 4000),
        ("led.bitmask", "B", 0),
        ("ring.effect", "B", 1),
        ("ring.solidRed", "B", 20),
        ("gripper.closed", "B", 0),
        ("gripper.force", "f", 0.5),
        ("motorPowerSet.enable", "B", 0),
    ]
    fixed = [
        ("cpu.flash", "H", 1024),
        ("cpu.id0", "L", 0x2A0034),
        ("deck.bcLighthouse4", "B", 1),
        ("deck.bcFlow2", "B", 0),
        ("deck.bcZRanger2", "B", 0),
        ("deck.bcLoco", "B", 0),
        ("deck.bcLedRing", "B", 1),
        ("deck.bcBuzzer", "B", 1),
        ("deck.bcAI", "B", 1),
        ("deck.bcMultiranger", "B", 1),
        ("firmware.revision0", "L", 0x2025C0DE),
        ("firmware.revision1", "H", 0x0ACE),
        ("firmware.modified", "B", 0),
        ("imu_sensors.BMP388", "B", 1),
        ("system.selftestPassed", "B", 1),
    ]
    kept = [("health.startPropTest", "B", 0), ("ring.ledIntensity", "B", 100)]
    return [
        *(Parameter(name, letter, value) for name, letter, value in numbers),
        *(Parameter(name, letter, value, read_only=True) for name, letter, value in fixed),
        *(Parameter(name, letter, value, persistent=True) for name, letter, value in kept),
    ]


def variables(drone: SimulatedCrazyflie) -> Mapping[str, tuple[str, Callable[[], float]]]:
    """Return what can be logged: the type of each, and how it is read."""
    body, battery, supervisor = drone.body, drone.battery, drone.supervisor
    return {
        "stateEstimate.x": ("f", lambda: body.estimate[0]),
        "stateEstimate.y": ("f", lambda: body.estimate[1]),
        "stateEstimate.z": ("f", lambda: body.estimate[2]),
        "stateEstimate.vx": ("f", lambda: body.velocity[0]),
        "stateEstimate.vy": ("f", lambda: body.velocity[1]),
        "stateEstimate.vz": ("f", lambda: body.velocity[2]),
        "stateEstimate.roll": ("f", lambda: 175.0 if body.tumbled else 0.0),
        "stateEstimate.pitch": ("f", lambda: 0.0),
        "stateEstimate.yaw": ("f", lambda: math.degrees(body.yaw)),
        "kalman.stateX": ("f", lambda: body.estimate[0]),
        "kalman.stateY": ("f", lambda: body.estimate[1]),
        "kalman.stateZ": ("f", lambda: body.estimate[2]),
        "kalman.varPX": ("f", lambda: drone.variance),
        "kalman.varPY": ("f", lambda: drone.variance),
        "kalman.varPZ": ("f", lambda: drone.variance),
        "pm.vbat": ("f", lambda: battery.volts),
        "pm.vbatMV": ("H", lambda: battery.volts * 1000.0),
        "pm.batteryLevel": ("B", lambda: min(100.0, max(0.0, (battery.volts - 3.0) / 1.2 * 100.0))),
        "pm.state": ("b", lambda: battery.state),
        "pm.chargeCurrent": ("f", lambda: 0.4 if battery.charging else 0.0),
        "supervisor.info": ("H", drone.info),
        "sys.canfly": ("B", lambda: supervisor.can_fly),
        "sys.isFlying": ("B", lambda: supervisor.flying),
        "sys.isTumbled": ("B", lambda: body.tumbled),
        "sys.armed": ("B", lambda: supervisor.armed),
        "radio.rssi": ("B", lambda: 45),
        "radio.isConnected": ("B", lambda: 1),
        "lighthouse.status": ("B", lambda: 2),
        "acc.x": ("f", lambda: 0.0),
        "acc.y": ("f", lambda: 0.0),
        "acc.z": ("f", lambda: -1.0 if body.tumbled else 1.0),
        "gyro.z": ("f", lambda: 0.0),
        "baro.temp": ("f", lambda: 24.0),
        "baro.pressure": ("f", lambda: 1013.25 - 0.12 * body.position[2]),
        "baro.asl": ("f", lambda: body.position[2]),
        "bme.temp": ("f", lambda: temperature(body.position)),
        "bme.humidity": ("f", lambda: 40.0),
        "range.front": ("H", lambda: _FAR * 1000.0),
        "range.back": ("H", lambda: _FAR * 1000.0),
        "range.left": ("H", lambda: _FAR * 1000.0),
        "range.right": ("H", lambda: _FAR * 1000.0),
        "range.up": ("H", lambda: _FAR * 1000.0),
        "range.zrange": ("H", lambda: min(_FAR, body.position[2]) * 1000.0),
        "sim.measured": ("f", lambda: temperature(body.position)),
        "gripper.holds": ("B", lambda: drone.parameters["gripper.closed"]),
    }


def temperature(position: tuple[float, float, float]) -> float:
    """Return how warm it is somewhere, in degrees: a little warmer to the east, and above."""
    x, _, z = position
    return 20.0 + 0.5 * x + 0.25 * z
