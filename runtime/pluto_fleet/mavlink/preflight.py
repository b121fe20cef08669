"""Why a vehicle must not take off now: what it says of its health, and where it stands."""

from __future__ import annotations

from math import hypot

from ..shared.domain.model import Point
from ..shared.domain.text import number
from .options import VehicleOptions
from .state import VehicleState

_HEALTH = {
    "is_gyrometer_calibration_ok": "its gyroscope is not well",
    "is_accelerometer_calibration_ok": "its accelerometer is not well",
    "is_magnetometer_calibration_ok": "its compass is not well",
    "is_global_position_ok": "it does not know where it is: no satellites",
    "is_home_position_ok": "it does not know its home position yet",
    "is_armable": "its autopilot would not arm",
}
"""By MAVSDK's names; the last one is what the others come to, and may have a reason of its own."""


TWINS = (
    "several vehicles tell that they are this one: give each a system id of its own, by MAV_SYS_ID (PX4) or"
    " SYSID_THISMAV (ArduPilot), and restart it"
)
_UNTOLD = (
    "it does not tell how full its battery is: say how many cells that has in [navigation.mavlink], such as"
    " cells = 4"
)


def problems(state: VehicleState, home: Point | None, options: VehicleOptions) -> list[str]:
    """Return the reasons; nothing in the air, where it has taken off already.

    `home` is where it must stand; None: it may have landed anywhere.
    """
    if state.flying:
        return []
    if state.twins.are_there:
        return [TWINS]
    if not state.health:
        return ["it has not told how it is"]
    found = [why for name, why in _HEALTH.items() if not state.health.get(name, False)]
    if found and found[-1] == _HEALTH["is_armable"] and state.texts:
        found[-1] += f": {state.texts[-1][1]}"
    if state.battery is None:
        found.append(_UNTOLD)
    elif state.gauge is not None and state.gauge.problem is not None:
        found.append(state.gauge.problem)
    if state.position is not None and home is not None:
        x, y, _ = state.position
        away = hypot(x - home[0], y - home[1])
        if away > options.dock:
            found.append(f"it stands {number(round(away, 1))} m from its home")
    return found
