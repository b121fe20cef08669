"""What an autopilot does by itself when something fails, and how fast it may fly: by its parameters.

Their names and numbers are those of PX4's and ArduPilot's parameter references (docs/mavlink.md).
"""

from __future__ import annotations

from collections.abc import Mapping
from math import inf

from ..shared.domain.text import number

Values = Mapping[str, float]

PARAMETERS = {
    "PX4": (
        "MPC_XY_VEL_MAX",
        "NAV_DLL_ACT",
        "COM_DL_LOSS_T",
        "COM_LOW_BAT_ACT",
        "RTL_RETURN_ALT",
        "GF_ACTION",
    ),
    "ArduPilot": (
        "FS_GCS_ENABLE",
        "FS_GCS_TIMEOUT",
        "SYSID_MYGCS",
        "BATT_FS_LOW_ACT",
        "RTL_ALT",
        "FENCE_ACTION",
    ),
}
"""Which are read, by make."""

STATION = 245
"""The system id of MAVSDK's ground station: ArduPilot misses only the one that it has been told."""
_PX4_LINK = {0: "nothing", 1: "holds", 2: "returns", 3: "lands", 5: "cuts its motors"}
_PX4_BATTERY = {0: "warns", 2: "lands", 3: "returns, then lands"}
_ARDUPILOT_LINK = {0: "nothing", 1: "returns", 2: "goes on", 5: "lands"}
_ARDUPILOT_BATTERY = {0: "warns", 1: "lands", 2: "returns"}
_PX4_FENCE = {0: "nothing", 1: "warns", 2: "holds", 3: "returns", 4: "cuts its motors", 5: "lands"}
_ARDUPILOT_FENCE = {0: "warns", 1: "returns", 2: "lands", 3: "returns", 4: "brakes", 5: "returns"}


def fastest(make: str, values: Values) -> float | None:
    """Return the speed that it is never told to exceed in vain, in metres per second; None: any is taken."""
    return values.get("MPC_XY_VEL_MAX") if make == "PX4" else None


def return_height(make: str, values: Values) -> float | None:
    """Return the height above its home, in metres, to which it climbs to return; None: it does not say."""
    if make == "PX4":
        return values.get("RTL_RETURN_ALT")
    centimetres = values.get("RTL_ALT")
    return None if centimetres is None else centimetres / 100


def described(make: str, values: Values, highest: float = inf) -> dict[str, str]:
    """Return what it does without a ground station, at a low battery and beyond its fence, and how high it returns.

    `highest` is the height above its home up to which it may fly.
    """
    if make == "PX4":
        link = _named(_PX4_LINK, values.get("NAV_DLL_ACT"))
        after = values.get("COM_DL_LOSS_T")
        battery = _named(_PX4_BATTERY, values.get("COM_LOW_BAT_ACT"))
        fence = _named(_PX4_FENCE, values.get("GF_ACTION"))
    else:
        link = _named(_ARDUPILOT_LINK, values.get("FS_GCS_ENABLE"))
        after = values.get("FS_GCS_TIMEOUT")
        if link != "nothing" and values.get("SYSID_MYGCS", STATION) != STATION:
            link = f"nothing: SYSID_MYGCS is not {STATION}"
        battery = _named(_ARDUPILOT_BATTERY, values.get("BATT_FS_LOW_ACT"))
        fence = _named(_ARDUPILOT_FENCE, values.get("FENCE_ACTION"))
    timed = after is not None and not link.startswith(("nothing", "?"))
    height = return_height(make, values)
    returns = "?" if height is None else f"{number(height)} m"
    if height is not None and height > highest:
        returns += ", above the ceiling"
    return {
        "without a station": f"{link} after {number(after)} s" if timed and after else link,
        "battery low": battery,
        "beyond its fence": fence,
        "returns at": returns,
    }


def _named(names: Mapping[int, str], value: float | None) -> str:
    return "?" if value is None else names.get(int(value), number(value))
