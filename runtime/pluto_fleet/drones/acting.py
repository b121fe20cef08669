"""What one drone of the team does where it hovers: its actions, and what an app's own actions ask."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from typing import TYPE_CHECKING

from plutoc_runtime.domain.actions import BUILT_IN, PICK, RELEASE, Plain
from plutoc_runtime.domain.errors import Failure, FlightFailed

from .flying import in_the_air
from .outcome import outcome_of
from .protocol import Acts, Readable
from .timeouts import shortened
from .vehicle import SPARE

if TYPE_CHECKING:
    from plutoc_runtime.domain.model import Item

    from .vehicle import Member

READ = 5.0
"""Seconds that it may take to read a value, or to set one."""


async def act(
    member: Member, action: str, parameters: Mapping[str, Plain], item: Item | None
) -> object:
    """Do one of the built-in actions here."""
    return await member.lane.run(action, partial(_act, member, action, parameters, item))


async def _act(
    member: Member, action: str, parameters: Mapping[str, Plain], item: Item | None
) -> object:
    member.check()
    in_the_air(member)
    why = why_not(member, action, parameters)
    if why is not None or not isinstance(member.navigation, Acts):
        raise FlightFailed(Failure.REFUSED, why or f"{member.id} has no action {action}")
    given = parameters.get("seconds")
    seconds = given if isinstance(given, (int, float)) else BUILT_IN[action].seconds
    value = await member.go(
        action, seconds + SPARE, member.navigation.act, action, parameters, item
    )
    if action in (PICK, RELEASE):
        member.cargo.carries(member.id, item.name if action == PICK and item is not None else None)
    return outcome_of(member.id, action, value)


def why_not(member: Member, action: str, parameters: Mapping[str, Plain]) -> str | None:
    """Return why its hardware cannot do an action, or None."""
    navigation = member.navigation
    if action not in BUILT_IN or not isinstance(navigation, Acts):
        return f"{member.id} has no action {action}"
    believed: str | None = (
        f"the navigation of {member.id} cannot say whether it has the action {action}"
    )
    why = member.calls.ask("why_not", lambda: navigation.why_not(action, parameters), believed)
    return why if why is None else shortened(str(why))


async def read(member: Member, name: str) -> float:
    """Return what it measures under this name."""
    member.check()
    if not isinstance(member.navigation, Readable):
        raise FlightFailed(Failure.ACTION, f"{member.id} has nothing that can be read")
    value = await member.calls.call(f"read {name}", READ, member.navigation.read, name)
    try:
        return float(value)
    except (TypeError, ValueError) as error:
        raise member.calls.mistake("read", error) from error


async def write(member: Member, name: str, value: float) -> None:
    """Set what it has under this name."""
    member.check()
    if not isinstance(member.navigation, Readable):
        raise FlightFailed(Failure.ACTION, f"{member.id} has nothing that can be written")
    await member.calls.call(f"write {name}", READ, member.navigation.write, name, value)
