"""What drones do to their world, and why they sometimes cannot."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from plutoc_runtime.actions import PICK, RELEASE
from plutoc_runtime.errors import Failure, FlightFailed
from plutoc_runtime.words import mass, place

if TYPE_CHECKING:
    from plutoc_runtime.model import Item

    from .body import Body


@dataclass(frozen=True, slots=True, kw_only=True)
class Deed:
    """Something that a drone does to the world, or sees of it."""

    drone: str
    action: str
    item: Item | None
    job: str | None
    """For which it was done."""
    boot: int
    """The drone's."""
    value: object
    """What it gave."""
    aboard: Item | None
    """What the drone carries afterwards."""


def grip_problem(body: Body, action: str, item: Item | None) -> str | None:
    """Return why a drone cannot pick or release this, or None."""
    who, has = body.drone.id, body.carries
    if action == PICK:
        payload = body.drone.category.payload
        if item is None:
            return "there is nothing to pick"
        if has is not None:
            return f"{who} already carries {has.name}"
        if item.mass > payload + 1e-9:
            return f"{item.name} weighs {mass(item.mass)}, {who} carries at most {mass(payload)}"
    if action == RELEASE and (has is None or item is None or has.name != item.name):
        carries = "nothing" if has is None else has.name
        return f"{who} carries {carries}" + ("" if item is None else f", not {item.name}")
    return None


def action_failed(body: Body, what: str, why: str) -> FlightFailed:
    """Return the failure of an action, with its place."""
    return FlightFailed(Failure.ACTION, f"{what}: {why} at {place(body.location)}")
