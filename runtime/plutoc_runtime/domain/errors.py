"""What can go wrong while an app runs, each with a sentence for a person."""

from __future__ import annotations

from enum import Enum


class PlutoError(Exception):
    """An error that the user of an app can fix; the message says where and how."""


class BadInput(PlutoError):
    """A file, a flag or a plan that cannot be flown. Nothing has started."""


class Failure(Enum):
    """Why a flight failed."""

    CRASH = "crash"
    LINK = "link"
    BATTERY = "battery"
    ACTION = "action"
    REFUSED = "refused"
    UNKNOWN = "unknown"  # it was under way, and how it ended is not known


class FlightFailed(PlutoError):
    """A drone could not finish its job: raised by navigation."""

    def __init__(self, failure: Failure, reason: str) -> None:
        super().__init__(reason)
        self.failure = failure


class ActionFailed(PlutoError):
    """Raise it in an action of your own: the trip fails with this reason, the drone is well."""


class MissionFailed(PlutoError):
    """A failure that no retry can repair: the mission ends at once, even if its graph would continue."""


def nothing_to_fly(reason: str) -> MissionFailed:
    """Return the error of a mission that is to fly and has no trip left; it may have failed before."""
    return MissionFailed(f"{reason}; no trip is left to fly".removeprefix("; "))


class HookFault(MissionFailed):
    """A hook raised an error, or returned what it did not declare."""

    def __init__(self, reason: str, detail: str = "") -> None:
        super().__init__(reason)
        self.detail = detail


class Cancelled(BaseException):
    """Raised in a coroutine that is cancelled."""

    returned: object = None
    """What a hook has returned nevertheless."""


ANY_ERROR: tuple[type[BaseException], ...] = (BaseException,)
"""Catches everything with which a coroutine or a hook may end, to pass it on to its waiters."""
