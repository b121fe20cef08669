"""What must be installed to fly MAVLink vehicles; imports nothing of it."""

from __future__ import annotations

from importlib.util import find_spec

from ..shared.domain.errors import BadInput

_MESSAGE = "to fly MAVLink vehicles, MAVSDK is needed: pip install 'pluto-fleet[mavlink]'"
_SIMULATED = "to simulate MAVLink vehicles, pymavlink is needed: pip install 'pluto-fleet[mavlink]'"


def require(*, simulated: bool = False) -> None:
    """Raise `BadInput` with the command that installs what is missing."""
    if find_spec("mavsdk") is None:
        raise BadInput(_MESSAGE)
    if simulated and find_spec("pymavlink") is None:
        raise BadInput(_SIMULATED)
